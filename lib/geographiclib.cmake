# viewproj_use_geographiclib(TARGET): links an installed GeographicLib, or compiles the four sources of it that are
# needed. VIEWPROJ_LINKS_GEOGRAPHICLIB is on if it links: users of the library then need GeographicLib too.
include(FetchContent)
if(POLICY CMP0135)
  cmake_policy(SET CMP0135 NEW)
endif()
include(${CMAKE_CURRENT_LIST_DIR}/package/geographiclib.cmake)
if(TARGET viewproj::geographiclib)
  set(VIEWPROJ_LINKS_GEOGRAPHICLIB ON)
else()
  set(VIEWPROJ_LINKS_GEOGRAPHICLIB OFF)
endif()

function(viewproj_use_geographiclib target)
  if(VIEWPROJ_LINKS_GEOGRAPHICLIB)
    target_link_libraries(${target} PRIVATE viewproj::geographiclib)
    return()
  endif()
  message(STATUS "GeographicLib is not installed: fetching it")
  # The folder include has no CMakeLists.txt, so its own build of tools and documentation does not run.
  FetchContent_Declare(GeographicLib SOURCE_SUBDIR include
    URL https://github.com/geographiclib/geographiclib/archive/refs/tags/v2.1.2.tar.gz
    URL_HASH SHA256=6833c4b33b2aa37b0c4c9fe1b36f958b44afafaafd1b16d7742d80c5e7737777)
  FetchContent_MakeAvailable(GeographicLib)
  set(fetched ${CMAKE_CURRENT_BINARY_DIR}/geographiclib)
  file(WRITE ${fetched}/GeographicLib/Config.h
    "#define GEOGRAPHICLIB_VERSION_STRING \"2.1.2\"\n#define GEOGRAPHICLIB_VERSION_MAJOR 2\n"
    "#define GEOGRAPHICLIB_VERSION_MINOR 1\n#define GEOGRAPHICLIB_VERSION_PATCH 2\n"
    "#define GEOGRAPHICLIB_HAVE_LONG_DOUBLE 1\n#define GEOGRAPHICLIB_WORDS_BIGENDIAN 0\n"
    "#define GEOGRAPHICLIB_DATA \"/usr/local/share/GeographicLib\"\n#define GEOGRAPHICLIB_PRECISION 2\n#define GEOGRAPHICLIB_SHARED_LIB 0\n")
  set(sources ${geographiclib_SOURCE_DIR}/src/Geocentric.cpp ${geographiclib_SOURCE_DIR}/src/Geoid.cpp
    ${geographiclib_SOURCE_DIR}/src/Math.cpp ${geographiclib_SOURCE_DIR}/src/Utility.cpp)
  set_source_files_properties(${sources} PROPERTIES COMPILE_OPTIONS -w)
  target_sources(${target} PRIVATE ${sources})
  target_include_directories(${target} SYSTEM PRIVATE ${fetched} ${geographiclib_SOURCE_DIR}/include)
endfunction()
