# SPDX-License-Identifier: BSD-3-Clause
# The Python package tooljoint: python/core/ becomes its module tooljoint._core, python/tooljoint/ holds the rest. The build tree has a
# package that can be imported, ${PROJECT_BINARY_DIR}/python.
find_program(TOOLJOINT_PYTHON_EXECUTABLE python3 PATHS /usr/bin NO_DEFAULT_PATH)  # the distribution's, to which its numpy and scipy belong
find_program(TOOLJOINT_PYTHON_EXECUTABLE python3)
set(Python_EXECUTABLE ${TOOLJOINT_PYTHON_EXECUTABLE})
find_package(Python COMPONENTS Interpreter Development.Module QUIET)
find_package(pybind11 2.10 QUIET)
set(python_found OFF)
if(Python_Development.Module_FOUND AND pybind11_FOUND)
  set(python_found ON)
endif()
set(python_wanted ${python_found})
if(TOOLJOINT_SANITIZE)  # an interpreter without sanitizers cannot load the module
  set(python_wanted OFF)
endif()
option(TOOLJOINT_PYTHON "Build the Python package (pybind11)" ${python_wanted})
if(NOT TOOLJOINT_PYTHON OR NOT TARGET tooljoint_drillstring)
  message(STATUS "Python package: no (pybind11 ${pybind11_VERSION}, Python development files ${Python_VERSION}; TOOLJOINT_PYTHON is ${TOOLJOINT_PYTHON})")
  return()
endif()
if(NOT python_found)
  message(FATAL_ERROR "TOOLJOINT_PYTHON is ON, but pybind11 2.10 or the development files of Python are not there. Install pybind11-dev and "
    "python3-dev, or switch TOOLJOINT_PYTHON off.")
endif()
message(STATUS "Python package: yes (pybind11 ${pybind11_VERSION}, Python ${Python_VERSION}, ${Python_EXECUTABLE})")

file(GLOB_RECURSE core CONFIGURE_DEPENDS python/core/*.cpp)
pybind11_add_module(tooljoint_python MODULE NO_EXTRAS ${core})
set(package_in_build ${PROJECT_BINARY_DIR}/python/tooljoint)
file(MAKE_DIRECTORY ${package_in_build})
# Registries of the libraries are shared with them: default visibility.
set_target_properties(tooljoint_python PROPERTIES OUTPUT_NAME _core LIBRARY_OUTPUT_DIRECTORY ${package_in_build} CXX_VISIBILITY_PRESET default
  DEBUG_POSTFIX "")
target_include_directories(tooljoint_python PRIVATE python/core)
# Both libraries, linked even if the module uses only variants that register themselves.
target_link_libraries(tooljoint_python PRIVATE ${libraries} tooljoint_warnings)
target_link_options(tooljoint_python PRIVATE LINKER:--push-state,--no-as-needed,${files},--pop-state)
target_compile_options(tooljoint_python PRIVATE -Wno-attributes)  # pybind11 hides its own symbols, our classes hold its objects
tooljoint_use_headers(tooljoint_headers tooljoint_python)
tooljoint_unity_build(tooljoint_python)

# python/tooljoint/ as it stands, in the build tree and in the install tree.
file(GLOB modules RELATIVE ${PROJECT_SOURCE_DIR}/python/tooljoint CONFIGURE_DEPENDS python/tooljoint/*.py python/tooljoint/*.pyi python/tooljoint/py.typed)
foreach(module ${modules})
  file(CREATE_LINK ${PROJECT_SOURCE_DIR}/python/tooljoint/${module} ${package_in_build}/${module} SYMBOLIC)
endforeach()
file(CREATE_LINK ${PROJECT_SOURCE_DIR}/python/tooljoint/plots ${package_in_build}/plots SYMBOLIC)

# Search folder of Debian's interpreter below /usr; with another prefix set PYTHONPATH to the
# folder.
set(TOOLJOINT_PYTHON_DIR lib/python3/dist-packages CACHE STRING "Folder of the Python package below the prefix")
file(RELATIVE_PATH package_to_lib /prefix/${TOOLJOINT_PYTHON_DIR}/tooljoint /prefix/${CMAKE_INSTALL_LIBDIR})
set_target_properties(tooljoint_python PROPERTIES INSTALL_RPATH $ORIGIN/${package_to_lib})
install(TARGETS tooljoint_python LIBRARY DESTINATION ${TOOLJOINT_PYTHON_DIR}/tooljoint COMPONENT python)
list(TRANSFORM modules PREPEND python/tooljoint/)
install(FILES ${modules} DESTINATION ${TOOLJOINT_PYTHON_DIR}/tooljoint COMPONENT python)
install(DIRECTORY python/tooljoint/plots DESTINATION ${TOOLJOINT_PYTHON_DIR}/tooljoint COMPONENT python PATTERN "__pycache__" EXCLUDE)
