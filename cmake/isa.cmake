# One object library per instruction set, from the same sources.
#
#   yat_add_isa(avx2 ARCH "xsimd::fma3<xsimd::avx2>" FLAGS -mavx2 -mfma NEEDS avx2 fma)
#
# builds every file of YAT_KERNEL_SOURCES into namespace yat::avx2, adds avx2 to the generated
# list that dispatch.cpp includes (lowest first: the order of the calls), and, in optimised
# builds, a test that no weak symbol leaves the namespace: the linker keeps one copy of an inline
# function, and it must not be the one made with another instruction set's flags.

set(YAT_KERNEL_SOURCES "" CACHE INTERNAL "")
set(YAT_ISA_LIST "" CACHE INTERNAL "")
set(YAT_ISA_OBJECTS "" CACHE INTERNAL "")
set(YAT_ISA_NAMES "" CACHE INTERNAL "")

function(yat_add_isa name)
  cmake_parse_arguments(ARG "" "ARCH" "FLAGS;NEEDS" ${ARGN})
  set(lib yat_kernels_${name})
  add_library(${lib} OBJECT ${YAT_KERNEL_SOURCES})
  target_link_libraries(${lib} PRIVATE yat_flags xsimd)
  target_compile_definitions(${lib} PRIVATE YAT_ISA=${name} "YAT_ARCH=${ARG_ARCH}"
                                            xsimd=xsimd_${name})
  target_compile_options(${lib} PRIVATE ${ARG_FLAGS} -fno-trapping-math)
  # GCC takes the undefined lanes of its own intrinsics for a mistake.
  target_compile_options(${lib} PRIVATE
    $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized> $<$<CXX_COMPILER_ID:GNU>:-Wno-uninitialized>)
  # A sanitized or debug kernel is still a kernel: -O1 at least, or a test takes minutes.
  target_compile_options(${lib} PRIVATE $<$<CONFIG:Debug>:-O1>
                                        $<$<NOT:$<CONFIG:Debug>>:-O3>)
  set(needs "true")
  foreach(feature ${ARG_NEEDS})
    string(APPEND needs " && __builtin_cpu_supports(\"${feature}\")")
  endforeach()
  set(YAT_ISA_LIST "${YAT_ISA_LIST} YAT_ISA_ENTRY(${name}, ${needs})" CACHE INTERNAL "")
  set(YAT_ISA_OBJECTS ${YAT_ISA_OBJECTS} $<TARGET_OBJECTS:${lib}> CACHE INTERNAL "")
  set(YAT_ISA_NAMES ${YAT_ISA_NAMES} ${name} CACHE INTERNAL "")
  if(YAT_BUILD_TESTS AND CMAKE_BUILD_TYPE MATCHES "Rel" AND NOT YAT_SANITIZE)
    add_test(NAME isa_symbols_${name}
             COMMAND ${PROJECT_SOURCE_DIR}/tools/check_isa_symbols.sh ${CMAKE_NM} ${name}
                     $<TARGET_OBJECTS:${lib}>
             COMMAND_EXPAND_LISTS)
    set_tests_properties(isa_symbols_${name} PROPERTIES LABELS "fast;per_isa")
  endif()
endfunction()
