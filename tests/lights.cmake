yat_test(light_renders LABELS render statistics per_isa LIBS yat_wavefront
         SOURCES test_light_renders.cpp)
yat_test(light_tree LABELS fast statistics LIBS yat_wavefront SOURCES test_light_tree.cpp)

# The choice is inline functions of kernels: this source is built as a kernel of its own.
if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
  set_source_files_properties(test_light_tree.cpp PROPERTIES
    COMPILE_DEFINITIONS "YAT_ISA=test_lanes;YAT_ARCH=xsimd::sse4_2;xsimd=xsimd_test_lanes"
    COMPILE_OPTIONS "-msse4.2")
else()
  set_source_files_properties(test_light_tree.cpp PROPERTIES
    COMPILE_DEFINITIONS "YAT_ISA=test_lanes;YAT_ARCH=xsimd::neon64;xsimd=xsimd_test_lanes")
endif()
target_link_libraries(test_light_tree PRIVATE xsimd)
