# Makes viewproj::geographiclib if GeographicLib is installed. Debian's has no package config.
if(NOT TARGET viewproj::geographiclib)
  find_path(GEOGRAPHICLIB_INCLUDE GeographicLib/Geocentric.hpp)
  # The static library is preferred: loading a shared one slows down short runs.
  find_library(GEOGRAPHICLIB_LIBRARY NAMES libGeographicLib.a GeographicLib)
  mark_as_advanced(GEOGRAPHICLIB_INCLUDE GEOGRAPHICLIB_LIBRARY)
  if(GEOGRAPHICLIB_INCLUDE AND GEOGRAPHICLIB_LIBRARY)
    add_library(viewproj::geographiclib UNKNOWN IMPORTED GLOBAL)
    set_target_properties(viewproj::geographiclib PROPERTIES
      IMPORTED_LOCATION "${GEOGRAPHICLIB_LIBRARY}" INTERFACE_INCLUDE_DIRECTORIES "${GEOGRAPHICLIB_INCLUDE}")
  endif()
endif()
