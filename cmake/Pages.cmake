# SPDX-License-Identifier: BSD-3-Clause
# Manual pages and completions that the program writes of its own command line, and their installation. As a script (cmake -P, with PROGRAM
# and FOLDER) it writes them: share/man/man1, share/bash-completion/completions and share/zsh/vendor-completions below FOLDER.
if(CMAKE_SCRIPT_MODE_FILE)
  # Open MPI starts no daemon for a program without mpiexec.
  set(ENV{OMPI_MCA_ess_singleton_isolated} 1)
  set(ENV{OMPI_MCA_orte_create_session_dirs} 0)
  # In a build with sanitizers leaks of Open MPI are ignored.
  set(ENV{LSAN_OPTIONS} suppressions=${CMAKE_CURRENT_LIST_DIR}/leaks.supp:print_suppressions=0:use_tls=0)
  function(tooljoint_page file)
    execute_process(COMMAND ${PROGRAM} doc ${ARGN} OUTPUT_VARIABLE text RESULT_VARIABLE failed)
    if(failed)
      message(FATAL_ERROR "${PROGRAM} doc ${ARGN} ended with ${failed}.")
    endif()
    file(WRITE ${FOLDER}/${file} "${text}")
  endfunction()
  file(REMOVE_RECURSE ${FOLDER})
  tooljoint_page(bash-completion/completions/tooljoint --format bash)
  tooljoint_page(zsh/vendor-completions/_tooljoint --format zsh)
  tooljoint_page(man/man1/tooljoint.1 --format man)
  # The pages that the first one refers to.
  file(READ ${FOLDER}/man/man1/tooljoint.1 text)
  string(REGEX MATCHALL "\n\\.BR tooljoint\\\\-[^ ]+" references "${text}")
  foreach(reference ${references})
    string(REGEX REPLACE "^\n\\.BR tooljoint\\\\-" "" command "${reference}")
    string(REPLACE "\\-" "-" command "${command}")
    tooljoint_page(man/man1/tooljoint-${command}.1 ${command} --format man)
  endforeach()
  return()
endif()

set(pages ${PROJECT_BINARY_DIR}/pages)
add_custom_command(OUTPUT ${PROJECT_BINARY_DIR}/pages.stamp
  COMMAND ${CMAKE_COMMAND} -D PROGRAM=$<TARGET_FILE:tooljoint> -D FOLDER=${pages} -P ${PROJECT_SOURCE_DIR}/cmake/Pages.cmake
  COMMAND ${CMAKE_COMMAND} -E touch ${PROJECT_BINARY_DIR}/pages.stamp
  DEPENDS tooljoint ${PROJECT_SOURCE_DIR}/cmake/Pages.cmake VERBATIM COMMENT "Writing manual pages and completions")
add_custom_target(tooljoint_pages ALL DEPENDS ${PROJECT_BINARY_DIR}/pages.stamp)
install(DIRECTORY ${pages}/man/ DESTINATION ${CMAKE_INSTALL_MANDIR} COMPONENT program OPTIONAL)
install(DIRECTORY ${pages}/bash-completion ${pages}/zsh DESTINATION ${CMAKE_INSTALL_DATADIR} COMPONENT program OPTIONAL)
