# OpenImageIO by its headers and libraries, not by its installed configuration: the distributions'
# names the command line tools and (through Imath's) a Python library, of packages that the library
# does not depend on, and complains or gives up where they are not installed.
#
# Honours OpenImageIO_ROOT and CMAKE_PREFIX_PATH. Sets OpenImageIO_FOUND, OpenImageIO_VERSION and the
# target OpenImageIO::OpenImageIO.

find_path(OpenImageIO_INCLUDE_DIR OpenImageIO/imageio.h)
find_library(OpenImageIO_LIBRARY OpenImageIO)
find_library(OpenImageIO_Util_LIBRARY OpenImageIO_Util)
mark_as_advanced(OpenImageIO_INCLUDE_DIR OpenImageIO_LIBRARY OpenImageIO_Util_LIBRARY)

set(OpenImageIO_VERSION "")
if(OpenImageIO_INCLUDE_DIR)
  foreach(part MAJOR MINOR PATCH)
    file(STRINGS "${OpenImageIO_INCLUDE_DIR}/OpenImageIO/oiioversion.h" line
         REGEX "^#define OIIO_VERSION_${part} +[0-9]+")
    string(REGEX MATCH "[0-9]+" number "${line}")
    list(APPEND OpenImageIO_VERSION "${number}")
  endforeach()
  list(JOIN OpenImageIO_VERSION "." OpenImageIO_VERSION)
endif()

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(
  OpenImageIO
  REQUIRED_VARS OpenImageIO_LIBRARY OpenImageIO_Util_LIBRARY OpenImageIO_INCLUDE_DIR
  VERSION_VAR OpenImageIO_VERSION)

if(OpenImageIO_FOUND AND NOT TARGET OpenImageIO::OpenImageIO)
  add_library(OpenImageIO::OpenImageIO UNKNOWN IMPORTED)
  set_target_properties(
    OpenImageIO::OpenImageIO
    PROPERTIES IMPORTED_LOCATION "${OpenImageIO_LIBRARY}"
               INTERFACE_INCLUDE_DIRECTORIES "${OpenImageIO_INCLUDE_DIR}"
               INTERFACE_LINK_LIBRARIES "${OpenImageIO_Util_LIBRARY}")
endif()
