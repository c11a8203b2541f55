yat_test(halves LABELS fast statistics LIBS yat_film SOURCES test_halves.cpp)
yat_test(noise LABELS render statistics LIBS yat_app SOURCES test_noise.cpp)
yat_test(allocation LABELS fast statistics LIBS yat_wavefront SOURCES test_allocation.cpp)
