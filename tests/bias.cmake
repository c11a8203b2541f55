# Proofs of no bias: the tests that they use, and the pairs of ways that must give one picture.
yat_test(significance LABELS fast statistics LIBS yat_base SOURCES test_significance.cpp)
yat_test(bias LABELS render statistics LIBS yat_wavefront glm::glm SOURCES test_bias_lights.cpp
                                                      test_bias_paths.cpp test_bias_kernels.cpp)
