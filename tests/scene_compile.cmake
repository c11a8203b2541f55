yat_test(scene_compile
  LABELS fast
  LIBS yat_scene glm::glm OpenImageIO::OpenImageIO
  SOURCES test_compile_parameters.cpp test_compile_options.cpp test_compile_geometry.cpp
          test_compile_shapes.cpp test_subdivide.cpp
          test_compile_composite.cpp test_compile_materials.cpp test_compile_textures.cpp test_compile_lights.cpp
          test_compile_filter.cpp test_compile_environment.cpp test_compile_scenes.cpp)
