yat_test(base LABELS fast LIBS yat_base SOURCES test_parallel.cpp)
