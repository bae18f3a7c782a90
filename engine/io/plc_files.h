#pragma once

#include <filesystem>

#include "engine/plc/input.h"

namespace ccdt::io {

/// Is the ending one that `read_plc` knows?
bool is_plc_file(const std::filesystem::path& file);

/// Reads a surface or a piecewise linear complex. The ending names the format: .stl (text and binary, distinguished by
/// content), .off, .obj, .ply (text and binary), .poly, .smesh, .node (TetGen), .mesh (Medit).
///
/// \throw InputError  no such file, a directory, unknown ending, empty, truncated, malformed, NaN or infinite
///                    coordinates, index out of range, counts that the file's size belies; with file, line or byte,
///                    and a remedy
plc::InputPlc read_plc(const std::filesystem::path& file);

/// Writes a surface or PLC. The ending names the format: .stl (binary), .off, .obj, .ply (binary), .poly, .smesh,
/// .mesh. The file appears whole or not at all (it is written beside its place and renamed).
///
/// \throw OutputError  cannot be written, unknown ending, or the format cannot hold what the PLC has (segments, holes,
///                     regions in .stl)
void write_plc(const plc::InputPlc& plc, const std::filesystem::path& file);

}  // namespace ccdt::io
