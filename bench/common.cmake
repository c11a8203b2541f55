# What the benchmark programs share, and Embree, where it is installed, for the ratios. Nothing else
# of yat uses it.
find_package(embree 4 QUIET)
if(NOT embree_FOUND)
  find_package(embree 3 QUIET)
endif()

add_library(yat_bench STATIC bench_scenes.cpp judge.cpp measure.cpp ray_sets.cpp rays_file.cpp
                             record_scene.cpp scalar_trace.cpp traced_set.cpp)
# Plain code stays plain.
set_source_files_properties(scalar_trace.cpp PROPERTIES COMPILE_OPTIONS
                                                        "-fno-vectorize;-fno-slp-vectorize")
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  set_source_files_properties(
    scalar_trace.cpp PROPERTIES COMPILE_OPTIONS "-fno-tree-vectorize;-fno-tree-slp-vectorize")
endif()
target_link_libraries(yat_bench PUBLIC yat_app nlohmann_json::nlohmann_json)
target_include_directories(yat_bench PUBLIC ${CMAKE_CURRENT_SOURCE_DIR})
if(embree_FOUND)
  target_sources(yat_bench PRIVATE embree_build.cpp embree_trace.cpp)
  target_link_libraries(yat_bench PUBLIC embree)
  target_compile_definitions(yat_bench PUBLIC YAT_WITH_EMBREE=1
                                              YAT_EMBREE_MAJOR=${embree_VERSION_MAJOR})
endif()
