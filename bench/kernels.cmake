add_executable(bench_kernels bench_kernels.cpp bench_kernels_instances.cpp bench_kernels_shading.cpp
                             bench_kernels_traversal.cpp kernel_inputs.cpp)
target_link_libraries(bench_kernels PRIVATE yat_wavefront benchmark::benchmark)
set_target_properties(bench_kernels PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/bin)
