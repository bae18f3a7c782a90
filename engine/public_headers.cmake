# The engine as a library: its public headers, and what is installed. Public headers include only each other; everything
# else in this folder may change at any time.
set(public_headers
  base/box.h
  base/enum_names.h
  base/errors.h
  base/flatness.h
  base/point.h
  base/portable_math.h
  base/progress.h
  base/stages.h
  base/work.h
  delaunay/options.h
  front/options.h
  front/segment_counts.h
  improve/counts.h
  improve/options.h
  improver.h
  io/plc_files.h
  io/read_sizes.h
  io/tet_mesh_files.h
  lattice/options.h
  locate/options.h
  mesh/tet_mesh.h
  mesher.h
  plc/input.h
  plc/periodicity.h
  protection/options.h
  repair/certificate.h
  repair/faults.h
  repair/find_faults.h
  repair/repair_input.h
  sizes/background_sizes.h
  sizes/local_sizes.h
  options/mesh_options.h
  surface/options.h
  surface/remesh_surface.h
  tets/objective.h
)

# Both in the project and installed: #include <ccdt/ccdt.h> for everything, or "engine/mesher.h" for a part.
set(generated ${CMAKE_CURRENT_BINARY_DIR}/generated)
configure_file(version.h.in ${generated}/engine/version.h @ONLY)
target_sources(ccdt_engine PUBLIC
  FILE_SET HEADERS BASE_DIRS ${PROJECT_SOURCE_DIR} FILES ${public_headers}
  FILE_SET generated TYPE HEADERS BASE_DIRS ${generated} FILES ${generated}/engine/version.h
  FILE_SET umbrella TYPE HEADERS BASE_DIRS include FILES include/ccdt/ccdt.h)

add_library(ccdt::engine ALIAS ccdt_engine)
set_target_properties(ccdt_engine PROPERTIES EXPORT_NAME engine VERSION ${PROJECT_VERSION}
                      SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})

if(CCDT_INSTALL)
  set(headers ${CMAKE_INSTALL_INCLUDEDIR}/ccdt)
  set(package ${CMAKE_INSTALL_LIBDIR}/cmake/ccdt)
  install(TARGETS ccdt_engine EXPORT ccdt
    ARCHIVE COMPONENT ccdt_library
    LIBRARY COMPONENT ccdt_library
    FILE_SET HEADERS DESTINATION ${headers} COMPONENT ccdt_library
    FILE_SET generated DESTINATION ${headers} COMPONENT ccdt_library
    FILE_SET umbrella COMPONENT ccdt_library)
  install(EXPORT ccdt NAMESPACE ccdt:: FILE ccdtTargets.cmake DESTINATION ${package} COMPONENT ccdt_library)

  include(CMakePackageConfigHelpers)
  configure_package_config_file(ccdtConfig.cmake.in ${generated}/ccdtConfig.cmake INSTALL_DESTINATION ${package})
  write_basic_package_version_file(${generated}/ccdtConfigVersion.cmake COMPATIBILITY SameMinorVersion)
  install(FILES ${generated}/ccdtConfig.cmake ${generated}/ccdtConfigVersion.cmake
    DESTINATION ${package} COMPONENT ccdt_library)
  install(FILES ${PROJECT_SOURCE_DIR}/LICENSE TYPE DOC COMPONENT ccdt_library)
endif()
