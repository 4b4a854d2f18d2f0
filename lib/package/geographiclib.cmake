# viewproj::geographiclib: an installed GeographicLib, where there is one. Debian's has no package config.
if(NOT TARGET viewproj::geographiclib)
  find_path(GEOGRAPHICLIB_INCLUDE GeographicLib/Geocentric.hpp)
  # The static library comes first: loading a shared one takes a part of a one-shot run.
  find_library(GEOGRAPHICLIB_LIBRARY NAMES libGeographicLib.a GeographicLib)
  mark_as_advanced(GEOGRAPHICLIB_INCLUDE GEOGRAPHICLIB_LIBRARY)
  if(GEOGRAPHICLIB_INCLUDE AND GEOGRAPHICLIB_LIBRARY)
    add_library(viewproj::geographiclib UNKNOWN IMPORTED GLOBAL)
    set_target_properties(viewproj::geographiclib PROPERTIES
      IMPORTED_LOCATION "${GEOGRAPHICLIB_LIBRARY}" INTERFACE_INCLUDE_DIRECTORIES "${GEOGRAPHICLIB_INCLUDE}")
  endif()
endif()
