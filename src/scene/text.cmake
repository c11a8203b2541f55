# Scene text and PLY files, without anything that renders: fuzzers and text tests link only this.
set(folder ${CMAKE_CURRENT_SOURCE_DIR})
add_library(
  yat_text STATIC
  ${folder}/directive_table.cpp ${folder}/directives.cpp ${folder}/graphics_state.cpp
  ${folder}/lexer.cpp ${folder}/parse.cpp ${folder}/ply.cpp ${folder}/ply_header.cpp
  ${folder}/print_description.cpp ${folder}/read_file.cpp ${folder}/scoped_names.cpp
  ${folder}/statement.cpp ${folder}/transforms.cpp ${folder}/world_directives.cpp)
target_link_libraries(yat_text PUBLIC yat_base glm::glm)
target_sources(yat_scene PRIVATE ${folder}/parse.h)
set_target_properties(yat_scene PROPERTIES LINKER_LANGUAGE CXX)
target_link_libraries(yat_scene PUBLIC yat_text)
