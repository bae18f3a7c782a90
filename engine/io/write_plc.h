#pragma once

#include <filesystem>

#include "engine/plc/input.h"

namespace ccdt {

/// Writes a surface or PLC; the format is told by the ending: .stl (binary), .off, .obj, .ply (binary), .poly, .smesh,
/// .mesh. The file appears whole or not at all (it is written beside its place and renamed).
///
/// \throw OutputError  cannot be written, unknown ending, or the format cannot hold what the PLC has (segments, holes,
/// regions in .stl)
void write_plc(const InputPlc& plc, const std::filesystem::path& file);

}  // namespace ccdt
