# Lights that do not shine evenly.
yat_test(varying_emission LABELS render statistics per_isa LIBS yat_wavefront glm::glm
         SOURCES test_varying_emission.cpp)
yat_test(compile_emission LABELS fast LIBS yat_scene SOURCES test_compile_emission.cpp)
