add_executable(bench_render bench_render.cpp)
target_link_libraries(bench_render PRIVATE yat_wavefront benchmark::benchmark)
target_compile_definitions(bench_render PRIVATE YAT_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
set_target_properties(bench_render PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/bin)
