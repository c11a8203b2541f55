# Every library yat needs, each from its distribution package. What is missing is named together
# with the package that brings it, all in one message.

set(yat_missing "")
macro(yat_need target package_debian)
  if(NOT TARGET ${target})
    list(APPEND yat_missing "  ${target}: install ${package_debian}")
  endif()
endmacro()

list(APPEND CMAKE_MODULE_PATH ${CMAKE_CURRENT_LIST_DIR})

find_package(Threads REQUIRED)
find_package(glm QUIET)
find_package(OpenImageIO QUIET)
find_package(TBB QUIET)
find_package(CLI11 QUIET)
find_package(fmt QUIET)
find_package(nlohmann_json QUIET)
find_package(xsimd QUIET)

yat_need(glm::glm libglm-dev)
yat_need(OpenImageIO::OpenImageIO libopenimageio-dev)
yat_need(TBB::tbb libtbb-dev)
yat_need(CLI11::CLI11 libcli11-dev)
yat_need(fmt::fmt libfmt-dev)
yat_need(nlohmann_json::nlohmann_json nlohmann-json3-dev)
if(NOT TARGET xsimd OR xsimd_VERSION VERSION_LESS 13)
  if(xsimd_VERSION)
    set(yat_xsimd_found " (found ${xsimd_VERSION})")
  endif()
  list(APPEND yat_missing
       "  xsimd 13 or newer${yat_xsimd_found}: install libxsimd-dev; where the distribution's is older, tools/setup.sh takes it from the next release")
endif()

if(YAT_BUILD_TESTS)
  find_package(GTest QUIET)
  yat_need(GTest::gtest_main libgtest-dev)
endif()
if(YAT_BUILD_BENCH)
  find_package(benchmark QUIET)
  yat_need(benchmark::benchmark libbenchmark-dev)
endif()

if(yat_missing)
  list(JOIN yat_missing "\n" yat_missing)
  message(FATAL_ERROR "yat needs packages that are not here:\n${yat_missing}\n"
                      "tools/setup.sh installs them all on Debian and Ubuntu.")
endif()
