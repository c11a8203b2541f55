# Every benchmark starts and does a minimal case; what it writes is read back. No time is asserted.
if(YAT_BUILD_BENCH)
  yat_test(benches LABELS fast LIBS yat_bench SOURCES test_benches.cpp test_judge.cpp test_measure.cpp
                                              test_rays_file.cpp test_record_scene.cpp
                                              test_scalar_trace.cpp)
  add_dependencies(test_benches bench_build bench_kernels bench_render bench_traversal record_rays)
  target_compile_definitions(test_benches PRIVATE YAT_BENCH_DIR="${PROJECT_BINARY_DIR}/bin")
endif()

# The report and the tables of many scenes are plain Python.
find_package(Python3 3.9 QUIET COMPONENTS Interpreter)
if(Python3_Interpreter_FOUND)
  add_test(NAME bench_report
           COMMAND ${Python3_EXECUTABLE} -B ${CMAKE_CURRENT_SOURCE_DIR}/test_bench_report.py
                   ${PROJECT_SOURCE_DIR}/tools ${CMAKE_CURRENT_BINARY_DIR}/output/bench_report)
  add_test(NAME converge_scenes
           COMMAND ${Python3_EXECUTABLE} -B ${CMAKE_CURRENT_SOURCE_DIR}/test_converge_scenes.py
                   ${PROJECT_SOURCE_DIR}/tools ${CMAKE_CURRENT_BINARY_DIR}/output/converge_scenes)
  set_tests_properties(bench_report converge_scenes PROPERTIES LABELS fast ENVIRONMENT
                                                                PYTHONDONTWRITEBYTECODE=1)
endif()
