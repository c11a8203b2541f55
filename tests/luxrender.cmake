yat_test(luxrender LABELS render LIBS yat_wavefront OpenImageIO::OpenImageIO SOURCES test_luxrender.cpp)
