# Installs the libraries, the public headers, and the files by which CMake and pkg-config find them.
include(CMakePackageConfigHelpers)

install(DIRECTORY viewproj DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} FILES_MATCHING PATTERN *.hpp
  PATTERN cameras_of.hpp EXCLUDE PATTERN scene.hpp EXCLUDE PATTERN geodesy.hpp EXCLUDE)
set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/viewproj)
file(RELATIVE_PATH prefix_from_pkgconfig /${CMAKE_INSTALL_LIBDIR}/pkgconfig /)
string(REGEX REPLACE "/$" "" prefix_from_pkgconfig ${prefix_from_pkgconfig})

# viewproj_install_part(PART REQUIRES LIBRARIES): installs a target, its export and its pkg-config file, which lists
# REQUIRES and LIBRARIES.
function(viewproj_install_part part requires libraries)
  set(name viewproj)
  set(package viewproj)
  if(NOT part STREQUAL viewproj)
    set(name viewproj_${part})
    set(package viewproj-${part})
    install(FILES viewproj/${part}.hpp DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/viewproj)
  endif()
  install(TARGETS lib${name} EXPORT ${package}-targets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
  install(EXPORT ${package}-targets NAMESPACE viewproj:: DESTINATION ${package_folder})
  configure_file(package/viewproj.pc.in ${package}.pc @ONLY)
  install(FILES ${CMAKE_CURRENT_BINARY_DIR}/${package}.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
endfunction()
viewproj_install_part(viewproj "" "")
if(VIEWPROJ_CAMERAS_OF)
  viewproj_install_part(cameras_of viewproj "")
endif()
if(VIEWPROJ_SCENE)
  viewproj_install_part(scene viewproj "")
endif()
if(VIEWPROJ_GEODESY)
  set(libraries "")
  if(VIEWPROJ_LINKS_GEOGRAPHICLIB)
    install(FILES package/geographiclib.cmake DESTINATION ${package_folder})
    set(libraries " -lGeographicLib")
  endif()
  viewproj_install_part(geodesy viewproj "${libraries}")
endif()

configure_file(package/viewprojConfig.cmake.in viewprojConfig.cmake @ONLY)
write_basic_package_version_file(viewprojConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/viewprojConfig.cmake ${CMAKE_CURRENT_BINARY_DIR}/viewprojConfigVersion.cmake
  DESTINATION ${package_folder})
