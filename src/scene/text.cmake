target_sources(yat_scene PRIVATE ${CMAKE_CURRENT_SOURCE_DIR}/parse.cpp)
