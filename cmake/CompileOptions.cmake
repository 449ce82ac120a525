# SPDX-License-Identifier: BSD-3-Clause
# Flags, warnings, compiler cache and job pools.
if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "Release or Debug" FORCE)
endif()
set(CMAKE_CXX_STANDARD 17)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)

# Neither -march=native nor -ffast-math: golds hold on every machine, and NaN checks work.
# Release is -O3 -DNDEBUG; checks of results do not depend on NDEBUG.
add_compile_options(-fno-semantic-interposition)
add_link_options(LINKER:--as-needed)

option(TOOLJOINT_SANITIZE "Build with the address and undefined-behaviour sanitizers" OFF)
if(TOOLJOINT_SANITIZE)
  add_compile_options(-O1 -fno-omit-frame-pointer -fsanitize=address,undefined -fno-sanitize-recover=undefined)
  add_link_options(-fsanitize=address,undefined)
endif()

add_library(tooljoint_warnings INTERFACE)
target_compile_options(tooljoint_warnings INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Werror)
if(TOOLJOINT_SANITIZE)
  # GCC's manual advises against -Werror with sanitizers: their code makes -Wmaybe-uninitialized
  # warn of moved std::variants. The other builds use it.
  target_compile_options(tooljoint_warnings INTERFACE -Wno-maybe-uninitialized)
endif()

find_program(CCACHE ccache)
if(CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  # Settings of ccache for precompiled headers; paths are relative to the sources, so that all
  # clones share compiled objects.
  set(CMAKE_CXX_COMPILER_LAUNCHER env CCACHE_SLOPPINESS=pch_defines,time_macros CCACHE_BASEDIR=${PROJECT_SOURCE_DIR} ${CCACHE})
endif()

# A file that instantiates Trilinos solvers takes up to 1.5 GB: at most two of them at a time, however many jobs run.
set_property(GLOBAL APPEND PROPERTY JOB_POOLS solvers=2)

# Splits `sources` into those that include solver headers of Trilinos (list in `heavy`) and the others (list in `light`).
function(tooljoint_split_by_weight sources heavy light)
  set(found)
  foreach(source ${sources})
    file(STRINGS ${source} hit REGEX "#include [<\"](Amesos2|Anasazi|Belos|LOCA|NOX|Stratimikos|Thyra|Tpetra|linalg/trilinos/T)" LIMIT_COUNT 1)
    if(hit)
      list(APPEND found ${source})
    endif()
  endforeach()
  set(rest ${sources})
  if(found)
    list(REMOVE_ITEM rest ${found})
  endif()
  set(${heavy} ${found} PARENT_SCOPE)
  set(${light} ${rest} PARENT_SCOPE)
endfunction()
