yat_test(film LABELS fast LIBS yat_film SOURCES test_film.cpp)
yat_test(tonemap LABELS fast LIBS yat_film OpenImageIO::OpenImageIO SOURCES test_tonemap.cpp)
yat_test(output LABELS fast LIBS yat_film OpenImageIO::OpenImageIO SOURCES test_output.cpp)
