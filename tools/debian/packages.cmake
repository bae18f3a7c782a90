# Packages for Debian: `cpack` in the build folder makes them, and tools/package calls it.
#
#   ccdt, or with TetGen or CGAL's meshers ccdt-baselines   the program, its man pages and completion
#   libccdt0.1, libccdt-dev                                 the library for C; it and the engine for C++, for development
#   python3-ccdt                                            the package for Python, with Debian's libraries
#
# The last three are the same with and without the baselines. The program and the module for Python have the verifier,
# which is made with parts of CGAL under the LGPL.
set(program_package ccdt)
if(CCDT_WITH_TETGEN)
  set(CPACK_CCDT_PROGRAM_LICENSE "This variant contains TetGen. As a whole it is under the AGPL-3+.")
elseif(CCDT_WITH_CGAL_MESHERS)
  set(CPACK_CCDT_PROGRAM_LICENSE "This variant contains CGAL's meshers. As a whole it is under the GPL-3+.")
endif()
if(CPACK_CCDT_PROGRAM_LICENSE)
  set(program_package ccdt-baselines)
endif()

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_PACKAGE_CONTACT "$ENV{CCDT_MAINTAINER}")  # set by tools/release
set(CPACK_PACKAGE_DIRECTORY ${PROJECT_BINARY_DIR}/package)
set(CPACK_RESOURCE_FILE_LICENSE ${PROJECT_SOURCE_DIR}/LICENSE)
set(CPACK_PRE_BUILD_SCRIPTS ${CMAKE_CURRENT_LIST_DIR}/finish.cmake)
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "tetrahedral mesher with exact predicates")
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)

# Describes the package of a component. CPack adds the synopsis, and indents the lines.
macro(ccdt_debian_package component name section)
  string(TOUPPER ${component} key)
  list(APPEND CPACK_COMPONENTS_ALL ${component})
  set(CPACK_DEBIAN_${key}_PACKAGE_NAME ${name})
  set(CPACK_DEBIAN_${key}_PACKAGE_SECTION ${section})
  string(REPLACE ";" "\n" CPACK_COMPONENT_${key}_DESCRIPTION "${ARGN}")
endmacro()

ccdt_debian_package(ccdt_program ${program_package} science
  "ccdt fills solids with tetrahedra, checks and repairs surfaces, improves"
  "and verifies meshes, and compares meshers."
  ${CPACK_CCDT_PROGRAM_LICENSE})
set(CPACK_DEBIAN_CCDT_PROGRAM_PACKAGE_SUGGESTS "nodejs, librsvg2-bin")  # pictures of a report's figures
if(CPACK_CCDT_PROGRAM_LICENSE)
  set(CPACK_DEBIAN_CCDT_PROGRAM_PACKAGE_PROVIDES ccdt)
  set(CPACK_DEBIAN_CCDT_PROGRAM_PACKAGE_CONFLICTS ccdt)
  set(CPACK_DEBIAN_CCDT_PROGRAM_PACKAGE_REPLACES ccdt)
endif()

if(CCDT_BUILD_C)
  set(runtime_package libccdt${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
  ccdt_debian_package(ccdt_runtime ${runtime_package} libs
    "The shared library for programs in C and Fortran.")
  ccdt_debian_package(ccdt_library libccdt-dev libdevel
    "The engine as a library for C++, with a package for CMake, and the library"
    "for C, with a file for pkg-config.")
  set(CPACK_DEBIAN_CCDT_LIBRARY_PACKAGE_DEPENDS
    "${runtime_package} (= ${PROJECT_VERSION}), libopenmesh-dev, libtbb-dev, zlib1g-dev, libpugixml-dev")
endif()

if(CCDT_BUILD_PYTHON)
  ccdt_debian_package(ccdt_python_module python3-ccdt python
    "The module ccdt for Python, with arrays of numpy: it reads, checks, repairs,"
    "meshes, improves, verifies and writes.")
  find_package(Python REQUIRED COMPONENTS Interpreter)
  math(EXPR next_python "${Python_VERSION_MINOR} + 1")
  set(CPACK_DEBIAN_CCDT_PYTHON_MODULE_PACKAGE_DEPENDS
    "python3 (>= 3.${Python_VERSION_MINOR}), python3 (<< 3.${next_python}), python3-numpy")
  set(scripts ${CMAKE_CURRENT_LIST_DIR}/python)  # of compiled files
  set(CPACK_DEBIAN_CCDT_PYTHON_MODULE_PACKAGE_CONTROL_EXTRA ${scripts}/postinst ${scripts}/prerm)
endif()

include(CPack)
