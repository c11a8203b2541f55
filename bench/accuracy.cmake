# Scenes with known answers. The formulas and cases are a library of their own, for tests.
add_library(
  yat_accuracy STATIC
  accuracy/cie_lamp_cases.cpp accuracy/cie_sky.cpp accuracy/cie_sky_cases.cpp accuracy/form_factors.cpp accuracy/glass_cases.cpp
  accuracy/light_cases.cpp accuracy/lobe_cases.cpp accuracy/lobes.cpp accuracy/report.cpp
  accuracy/room_cases.cpp accuracy/runs.cpp accuracy/scene_text.cpp accuracy/veach_cases.cpp)
target_compile_definitions(yat_accuracy PRIVATE YAT_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
target_link_libraries(yat_accuracy PUBLIC yat_bench)
add_executable(bench_accuracy accuracy/bench_accuracy.cpp)
target_link_libraries(bench_accuracy PRIVATE yat_accuracy CLI11::CLI11)
set_target_properties(bench_accuracy PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/bin)
