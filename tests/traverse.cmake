yat_test(tree_build LABELS fast LIBS yat_scene SOURCES test_tree_build.cpp)
yat_test(traverse LABELS fast per_isa LIBS yat_scene yat_kernels SOURCES test_traverse.cpp
                                                                         test_traverse_limits.cpp
                                                                         test_traverse_tiles.cpp
                                                                         test_traverse_adversarial.cpp)
yat_test(quadrics LABELS fast per_isa LIBS yat_kernels SOURCES test_quadrics.cpp)
