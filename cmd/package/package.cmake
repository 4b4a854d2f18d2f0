# Installs the documents and sets up the packages: cpack makes viewproj_VERSION_ARCHITECTURE.deb, and
# viewproj-VERSION-win64.zip for Windows.
set(changelog ${PROJECT_SOURCE_DIR}/cmd/package/changelog)
install(FILES README.md cmd/package/copyright DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(FILES lib/README.md lib/ACCURACY.md lib/INTEROPERATION.md DESTINATION ${CMAKE_INSTALL_DOCDIR}/lib)
install(FILES cmd/README.md cmd/MANUAL.md cmd/QUESTIONS.md DESTINATION ${CMAKE_INSTALL_DOCDIR}/cmd)
install(FILES tests/README.md DESTINATION ${CMAKE_INSTALL_DOCDIR}/tests)
install(FILES tests/importers/README.md DESTINATION ${CMAKE_INSTALL_DOCDIR}/tests/importers)
install(FILES tests/rasterisers/README.md DESTINATION ${CMAKE_INSTALL_DOCDIR}/tests/rasterisers)
install(DIRECTORY samples DESTINATION ${CMAKE_INSTALL_DOCDIR} PATTERN samples/setup.sh EXCLUDE PATTERN samples/run.sh EXCLUDE)

set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${changelog})
if(WIN32)
  install(FILES ${changelog} DESTINATION ${CMAKE_INSTALL_DOCDIR})
else()
  find_program(GZIP gzip REQUIRED)
  mark_as_advanced(GZIP)
  set(manual ${PROJECT_SOURCE_DIR}/cmd/data/viewproj.1)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${manual})
  foreach(file ${changelog} ${manual})
    get_filename_component(name ${file} NAME)
    execute_process(COMMAND ${GZIP} -9nc ${file} OUTPUT_FILE ${PROJECT_BINARY_DIR}/${name}.gz COMMAND_ERROR_IS_FATAL ANY)
  endforeach()
  install(FILES ${PROJECT_BINARY_DIR}/changelog.gz DESTINATION ${CMAKE_INSTALL_DOCDIR})
  install(FILES ${PROJECT_BINARY_DIR}/viewproj.1.gz DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
  install(FILES cmd/data/viewproj.bash DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions RENAME viewproj)
endif()

# The maintainer of the package is the one of the newest entry in the changelog.
file(READ ${changelog} entries)
string(REGEX MATCH "\n -- ([^\n]*)  " newest "${entries}")
set(CPACK_PACKAGE_CONTACT "${CMAKE_MATCH_1}")

set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
if(WIN32)
  set(CPACK_GENERATOR ZIP)
else()
  set(CPACK_GENERATOR DEB)
  set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
  # This is in the package, but not in an installation.
  set(CPACK_INSTALLED_DIRECTORIES ${PROJECT_SOURCE_DIR}/cmd/package/lintian /usr/share/lintian/overrides)
endif()
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
  OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
# Needed for find_package(viewproj), but not by the tool.
set(CPACK_DEBIAN_PACKAGE_DEPENDS libgeographiclib-dev)
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "world points to pixels, pixels to rays, cameras to matrices")
set(CPACK_DEBIAN_PACKAGE_DESCRIPTION
"A command-line tool and a C++20 library that turn world points into screen
coordinates, pixels into picking rays, and cameras into matrices, in OpenGL,
Direct3D or any other convention. Results are correctly rounded. Contains the
command viewproj, the static library, its headers, and the files by which
CMake and pkg-config find it.")
include(CPack)
