add_executable(bench_traversal bench_traversal.cpp traversal_scenes.cpp)
target_link_libraries(bench_traversal PRIVATE yat_scene yat_kernels benchmark::benchmark)
# The same rays through Embree, for the ratio. Optional: nothing else of yat uses it.
find_package(embree 4 QUIET)
if(NOT embree_FOUND)
  find_package(embree 3 QUIET)
endif()
if(embree_FOUND)
  target_sources(bench_traversal PRIVATE bench_traversal_embree.cpp)
  target_link_libraries(bench_traversal PRIVATE embree)
  target_compile_definitions(bench_traversal PRIVATE YAT_WITH_EMBREE=1
                                                     YAT_EMBREE_MAJOR=${embree_VERSION_MAJOR})
endif()
