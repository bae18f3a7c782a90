# Publishes JSON Schemas: they come with the program, in share/ccdt/schemas.
function(ccdt_publish_schemas)
  foreach(file IN LISTS ARGN)
    get_filename_component(name ${file} NAME)
    configure_file(${file} ${PROJECT_BINARY_DIR}/share/ccdt/schemas/${name} COPYONLY)
  endforeach()
  if(CCDT_INSTALL)
    install(FILES ${ARGN} DESTINATION ${CMAKE_INSTALL_DATADIR}/ccdt/schemas COMPONENT ccdt_program)
  endif()
endfunction()

# Makes a header of the build, FOLDER/NAME.h, that holds a JSON Schema as the text `ccdt::NAMESPACE::NAME`. It is
# published, too.
function(ccdt_embed_schema file folder namespace name)
  ccdt_publish_schemas(${file})
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${file})
  file(READ ${file} schema)
  file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/generated/${folder}/${name}.h @ONLY CONTENT [[#pragma once

namespace ccdt::@namespace@ {

inline constexpr const char* @name@ = R"json(@schema@)json";

}  // namespace ccdt::@namespace@
]])
endfunction()
