# viewproj_geographiclib: an installed GeographicLib, or the sources of it that the library needs.
add_library(viewproj_geographiclib INTERFACE)
# The static library comes first: loading a shared one takes a part of a one-shot run.
set(GeographicLib_USE_STATIC_LIBS ON)
find_package(GeographicLib QUIET CONFIG)
# Debian's has no package config.
find_path(GEOGRAPHICLIB_INCLUDE GeographicLib/Geocentric.hpp)
find_library(GEOGRAPHICLIB_LIBRARY NAMES libGeographicLib.a GeographicLib)
mark_as_advanced(GEOGRAPHICLIB_INCLUDE GEOGRAPHICLIB_LIBRARY)
if(GeographicLib_FOUND)
  target_link_libraries(viewproj_geographiclib INTERFACE ${GeographicLib_LIBRARIES})
elseif(GEOGRAPHICLIB_INCLUDE AND GEOGRAPHICLIB_LIBRARY)
  target_include_directories(viewproj_geographiclib SYSTEM INTERFACE ${GEOGRAPHICLIB_INCLUDE})
  target_link_libraries(viewproj_geographiclib INTERFACE ${GEOGRAPHICLIB_LIBRARY})
else()
  message(STATUS "GeographicLib is not installed: fetching it")
  # Its own build makes tools and documentation too; there is no CMakeLists.txt in include.
  FetchContent_Declare(GeographicLib SOURCE_SUBDIR include
    URL https://github.com/geographiclib/geographiclib/archive/refs/tags/v2.1.2.tar.gz)
  FetchContent_MakeAvailable(GeographicLib)
  set(fetched ${CMAKE_CURRENT_BINARY_DIR}/geographiclib)
  file(WRITE ${fetched}/GeographicLib/Config.h
    "#define GEOGRAPHICLIB_VERSION_STRING \"2.1.2\"\n#define GEOGRAPHICLIB_VERSION_MAJOR 2\n"
    "#define GEOGRAPHICLIB_VERSION_MINOR 1\n#define GEOGRAPHICLIB_VERSION_PATCH 2\n"
    "#define GEOGRAPHICLIB_HAVE_LONG_DOUBLE 1\n#define GEOGRAPHICLIB_WORDS_BIGENDIAN 0\n"
    "#define GEOGRAPHICLIB_PRECISION 2\n#define GEOGRAPHICLIB_SHARED_LIB 0\n")
  add_library(geographiclib STATIC ${geographiclib_SOURCE_DIR}/src/Geocentric.cpp ${geographiclib_SOURCE_DIR}/src/Math.cpp)
  target_include_directories(geographiclib SYSTEM PUBLIC ${fetched} ${geographiclib_SOURCE_DIR}/include)
  set_target_properties(geographiclib PROPERTIES CXX_STANDARD 14)
  target_link_libraries(viewproj_geographiclib INTERFACE geographiclib)
endif()
