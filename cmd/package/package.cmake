# The documents that are installed, and the packages: cpack makes viewproj_VERSION_ARCHITECTURE.deb, and for Windows
# viewproj-VERSION-win64.zip.
set(changelog ${PROJECT_SOURCE_DIR}/cmd/package/changelog)
install(FILES README.md cmd/package/copyright DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(FILES lib/ACCURACY.md DESTINATION ${CMAKE_INSTALL_DOCDIR}/lib)
install(FILES cmd/README.md DESTINATION ${CMAKE_INSTALL_DOCDIR}/cmd)
install(FILES tests/README.md DESTINATION ${CMAKE_INSTALL_DOCDIR}/tests)
install(DIRECTORY samples DESTINATION ${CMAKE_INSTALL_DOCDIR} PATTERN samples/setup.sh EXCLUDE PATTERN samples/run.sh EXCLUDE)

if(WIN32)
  install(FILES ${changelog} DESTINATION ${CMAKE_INSTALL_DOCDIR})
else()
  # viewproj_gzip(FILE RESULT): compresses it into the build folder, the same bytes each time.
  find_program(GZIP gzip REQUIRED)
  mark_as_advanced(GZIP)
  function(viewproj_gzip file result)
    add_custom_command(OUTPUT ${result} COMMAND ${GZIP} -9nc ${file} > ${result} DEPENDS ${file} VERBATIM)
  endfunction()
  viewproj_gzip(${changelog} ${PROJECT_BINARY_DIR}/changelog.gz)
  add_custom_target(changelog ALL DEPENDS ${PROJECT_BINARY_DIR}/changelog.gz)
  install(FILES ${PROJECT_BINARY_DIR}/changelog.gz DESTINATION ${CMAKE_INSTALL_DOCDIR})
endif()

# Who makes the package, and when: as the newest entry says. The month is in words, as a manual page may have it.
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${changelog})
file(READ ${changelog} entries)
string(REGEX MATCH "\n -- ([^\n]*)  [A-Z][a-z]+, ([0-9]+) ([A-Z][a-z]+) ([0-9]+) " newest "${entries}")
set(CPACK_PACKAGE_CONTACT "${CMAKE_MATCH_1}")
set(VIEWPROJ_DATE "${CMAKE_MATCH_3} ${CMAKE_MATCH_2}, ${CMAKE_MATCH_4}")

set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
if(WIN32)
  set(CPACK_GENERATOR ZIP)
else()
  set(CPACK_GENERATOR DEB)
  set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
  # What the package has and an installation has not.
  set(CPACK_INSTALLED_DIRECTORIES ${PROJECT_SOURCE_DIR}/cmd/package/lintian /usr/share/lintian/overrides)
endif()
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
  OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
# For find_package(viewproj): the tool itself does not need it.
set(CPACK_DEBIAN_PACKAGE_DEPENDS libgeographiclib-dev)
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "world points to pixels, pixels to rays, cameras to matrices")
set(CPACK_DEBIAN_PACKAGE_DESCRIPTION
"A command-line tool and a C++20 library that turn world points into screen
coordinates, pixels into picking rays, and cameras into matrices, in OpenGL,
Direct3D or any other convention, each number the double nearest the true
one. Holds the command viewproj, the static library, its headers, and what
CMake and pkg-config find it by.")
include(CPack)
