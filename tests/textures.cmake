# Textures: kernels, images, renders.
yat_test(texture_steps LABELS per_isa LIBS yat_wavefront glm::glm
         SOURCES test_texture_steps.cpp test_texture_patterns.cpp)
yat_test(image_store LABELS fast LIBS yat_scene OpenImageIO::OpenImageIO SOURCES test_image_store.cpp)
yat_test(texture_renders LABELS render statistics per_isa LIBS yat_wavefront OpenImageIO::OpenImageIO
         SOURCES test_texture_renders.cpp)
yat_test(yart_textures LABELS fast LIBS yat_wavefront glm::glm OpenImageIO::OpenImageIO
         SOURCES test_yart_textures.cpp)
