yat_test(shapes LABELS fast per_isa LIBS yat_wavefront glm::glm SOURCES test_shapes.cpp
                                                                        test_shape_lights.cpp test_shape_tangents.cpp)
yat_test(shape_renders LABELS render statistics per_isa LIBS yat_wavefront glm::glm
             OpenImageIO::OpenImageIO SOURCES
             test_shape_renders.cpp test_shape_materials.cpp)
