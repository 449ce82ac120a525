# SPDX-License-Identifier: BSD-3-Clause
# Run by cpack between installation and packing: copyright and changelog of each package, compressed manual pages, no RPATH (the libraries are
# in folders of the system), nothing that the copyright repeats.
find_program(GZIP gzip REQUIRED)
string(TIMESTAMP today "%a, %d %b %Y %H:%M:%S +0000" UTC)
file(READ ${CPACK_TOOLJOINT_LICENCE} licence)
string(REGEX REPLACE "\n\n" "\n.\n" licence "${licence}")
string(REGEX REPLACE "\n([^\n])" "\n \\1" licence "${licence}")

foreach(pair program:tooljoint dev:libtooljoint-dev)
  string(REPLACE ":" ";" pair ${pair})
  list(GET pair 0 component)
  list(GET pair 1 package)
  set(root ${CPACK_TEMPORARY_DIRECTORY}/${component}/usr)
  set(own ${root}/share/doc/${package})
  file(WRITE ${own}/copyright
    "Format: https://www.debian.org/doc/packaging-manuals/copyright-format/1.0/\nUpstream-Name: Tooljoint\n\n"
    "Files: *\nCopyright: 2026, The Tooljoint developers\nLicense: BSD-3-clause\n ${licence}")
  file(WRITE ${own}/changelog
    "tooljoint (${CPACK_PACKAGE_VERSION}) unstable; urgency=medium\n\n  * See /usr/share/tooljoint/CHANGELOG.md.\n\n"
    " -- ${CPACK_PACKAGE_CONTACT}  ${today}\n")
  file(GLOB_RECURSE pages ${root}/share/man/*.1)
  execute_process(COMMAND ${GZIP} -9nf ${own}/changelog ${pages} COMMAND_ERROR_IS_FATAL ANY)
  file(GLOB linked ${root}/bin/tooljoint ${root}/lib/*/libtooljoint_*.so.* ${root}/lib/libtooljoint_*.so.*)
  foreach(file ${linked})
    if(NOT IS_SYMLINK ${file})
      file(RPATH_REMOVE FILE ${file})
      if(NOT file MATCHES "/bin/")
        file(CHMOD ${file} PERMISSIONS OWNER_READ OWNER_WRITE GROUP_READ WORLD_READ)
      endif()
    endif()
  endforeach()
  file(REMOVE ${root}/share/tooljoint/LICENSE)
  file(GLOB_RECURSE scripts ${root}/share/tooljoint/*.sh ${root}/share/tooljoint/*.py)
  foreach(script ${scripts})
    file(READ ${script} begin LIMIT 2)
    if(begin MATCHES "^#!")
      file(CHMOD ${script} PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
    endif()
  endforeach()
endforeach()
