# The program: its parts, and the binary as people run it.
yat_test(app LABELS fast LIBS yat_app nlohmann_json::nlohmann_json SOURCES test_app.cpp)
yat_test(program LABELS fast LIBS nlohmann_json::nlohmann_json SOURCES test_program.cpp)
add_dependencies(test_program yat)
target_compile_definitions(test_program PRIVATE YAT_PROGRAM="$<TARGET_FILE:yat>"
                                                YAT_VERSION="${PROJECT_VERSION}")

# Kernels compile for AArch64, too.
get_target_property(yat_xsimd_include xsimd INTERFACE_INCLUDE_DIRECTORIES)
list(GET yat_xsimd_include 0 yat_xsimd_include)
add_test(NAME neon_compiles COMMAND ${PROJECT_SOURCE_DIR}/tools/check_neon.sh ${PROJECT_SOURCE_DIR}
                                    ${yat_xsimd_include} ${YAT_KERNEL_SOURCES})
set_tests_properties(neon_compiles PROPERTIES LABELS per_isa SKIP_RETURN_CODE 77 TIMEOUT 1200)

add_test(NAME format COMMAND ${PROJECT_SOURCE_DIR}/tools/check_format.sh ${PROJECT_SOURCE_DIR})
set_tests_properties(format PROPERTIES LABELS fast SKIP_RETURN_CODE 77)

# The per-instruction-set tests of all groups on emulated CPUs for which sse42 and avx2 are the
# highest. Deferred to the end of this folder, when every group has added its programs. Sanitizers do
# not run under the emulator.
function(yat_add_low_isa_test)
  get_property(targets DIRECTORY PROPERTY BUILDSYSTEM_TARGETS)
  set(programs "")
  foreach(target ${targets})
    get_target_property(type ${target} TYPE)
    if(type STREQUAL "EXECUTABLE" AND target MATCHES "^test_")
      list(APPEND programs $<TARGET_FILE:${target}>)
    endif()
  endforeach()
  add_test(NAME low_isa_nehalem
           COMMAND ${PROJECT_SOURCE_DIR}/tools/check_low_isa.sh Nehalem sse42 ${programs})
  add_test(NAME low_isa_haswell
           COMMAND ${PROJECT_SOURCE_DIR}/tools/check_low_isa.sh Haswell avx2 ${programs})
  set_tests_properties(low_isa_nehalem low_isa_haswell
                       PROPERTIES LABELS per_isa SKIP_RETURN_CODE 77 TIMEOUT 1200)
endfunction()
if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64" AND NOT YAT_SANITIZE)
  cmake_language(DEFER CALL yat_add_low_isa_test)
endif()
