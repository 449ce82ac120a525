# SPDX-License-Identifier: BSD-3-Clause
# Finds MPI, parallel HDF5, Eigen and Trilinos and gives them as Tooljoint::trilinos. Used by the build and, installed beside TooljointConfig.cmake,
# by clients: the only file with the target names of Trilinos 13.2.
include(CMakeFindDependencyMacro)

# FindHDF5 compiles C; a project of LANGUAGES CXX gets the language here.
get_property(languages GLOBAL PROPERTY ENABLED_LANGUAGES)
if(NOT "C" IN_LIST languages)
  enable_language(C)
endif()

set(HDF5_PREFER_PARALLEL ON)
find_dependency(MPI COMPONENTS CXX)
find_dependency(HDF5 COMPONENTS C)
if(NOT HDF5_IS_PARALLEL)
  message(FATAL_ERROR "HDF5 without MPI found, and Trilinos needs the one with MPI: install libhdf5-openmpi-dev")
endif()
find_dependency(Eigen3 NO_MODULE)
find_dependency(Trilinos 13.2 COMPONENTS Teuchos Tpetra Belos Anasazi Amesos2 Thyra NOX Stratimikos)

# Trilinos 13 attaches no include directories to its targets; later versions have Trilinos::all_libs. Imported, hence SYSTEM: warnings of its headers stay quiet.
if(NOT TARGET Tooljoint::trilinos)
  add_library(Tooljoint::trilinos INTERFACE IMPORTED)
  if(TARGET Trilinos::all_libs)
    set_property(TARGET Tooljoint::trilinos PROPERTY INTERFACE_LINK_LIBRARIES Trilinos::all_libs MPI::MPI_CXX)
  else()
    # It names folders of optional packages (Scotch, for one) that need not be installed.
    foreach(folder ${Trilinos_INCLUDE_DIRS} ${Trilinos_TPL_INCLUDE_DIRS})
      if(IS_DIRECTORY ${folder})
        set_property(TARGET Tooljoint::trilinos APPEND PROPERTY INTERFACE_INCLUDE_DIRECTORIES ${folder})
      endif()
    endforeach()
    set_property(TARGET Tooljoint::trilinos PROPERTY INTERFACE_LINK_LIBRARIES ${Trilinos_LIBRARIES} MPI::MPI_CXX)
  endif()
endif()
