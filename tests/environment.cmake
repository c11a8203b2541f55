yat_test(environment LABELS render statistics per_isa LIBS yat_wavefront
         SOURCES test_environment.cpp test_environment_maps.cpp)
