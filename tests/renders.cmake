yat_test(work LABELS fast LIBS yat_wavefront SOURCES test_work.cpp)
yat_test(plan LABELS fast LIBS yat_wavefront SOURCES test_plan.cpp)
yat_test(renders LABELS render statistics per_isa LIBS yat_wavefront SOURCES test_renders.cpp)
yat_test(pilot LABELS render per_isa LIBS yat_wavefront SOURCES test_pilot.cpp)
yat_test(determinism LABELS render per_isa LIBS yat_wavefront SOURCES test_determinism.cpp)
yat_test(oracle LABELS render statistics per_isa LIBS yat_wavefront SOURCES test_oracle.cpp)
yat_test(spawned_rays LABELS fast per_isa LIBS yat_wavefront SOURCES test_spawned_rays.cpp)
yat_test(material_renders LABELS render statistics per_isa LIBS yat_wavefront
         SOURCES test_material_renders.cpp)
yat_test(features LABELS render per_isa LIBS yat_wavefront SOURCES test_features.cpp)

yat_test(split LABELS render statistics per_isa LIBS yat_wavefront SOURCES test_split.cpp)
yat_test(composites LABELS render statistics per_isa LIBS yat_wavefront glm::glm
         SOURCES test_composites.cpp)
yat_test(zsobol LABELS render statistics LIBS yat_wavefront SOURCES test_zsobol.cpp test_zsobol_pictures.cpp)
