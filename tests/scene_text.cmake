yat_test(
  scene_text
  LABELS fast
  LIBS yat_text
  SOURCES test_scene_text.cpp test_scene_errors.cpp test_includes.cpp test_scene_round_trip.cpp test_ply.cpp
          test_shared_scenes.cpp)
