yat_test(stages LABELS per_isa LIBS yat_kernels glm::glm SOURCES test_stages.cpp test_surface_stage.cpp
         test_shade_stage.cpp test_tangents.cpp)
yat_test(materials LABELS per_isa statistics LIBS yat_kernels glm::glm SOURCES test_materials.cpp)
yat_test(lights LABELS per_isa statistics LIBS yat_kernels glm::glm
         SOURCES test_lights.cpp test_rectangle_lights.cpp test_triangle_lights.cpp)
yat_test(sampling LABELS per_isa statistics LIBS yat_kernels glm::glm
         SOURCES test_sampling.cpp test_warps.cpp)

# The warps are inline functions of kernels: this one source is built as a kernel of its own.
if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
  set_source_files_properties(test_warps.cpp PROPERTIES
    COMPILE_DEFINITIONS "YAT_ISA=test_lanes;YAT_ARCH=xsimd::sse4_2;xsimd=xsimd_test_lanes"
    COMPILE_OPTIONS "-msse4.2")
else()
  set_source_files_properties(test_warps.cpp PROPERTIES
    COMPILE_DEFINITIONS "YAT_ISA=test_lanes;YAT_ARCH=xsimd::neon64;xsimd=xsimd_test_lanes")
endif()
target_link_libraries(test_sampling PRIVATE xsimd)
