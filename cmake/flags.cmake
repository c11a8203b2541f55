# Warnings, sanitizers and the floating-point contract, as interface targets.

add_library(yat_flags INTERFACE)
target_compile_features(yat_flags INTERFACE cxx_std_20)
# No fused multiply-add behind our back: the same expression must round the same way in every
# instruction set (docs/architecture.md, invariant 3). fma is written out where it pays.
target_compile_options(
  yat_flags INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wdouble-promotion -Wnon-virtual-dtor
                      -ffp-contract=off -fno-math-errno)
target_include_directories(yat_flags INTERFACE ${PROJECT_SOURCE_DIR}/src)

if(YAT_WERROR)
  target_compile_options(yat_flags INTERFACE -Werror)
endif()

set(YAT_SANITIZE "" CACHE STRING "Sanitizers to build with: empty, address+undefined, thread")
if(YAT_SANITIZE STREQUAL "address+undefined")
  set(yat_san -fsanitize=address,undefined -fno-sanitize-recover=undefined
              -fno-omit-frame-pointer)
elseif(YAT_SANITIZE STREQUAL "thread")
  set(yat_san -fsanitize=thread -fno-omit-frame-pointer)
elseif(NOT YAT_SANITIZE STREQUAL "")
  message(FATAL_ERROR "YAT_SANITIZE=${YAT_SANITIZE}: use 'address+undefined' or 'thread'")
endif()
if(yat_san)
  target_compile_options(yat_flags INTERFACE ${yat_san})
  target_link_options(yat_flags INTERFACE ${yat_san})
endif()
if(YAT_FRAME_POINTERS)
  target_compile_options(yat_flags INTERFACE -fno-omit-frame-pointer -g)
endif()
