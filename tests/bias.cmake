# Proofs of no bias: the tests that they use, and the pairs of ways that must give one picture.
yat_test(significance LABELS fast statistics LIBS yat_base SOURCES test_significance.cpp)
