# Called by CPack when the files of all packages are in place: adds what Debian wants of each, and takes what it has no
# use for.
cmake_policy(VERSION 3.25)
string(TIMESTAMP date "%a, %d %b %Y %H:%M:%S +0000" UTC)  # of SOURCE_DATE_EPOCH, if it is set

foreach(component IN LISTS CPACK_COMPONENTS_ALL)
  string(TOUPPER ${component} key)
  set(package ${CPACK_DEBIAN_${key}_PACKAGE_NAME})
  set(usr ${CPACK_TEMPORARY_INSTALL_DIRECTORY}/${component}/usr)
  set(doc ${usr}/share/doc/${package})

  file(REMOVE_RECURSE ${usr}/share/doc)
  file(READ ${CPACK_RESOURCE_FILE_LICENSE} license)
  if(component STREQUAL ccdt_program AND CPACK_CCDT_PROGRAM_LICENSE)
    file(READ ${CMAKE_CURRENT_LIST_DIR}/../../baselines/AGPL-3.0 agpl)
    string(PREPEND license "${CPACK_CCDT_PROGRAM_LICENSE}
/usr/share/common-licenses/GPL-3 is the text of the GPL; that of the AGPL is at the end.
The source code of ccdt itself is under this license:\n\n")
    string(APPEND license "\n${agpl}")
  endif()
  if(component MATCHES "^ccdt_(program|python_module)$")
    string(APPEND license "\nThe verifier contains parts of CGAL under the LGPL-3+ (/usr/share/common-licenses/LGPL-3 and GPL-3).\n")
  endif()
  file(WRITE ${doc}/copyright "${license}")
  file(WRITE ${doc}/changelog "${package} (${CPACK_PACKAGE_VERSION}) unstable; urgency=medium

  * Release ${CPACK_PACKAGE_VERSION}.

 -- ${CPACK_PACKAGE_CONTACT}  ${date}\n")

  file(GLOB texts ${doc}/changelog ${usr}/share/man/*/*)
  execute_process(COMMAND gzip -9n ${texts} COMMAND_ERROR_IS_FATAL ANY)

  # Debian's libraries are where all programs look for them. Only the program keeps its symbols.
  file(GLOB_RECURSE modules ${usr}/bin/* ${usr}/lib/*.so*)
  foreach(module IN LISTS modules)
    if(NOT IS_SYMLINK ${module})
      file(RPATH_REMOVE FILE ${module})
      if(NOT module MATCHES /bin/)
        execute_process(COMMAND strip --strip-unneeded ${module} COMMAND_ERROR_IS_FATAL ANY)
      endif()
    endif()
  endforeach()
endforeach()

# `ccdt gate` finds the stages of a program by its symbols. CPack calls ldconfig where Debian's own tools use a trigger.
function(override component)
  string(TOUPPER ${component} key)
  set(package ${CPACK_DEBIAN_${key}_PACKAGE_NAME})
  list(TRANSFORM ARGN PREPEND "${package}: ")
  string(REPLACE ";" "\n" lines "${ARGN}")
  file(WRITE ${CPACK_TEMPORARY_INSTALL_DIRECTORY}/${component}/usr/share/lintian/overrides/${package} "${lines}\n")
endfunction()
override(ccdt_program "unstripped-binary-or-object *")
if(ccdt_runtime IN_LIST CPACK_COMPONENTS_ALL)
  override(ccdt_runtime "lacks-ldconfig-trigger *" "maintscript-calls-ldconfig *")
endif()
