# SPDX-License-Identifier: BSD-3-Clause
# Files as texts in the libraries and the program: xml/templates as templateFiles() of src/texts/Templates.hpp, xml/components as
# componentLibraries() of substructures/drillstring/assembly/Libraries.hpp.

# tooljoint_texts(TARGET NAME KEY FILES...): cmake/NAME.cpp.in with the FILES as TEXTS, each under its KEY (NAME, NAME_WE), is a source of TARGET.
function(tooljoint_texts target name key)
  set(TEXTS)
  foreach(file ${ARGN})
    get_filename_component(called ${file} ${key})
    file(READ ${file} text)
    string(APPEND TEXTS "      {\"${called}\", R\"~(${text})~\"},\n")
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${file})
  endforeach()
  configure_file(${PROJECT_SOURCE_DIR}/cmake/${name}.cpp.in ${PROJECT_BINARY_DIR}/generated/${name}.cpp @ONLY)
  target_sources(${target} PRIVATE ${PROJECT_BINARY_DIR}/generated/${name}.cpp)
endfunction()
