# SPDX-License-Identifier: BSD-3-Clause
# cmake --install: libraries, program, headers under include/tooljoint, find_package(Tooljoint); licence, documents, examples, scenes and tools
# under share/tooljoint.
include(CMakePackageConfigHelpers)

set(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME program)
set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/Tooljoint)
foreach(target toolkit drillstring)
  if(TARGET tooljoint_${target})
    set_property(TARGET tooljoint_${target} PROPERTY EXPORT_NAME ${target})
    install(TARGETS tooljoint_${target} EXPORT TooljointTargets LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} NAMELINK_COMPONENT dev
      INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
  endif()
endforeach()
if(TARGET tooljoint)
  install(TARGETS tooljoint RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
  include(cmake/Pages.cmake)
endif()
install(DIRECTORY src/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/tooljoint COMPONENT dev FILES_MATCHING PATTERN "*.hpp" PATTERN app EXCLUDE PATTERN texts EXCLUDE)
install(DIRECTORY substructures DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/tooljoint COMPONENT dev FILES_MATCHING PATTERN "*.hpp")
install(CODE "set(HEADERS \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_INCLUDEDIR}/tooljoint\")
  include(\"${PROJECT_SOURCE_DIR}/cmake/InstalledIncludes.cmake\")" COMPONENT dev)
# The same layout as in the source tree, so that links in the documents work.
install(FILES LICENSE README.md CHANGELOG.md CONTRIBUTING.md CITATION.cff DESTINATION ${CMAKE_INSTALL_DATADIR}/tooljoint)
install(DIRECTORY docs examples xml DESTINATION ${CMAKE_INSTALL_DATADIR}/tooljoint PATTERN ".*" EXCLUDE PATTERN "__pycache__" EXCLUDE
  PATTERN conf.py EXCLUDE PATTERN Doxyfile.in EXCLUDE)
install(PROGRAMS tools/first_run.py tools/plot_bha.py tools/plot_map.py tools/plot_response.py tools/plot_results.py tools/plot_study.py DESTINATION ${CMAKE_INSTALL_DATADIR}/tooljoint/tools)
# tools/plots is python/tooljoint/plots: the tools take it without the compiled package.
install(DIRECTORY python/tooljoint/plots tools/paraview tools/report DESTINATION ${CMAKE_INSTALL_DATADIR}/tooljoint/tools PATTERN "__pycache__" EXCLUDE)
# The program finds the scripts of its plots and reports beside itself, in the build tree as in the install tree.
file(GLOB scripts RELATIVE ${PROJECT_SOURCE_DIR} CONFIGURE_DEPENDS tools/plot_map.py tools/plot_study.py tools/paraview/*.* tools/plots/*.* tools/report/*.* tools/report/web/*.*)
foreach(script ${scripts})
  configure_file(${script} ${PROJECT_BINARY_DIR}/share/tooljoint/${script} COPYONLY)
endforeach()

install(EXPORT TooljointTargets NAMESPACE Tooljoint:: DESTINATION ${package_dir} COMPONENT dev)
configure_package_config_file(cmake/TooljointConfig.cmake.in ${PROJECT_BINARY_DIR}/TooljointConfig.cmake INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/TooljointConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/TooljointConfig.cmake ${PROJECT_BINARY_DIR}/TooljointConfigVersion.cmake cmake/TooljointTrilinos.cmake
  DESTINATION ${package_dir} COMPONENT dev)

include(cmake/Debian.cmake)
