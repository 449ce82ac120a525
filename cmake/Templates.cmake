# SPDX-License-Identifier: BSD-3-Clause
# The files of xml/templates as texts in the program: generated/Templates.cpp defines templateFiles() of src/app/text/Templates.hpp.
file(GLOB template_files CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/xml/templates/*.*)
set(TEMPLATE_TEXTS)
foreach(file ${template_files})
  get_filename_component(name ${file} NAME)
  file(READ ${file} text)
  string(APPEND TEMPLATE_TEXTS "      {\"${name}\", R\"~(${text})~\"},\n")
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${file})
endforeach()
configure_file(${PROJECT_SOURCE_DIR}/cmake/Templates.cpp.in ${PROJECT_BINARY_DIR}/generated/Templates.cpp @ONLY)
target_sources(tooljoint PRIVATE ${PROJECT_BINARY_DIR}/generated/Templates.cpp)
