#pragma once

#include <filesystem>

#include "engine/plc/input.h"

namespace ccdt {

/// Reads a surface or a piecewise linear complex; the format is told by the ending: .stl (text and binary, told apart
/// by content), .off, .obj, .ply (text and binary), .poly, .smesh, .node (TetGen), .mesh (Medit).
///
/// \throw InputError  no such file, a directory, unknown ending, empty, truncated, malformed, NaN or infinite
/// coordinates, index out of range,
///                    counts that the file's size belies; with file, line or byte, and a remedy
InputPlc read_plc(const std::filesystem::path& file);

}  // namespace ccdt
