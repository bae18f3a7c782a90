#pragma once

#include <filesystem>

#include "engine/sizes/background_sizes.h"

namespace ccdt::io {

/// Reads a size function: the target edge length at each vertex of a background mesh, whose file has the same name with
/// another ending.
///
///     .sol  Medit, ASCII, one scalar per vertex: vertices and tetrahedra (if any) of the .mesh beside it
///     .mtr  TetGen, one value per vertex: vertices of the first .node, .poly or .smesh found beside it;
///           tetrahedra of the .ele that belongs to the .node (if any)
///
/// \throw InputError  unknown extension, unreadable, no background beside it, a wrong number of vertices, not one
///                    scalar per vertex, or a size that is not a number > 0; with file and line
/// \throw LimitError  out of memory
sizes::BackgroundSizes read_sizes(const std::filesystem::path& file);

}  // namespace ccdt::io
