# The two dialects, YART's command line, cameras, stratified samplers.
yat_test(dialect LABELS fast LIBS yat_wavefront glm::glm SOURCES test_dialect.cpp)
yat_test(yart_options LABELS fast LIBS yat_app SOURCES test_yart_options.cpp)
yat_test(yart_program LABELS fast LIBS OpenImageIO::OpenImageIO SOURCES test_yart_program.cpp)
add_dependencies(test_yart_program yat)
target_compile_definitions(test_yart_program PRIVATE YAT_PROGRAM="$<TARGET_FILE:yat>")
yat_test(cameras LABELS fast per_isa LIBS yat_wavefront SOURCES test_cameras.cpp)
yat_test(strata LABELS fast statistics LIBS yat_kernels SOURCES test_strata.cpp)
