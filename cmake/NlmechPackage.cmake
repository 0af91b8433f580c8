# `make package`: a Debian package of programs, library, headers, pages, manual pages and completions, by CPack (scripts/package).
install(FILES ${PROJECT_SOURCE_DIR}/README.md ${PROJECT_SOURCE_DIR}/CHANGELOG.md ${PROJECT_SOURCE_DIR}/KNOWN_ISSUES.md
              ${PROJECT_SOURCE_DIR}/CITATION.cff DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} RENAME copyright)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/examples DESTINATION ${CMAKE_INSTALL_DOCDIR})
# The book is made after the programs, and installed by the package alone.
install(DIRECTORY ${PROJECT_BINARY_DIR}/book/html DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT book EXCLUDE_FROM_ALL)

# All that is installed beside the book: no test is built for it.
get_property(installed GLOBAL PROPERTY NLMECH_INSTALLED)
list(TRANSFORM installed PREPEND nlmech_)
add_custom_target(installables DEPENDS ${installed})
if(TARGET programs)
  add_dependencies(installables programs)
endif()
if(TARGET nlmech_core)
  add_dependencies(installables nlmech_core)
endif()

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME nlmech)
set(CPACK_PACKAGE_VENDOR "The nlmech authors")
set(CPACK_PACKAGE_CONTACT "The nlmech authors <authors@nlmech.invalid>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "nonlinear mechanics: programs and a C++20 library")
set(CPACK_DEBIAN_PACKAGE_DESCRIPTION
    "Nonlinear problems of structural and celestial mechanics, reproduced from\nthe equations up: a program for each chapter, the static library behind\nthem with its headers, and all chapters as a book.")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_CMAKE_PROJECTS "${PROJECT_BINARY_DIR};nlmech;ALL;/" "${PROJECT_BINARY_DIR};nlmech;book;/")
if(TARGET nlmech_core)
  list(APPEND CPACK_INSTALL_CMAKE_PROJECTS "${PROJECT_BINARY_DIR};nlmech;python;/")
  set(CPACK_DEBIAN_PACKAGE_PROVIDES python3-nlmech)
endif()
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_DEPENDS gnuplot-nox)  # beside the libraries: what draws figures
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "g++, libboost-dev, libeigen3-dev, libfmt-dev, python3-numpy")  # what programs on the library need
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "cmake, pkg-config")
include(CPack)
