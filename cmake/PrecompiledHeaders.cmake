# SPDX-License-Identifier: BSD-3-Clause
# Two precompiled headers: one for the libraries, one for the programs of the tests. Sources include what they use all the same: the
# targets `tidy` and `sources-alone` compile without.
option(TOOLJOINT_PCH "Precompile the headers of Eigen, Teuchos and the standard library" ON)

set(tooljoint_common_headers <Eigen/Dense> <Eigen/SparseCore> <Teuchos_ParameterList.hpp> <algorithm> <array> <cmath> <cstdint> <functional>
  <map> <memory> <numeric> <optional> <set> <sstream> <string> <string_view> <tuple> <utility> <vector>)

# tooljoint_precompiled_headers(NAME [HEADERS header...] [LIBRARIES target...]): the common headers and those given, shared by targets of equal flags.
function(tooljoint_precompiled_headers name)
  cmake_parse_arguments(arg "" "" "HEADERS;LIBRARIES" ${ARGN})
  if(TOOLJOINT_PCH)
    file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/generated/${name}.cpp CONTENT "// The precompiled headers need a source.\n")
    add_library(${name} OBJECT ${PROJECT_BINARY_DIR}/generated/${name}.cpp)
    target_link_libraries(${name} PRIVATE Tooljoint::trilinos Eigen3::Eigen tooljoint_warnings ${arg_LIBRARIES})
    target_compile_features(${name} PRIVATE cxx_std_17)
    target_compile_definitions(${name} PRIVATE ${tooljoint_eigen_alignment})
    target_precompile_headers(${name} PRIVATE ${tooljoint_common_headers} ${arg_HEADERS})
  endif()
endfunction()

# tooljoint_use_headers(NAME TARGET...)
function(tooljoint_use_headers name)
  if(TOOLJOINT_PCH)
    foreach(target ${ARGN})
      target_precompile_headers(${target} REUSE_FROM ${name})
    endforeach()
  endif()
endfunction()
