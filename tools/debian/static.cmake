# For the preset `static`, right after project(): all libraries are static ones, of Debian or of tools/static-libraries.
set(CMAKE_FIND_LIBRARY_SUFFIXES .a)
find_package(Threads REQUIRED)  # which oneTBB's package for CMake does not look for
find_package(pugixml REQUIRED GLOBAL)
set_target_properties(pugixml::pugixml PROPERTIES INTERFACE_LINK_LIBRARIES pugixml::static)
