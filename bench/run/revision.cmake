# Writes OUT, a header with the git revision of SOURCE_DIR; run at every build, but it touches the header only when the
# revision has changed. Outside a checkout, or without git, the revision is "unknown".
set(failed TRUE)
if(EXISTS ${SOURCE_DIR}/.git)  # not that of a checkout around an unpacked archive
  execute_process(COMMAND git -C ${SOURCE_DIR} describe --always --dirty --abbrev=12 --exclude=*
                  OUTPUT_VARIABLE revision RESULT_VARIABLE failed ERROR_QUIET OUTPUT_STRIP_TRAILING_WHITESPACE)
endif()
if(failed OR revision STREQUAL "")
  set(revision unknown)
endif()
set(text "#pragma once\n\nnamespace ccdt::bench {\ninline constexpr const char* source_revision = \"${revision}\";\n}\n")
if(EXISTS ${OUT})
  file(READ ${OUT} before)
endif()
if(NOT "${before}" STREQUAL "${text}")
  file(WRITE ${OUT} "${text}")
endif()
