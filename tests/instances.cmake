yat_test(instances LABELS fast per_isa LIBS yat_wavefront glm::glm SOURCES test_instances.cpp)
    yat_test(instance_renders LABELS render statistics per_isa LIBS yat_wavefront glm::glm SOURCES
                 test_instance_renders.cpp)
        yat_test(instance_memory LABELS fast LIBS yat_wavefront SOURCES test_instance_memory.cpp)
