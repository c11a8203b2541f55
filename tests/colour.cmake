yat_test(colour LABELS fast LIBS yat_scene glm::glm xsimd
         SOURCES test_colour_model.cpp test_colour_lanes.cpp)

# The bands of a register of colours, built as a kernel of its own.
if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
  set_source_files_properties(test_colour_lanes.cpp PROPERTIES
    COMPILE_DEFINITIONS "YAT_ISA=test_lanes;YAT_ARCH=xsimd::sse4_2;xsimd=xsimd_test_lanes"
    COMPILE_OPTIONS "-msse4.2")
else()
  set_source_files_properties(test_colour_lanes.cpp PROPERTIES
    COMPILE_DEFINITIONS "YAT_ISA=test_lanes;YAT_ARCH=xsimd::neon64;xsimd=xsimd_test_lanes")
endif()
