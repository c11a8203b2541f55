# yat converge: the statistics against known answers, and the command.
yat_test(converge LABELS fast LIBS yat_converge OpenImageIO::OpenImageIO nlohmann_json::nlohmann_json SOURCES
         test_converge_statistics.cpp test_converge_summary.cpp test_converge_folder.cpp
         test_converge_report.cpp)
yat_test(converge_program LABELS fast LIBS yat_app nlohmann_json::nlohmann_json SOURCES
         test_converge_options.cpp test_converge_program.cpp)
add_dependencies(test_converge_program yat)
target_compile_definitions(test_converge_program PRIVATE YAT_PROGRAM="$<TARGET_FILE:yat>")
