#pragma once

#include <filesystem>

#include "engine/plc/input.h"

namespace ccdt::tools {

/// Is this a CAD file, by its extension?
bool is_cad_file(const std::filesystem::path& file);

/// Lets Gmsh triangulate the surfaces of a CAD file, with 36 edges around a circle. Each surface is a group of its own,
/// with a marker. The program is the value of GMSH, or `gmsh` on PATH.
///
/// Gmsh gets a copy of the file in a folder of its own, because it runs the commands of a file `*.opt` beside its
/// input.
///
/// \throw InputError  there is no Gmsh, or it fails
/// \throw LimitError  Gmsh takes more than ten minutes
plc::InputPlc read_cad(const std::filesystem::path& file);

}  // namespace ccdt::tools
