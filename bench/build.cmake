add_executable(bench_build bench_build.cpp)
target_link_libraries(bench_build PRIVATE yat_bench benchmark::benchmark CLI11::CLI11)
set_target_properties(bench_build PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/bin)
