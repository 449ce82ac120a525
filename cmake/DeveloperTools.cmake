# SPDX-License-Identifier: BSD-3-Clause
# Targets for developers: `cms-variants` runs all bases anew and rewrites docs/cms-variants.md, `records` writes all tables and figures of record, `format` rewrites the sources with clang-format and yapf3, `tidy` runs clang-tidy (in a build of its own, over the sources that are compiled together), `mutants` runs the mutation check of tools/mutants in a copy of the sources.
find_program(CLANG_FORMAT clang-format)
find_program(YAPF yapf3)
if(CLANG_FORMAT AND YAPF)
  file(GLOB_RECURSE formatted CONFIGURE_DEPENDS src/*.[ch]pp substructures/*.[ch]pp tests/*.[ch]pp examples/*.[ch]pp benchmarks/*.[ch]pp)
  add_custom_target(format COMMAND ${CLANG_FORMAT} -i ${formatted}
    COMMAND ${YAPF} --in-place --parallel --recursive docs examples python tests tools xml WORKING_DIRECTORY ${PROJECT_SOURCE_DIR} VERBATIM)
endif()

find_program(RUN_CLANG_TIDY run-clang-tidy)
if(RUN_CLANG_TIDY)
  # The sources of a folder together: headers are read once for all of them. The analyzer takes included sources for headers, hence its
  # option. Clang does not know all warnings that GCC is told to leave out.
  add_custom_target(tidy
    COMMAND ${CMAKE_COMMAND} -S ${PROJECT_SOURCE_DIR} -B ${PROJECT_BINARY_DIR}/tidy -G Ninja -D TOOLJOINT_PCH=OFF -D TOOLJOINT_UNITY=ON
      -D TOOLJOINT_SUNDIALS=${TOOLJOINT_SUNDIALS} -D TOOLJOINT_PYTHON=OFF -D TOOLJOINT_BENCHMARKS=OFF -D BUILD_TESTING=OFF
    COMMAND ${CMAKE_COMMAND} --build ${PROJECT_BINARY_DIR}/tidy --target tooljoint_git_hash
    COMMAND ${RUN_CLANG_TIDY} -quiet -j 2 -p ${PROJECT_BINARY_DIR}/tidy -extra-arg=-Wno-unknown-warning-option
      -extra-arg=-Xclang -extra-arg=-analyzer-opt-analyze-headers
      "^${PROJECT_SOURCE_DIR}/(src|substructures)/" "^${PROJECT_BINARY_DIR}/tidy/generated/tooljoint"
    WORKING_DIRECTORY ${PROJECT_SOURCE_DIR} USES_TERMINAL VERBATIM)
endif()

# `sources-alone` checks the syntax of every source of the libraries and the program without precompiled headers: does it include what it uses?
add_library(sources-alone OBJECT EXCLUDE_FROM_ALL ${solvers} ${toolkit} ${parts} ${app})
target_link_libraries(sources-alone PRIVATE tooljoint_everything LibXml2::LibXml2 nlohmann_json::nlohmann_json cereal::cereal fmt::fmt
  OpenSSL::Crypto)
target_compile_options(sources-alone PRIVATE -fsyntax-only)
set_property(TARGET sources-alone PROPERTY EXPORT_COMPILE_COMMANDS OFF)

find_program(PYTHON3_FOR_FIGURES NAMES /usr/bin/python3 python3)
if(PYTHON3_FOR_FIGURES)
  add_custom_target(cms-variants COMMAND ${PYTHON3_FOR_FIGURES} ${PROJECT_SOURCE_DIR}/tools/cms_variants.py --program $<TARGET_FILE:tooljoint>
    --work ${PROJECT_BINARY_DIR}/cms_variants --fresh DEPENDS tooljoint USES_TERMINAL VERBATIM)
endif()

# Every table and figure of record, one after the other so that times are those of one run; hours. Runs that are in the build folder already
# are not repeated by the tools that keep them.
if(PYTHON3_FOR_FIGURES AND (BUILD_TESTING OR NOT DEFINED BUILD_TESTING))
  set(records COMMAND ${CMAKE_COMMAND} --build ${PROJECT_BINARY_DIR})  # the benchmarks, too
  foreach(target update-docs docs-pictures cms-variants hard-cases strategies)
    list(APPEND records COMMAND ${CMAKE_COMMAND} --build ${PROJECT_BINARY_DIR} --target ${target})
  endforeach()
  foreach(tool validation step_accuracy speed_against_error scale maps)
    set(more)
    if(tool STREQUAL speed_against_error)
      set(more --benchmarks ${PROJECT_BINARY_DIR}/benchmarks)
    endif()
    list(APPEND records COMMAND ${PYTHON3_FOR_FIGURES} ${PROJECT_SOURCE_DIR}/tools/${tool}.py --program $<TARGET_FILE:tooljoint>
      --work ${PROJECT_BINARY_DIR}/records/${tool} ${more})
  endforeach()
  add_custom_target(records ${records} DEPENDS tooljoint USES_TERMINAL VERBATIM)
endif()

find_program(PYTHON3_FOR_MUTANTS NAMES /usr/bin/python3 python3)
if(PYTHON3_FOR_MUTANTS)
  add_custom_target(mutants COMMAND ${PYTHON3_FOR_MUTANTS} ${PROJECT_SOURCE_DIR}/tools/mutants/run.py --tree ${PROJECT_BINARY_DIR}/mutants
    USES_TERMINAL VERBATIM)
endif()
