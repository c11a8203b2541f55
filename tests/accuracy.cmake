# Known answers: their formulas, and the program that renders them, on a few cases.
if(YAT_BUILD_BENCH)
  yat_test(accuracy LABELS fast LIBS yat_accuracy SOURCES test_accuracy.cpp)
  add_dependencies(test_accuracy bench_accuracy)
  target_compile_definitions(test_accuracy PRIVATE YAT_BENCH_DIR="${PROJECT_BINARY_DIR}/bin")
endif()
