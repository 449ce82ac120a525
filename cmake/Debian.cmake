# SPDX-License-Identifier: BSD-3-Clause
# cpack: the Debian packages tooljoint (program, libraries, documents, scenes), libtooljoint-dev (headers, find_package) and
# python3-tooljoint (the Python package, where it is built). dpkg-shlibdeps determines the
# dependencies; cmake/DebianFiles.cmake brings the installed files into the form of the
# distribution.
if(NOT UNIX OR APPLE)
  return()
endif()
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME tooljoint)
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "component mode synthesis and drillstring simulator")
set(CPACK_PACKAGE_VENDOR "The Tooljoint developers")
set(TOOLJOINT_MAINTAINER "The Tooljoint developers <tooljoint@example.org>" CACHE STRING "Who answers for the Debian packages")
set(CPACK_PACKAGE_CONTACT "${TOOLJOINT_MAINTAINER}")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_COMPONENTS_ALL program dev)
if(TARGET tooljoint_python)
  list(APPEND CPACK_COMPONENTS_ALL python)
endif()
set(CPACK_COMPONENTS_GROUPING ONE_PER_GROUP)
set(CPACK_PRE_BUILD_SCRIPTS ${PROJECT_SOURCE_DIR}/cmake/DebianFiles.cmake)
set(CPACK_TOOLJOINT_CHANGES ${PROJECT_SOURCE_DIR}/CHANGELOG.md)
set(CPACK_TOOLJOINT_LICENCE ${PROJECT_SOURCE_DIR}/LICENSE)

set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_PRIORITY optional)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)

set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME tooljoint)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${PROJECT_BINARY_DIR})
# Dependencies of packages that link to the libraries, and the cache of the loader.
set(control ${PROJECT_BINARY_DIR}/debian)
file(WRITE ${control}/triggers "activate-noawait ldconfig\n")
file(WRITE ${control}/shlibs "")
foreach(library toolkit drillstring)
  file(APPEND ${control}/shlibs
    "libtooljoint_${library} ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR} tooljoint (= ${PROJECT_VERSION})\n")
endforeach()
set(CPACK_DEBIAN_PROGRAM_PACKAGE_CONTROL_EXTRA ${control}/triggers ${control}/shlibs)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_RECOMMENDS "python3, python3-numpy, python3-h5py, python3-matplotlib, libjs-three, openmpi-bin, libopenblas0-serial")
set(CPACK_DEBIAN_PROGRAM_DESCRIPTION "Tooljoint computes the motion of structures from reduced parts. From one
deck it bends a drillstring into its well, finds the equilibrium in contact
with the wall, reduces the parts and integrates the motion. Parts of other
structures are imported from files.")

set(CPACK_DEBIAN_DEV_PACKAGE_NAME libtooljoint-dev)
set(CPACK_DEBIAN_DEV_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEV_PACKAGE_SHLIBDEPS OFF)
set(CPACK_DEBIAN_DEV_PACKAGE_DEPENDS
  "tooljoint (= ${PROJECT_VERSION}), libopenmpi-dev, libhdf5-openmpi-dev, trilinos-all-dev, libptscotch-dev, libeigen3-dev")
set(CPACK_DEBIAN_DEV_DESCRIPTION "Headers of the libraries behind Tooljoint and the files with which CMake
finds them: find_package(Tooljoint).")

set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-tooljoint)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SHLIBDEPS ON)
math(EXPR next_python "${Python_VERSION_MINOR} + 1")
set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "tooljoint (= ${PROJECT_VERSION}), python3 (>= 3.${Python_VERSION_MINOR}~), python3 (<< 3.${next_python}), python3-numpy, python3-scipy")
set(CPACK_DEBIAN_PYTHON_PACKAGE_RECOMMENDS "python3-matplotlib")
set(CPACK_DEBIAN_PYTHON_DESCRIPTION "Tooljoint in Python: parts from scipy matrices, their reduction, coupling,
modes, error estimates and motions; decks that are read, changed and run in
process; bases and point laws written in Python.")
include(CPack)
