# Description -> Scene.
target_sources(
  yat_scene
  PRIVATE ${CMAKE_CURRENT_SOURCE_DIR}/alias_table.cpp
          ${CMAKE_CURRENT_SOURCE_DIR}/colour_model.cpp
          ${CMAKE_CURRENT_SOURCE_DIR}/compile.cpp
          ${CMAKE_CURRENT_SOURCE_DIR}/compile_camera.cpp
          ${CMAKE_CURRENT_SOURCE_DIR}/compile_coated.cpp
          ${CMAKE_CURRENT_SOURCE_DIR}/compile_diffuse.cpp
          ${CMAKE_CURRENT_SOURCE_DIR}/compile_film.cpp
          ${CMAKE_CURRENT_SOURCE_DIR}/compile_filter.cpp
          ${CMAKE_CURRENT_SOURCE_DIR}/compile_fresnel.cpp
          ${CMAKE_CURRENT_SOURCE_DIR}/compile_geometry.cpp
          ${CMAKE_CURRENT_SOURCE_DIR}/compile_glass.cpp
          ${CMAKE_CURRENT_SOURCE_DIR}/compile_lights.cpp
          ${CMAKE_CURRENT_SOURCE_DIR}/compile_materials.cpp
          ${CMAKE_CURRENT_SOURCE_DIR}/compile_mesh.cpp
          ${CMAKE_CURRENT_SOURCE_DIR}/compile_metals.cpp
          ${CMAKE_CURRENT_SOURCE_DIR}/compile_objects.cpp
          ${CMAKE_CURRENT_SOURCE_DIR}/compile_place.cpp
          ${CMAKE_CURRENT_SOURCE_DIR}/compile_shapes.cpp
          ${CMAKE_CURRENT_SOURCE_DIR}/compile_textures.cpp
          ${CMAKE_CURRENT_SOURCE_DIR}/data_files.cpp
          ${CMAKE_CURRENT_SOURCE_DIR}/instances.cpp
          ${CMAKE_CURRENT_SOURCE_DIR}/material_traits.cpp
          ${CMAKE_CURRENT_SOURCE_DIR}/parameters.cpp)
