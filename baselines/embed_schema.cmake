# Makes a header of the build, FOLDER/NAME.h, that holds a JSON Schema as the text `ccdt::NAMESPACE::NAME`.
function(ccdt_embed_schema file folder namespace name)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${file})
  file(READ ${file} schema)
  file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/generated/${folder}/${name}.h @ONLY CONTENT [[#pragma once

namespace ccdt::@namespace@ {

inline constexpr const char* @name@ = R"json(@schema@)json";

}  // namespace ccdt::@namespace@
]])
endfunction()
