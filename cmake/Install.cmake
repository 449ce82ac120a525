# SPDX-License-Identifier: BSD-3-Clause
# cmake --install: libraries, program, headers under include/tooljoint, scenes under share/tooljoint/xml, and find_package(Tooljoint).
include(CMakePackageConfigHelpers)

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/Tooljoint)
foreach(target toolkit drillstring)
  if(TARGET tooljoint_${target})
    set_property(TARGET tooljoint_${target} PROPERTY EXPORT_NAME ${target})
    install(TARGETS tooljoint_${target} EXPORT TooljointTargets LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}
      INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/tooljoint)
  endif()
endforeach()
if(TARGET tooljoint)
  install(TARGETS tooljoint RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
endif()
install(DIRECTORY src/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/tooljoint FILES_MATCHING PATTERN "*.hpp" PATTERN app EXCLUDE)
install(DIRECTORY substructures DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/tooljoint FILES_MATCHING PATTERN "*.hpp")
install(DIRECTORY xml DESTINATION ${CMAKE_INSTALL_DATADIR}/tooljoint OPTIONAL)
# The program finds its scripts beside itself, in the build tree as in the install tree.
foreach(script plot_study.py)
  configure_file(tools/${script} ${PROJECT_BINARY_DIR}/share/tooljoint/tools/${script} COPYONLY)
  install(PROGRAMS tools/${script} DESTINATION ${CMAKE_INSTALL_DATADIR}/tooljoint/tools)
endforeach()

install(EXPORT TooljointTargets NAMESPACE Tooljoint:: DESTINATION ${package_dir})
configure_package_config_file(cmake/TooljointConfig.cmake.in ${PROJECT_BINARY_DIR}/TooljointConfig.cmake INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/TooljointConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/TooljointConfig.cmake ${PROJECT_BINARY_DIR}/TooljointConfigVersion.cmake cmake/TooljointTrilinos.cmake
  DESTINATION ${package_dir})
