add_executable(bench_traversal bench_traversal.cpp thread_control.cpp traversal_table.cpp)
target_link_libraries(bench_traversal PRIVATE yat_bench benchmark::benchmark CLI11::CLI11)
set_target_properties(bench_traversal PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/bin)
