target_sources(
  yat_scene
  PRIVATE ${CMAKE_CURRENT_SOURCE_DIR}/tree_build.cpp ${CMAKE_CURRENT_SOURCE_DIR}/tree_split.cpp
          ${CMAKE_CURRENT_SOURCE_DIR}/tree_collapse.cpp ${CMAKE_CURRENT_SOURCE_DIR}/tree_verify.cpp)
