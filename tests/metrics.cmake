yat_test(metrics LABELS fast LIBS yat_metrics OpenImageIO::OpenImageIO SOURCES test_metrics.cpp)
