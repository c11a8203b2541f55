# cmake -DSOURCE_DIR=... -DOUTPUT=... -P git_commit.cmake
#
# Writes the commit of the checkout as a C string, touching the file only when it changed: it runs in
# every build. A tree without git (a release archive) says "unknown".

set(commit "")
find_program(git_program git)
if(git_program)
  execute_process(
    COMMAND ${git_program} -C "${SOURCE_DIR}" describe --always --dirty=+ --abbrev=12 --exclude=*
    OUTPUT_VARIABLE commit
    OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
endif()
if(commit STREQUAL "")
  set(commit "unknown")
endif()
set(text "\"${commit}\"\n")
set(old "")
if(EXISTS "${OUTPUT}")
  file(READ "${OUTPUT}" old)
endif()
if(NOT text STREQUAL old)
  file(WRITE "${OUTPUT}" "${text}")
endif()
