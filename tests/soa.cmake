yat_test(soa LABELS fast LIBS yat_base SOURCES test_soa.cpp)
