target_sources(
  yat_scene
  PRIVATE ${CMAKE_CURRENT_SOURCE_DIR}/tree_references.cpp
          ${CMAKE_CURRENT_SOURCE_DIR}/tree_planes.cpp
          ${CMAKE_CURRENT_SOURCE_DIR}/tree_objects.cpp
          ${CMAKE_CURRENT_SOURCE_DIR}/tree_binary.cpp
          ${CMAKE_CURRENT_SOURCE_DIR}/tree_build.cpp
          ${CMAKE_CURRENT_SOURCE_DIR}/tree_reinsert.cpp
          ${CMAKE_CURRENT_SOURCE_DIR}/tree_plan.cpp
          ${CMAKE_CURRENT_SOURCE_DIR}/tree_collapse.cpp
          ${CMAKE_CURRENT_SOURCE_DIR}/tree_verify.cpp
          ${CMAKE_CURRENT_SOURCE_DIR}/tree_top.cpp)
