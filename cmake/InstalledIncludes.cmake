# SPDX-License-Identifier: BSD-3-Clause
# Runs at the end of an installation: in the headers below ${HEADERS} (include/tooljoint) the includes of one another,
# "common/Error.hpp" in the sources, become "tooljoint/common/Error.hpp". Only include/ then is on the path of a client,
# and names such as common/, io/ or model/ stay free for its own folders.
file(GLOB_RECURSE headers "${HEADERS}/*.hpp")
foreach(header ${headers})
  file(READ "${header}" text)
  string(REGEX REPLACE "#include \"([a-z])" "#include \"tooljoint/\\1" changed "${text}")
  string(REPLACE "\"tooljoint/tooljoint/" "\"tooljoint/" changed "${changed}")
  if(NOT changed STREQUAL text)
    file(WRITE "${header}" "${changed}")
  endif()
endforeach()
