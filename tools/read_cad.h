#pragma once

#include <filesystem>

#include "engine/plc/input.h"

namespace ccdt::tools {

/// The extensions that `read_cad` reads.
inline constexpr const char* cad_endings = ".step .stp .iges .igs .brep";

/// Is this a CAD file, by its extension?
bool is_cad_file(const std::filesystem::path& file);

/// Lets Gmsh triangulate the surfaces of a CAD file, with 36 edges around a circle. Each surface is a group of its own,
/// with a marker. The program is the value of GMSH, or `gmsh` on PATH.
///
/// \throw InputError  there is no Gmsh, or it fails
plc::InputPlc read_cad(const std::filesystem::path& file);

}  // namespace ccdt::tools
