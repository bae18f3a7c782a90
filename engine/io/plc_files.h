#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "engine/plc/input.h"

namespace ccdt::io {

/// Can `read_plc` read files with this extension, or with this one and .gz?
bool is_plc_file(const std::filesystem::path& file);

/// Reads a surface or a piecewise linear complex. The extension determines the format: .stl (text and binary,
/// distinguished by content), .off, .obj, .ply (text and binary), .poly, .smesh, .node (TetGen), .mesh (Medit, text),
/// .meshb (Medit, binary), .msh (Gmsh 2.x and 4.1), .vtu and .vtp (VTK). Each may be compressed by gzip (.stl.gz). But
/// a file that begins with another format's keyword is read in that format. Of tetrahedra, the boundary is taken.
///
/// \throw InputError  no such file, a folder, unknown extension, empty, truncated, malformed, NaN or infinite
///                    coordinates, index out of range, counts that contradict the size of the file; with file, line or
///                    byte, and a remedy
plc::InputPlc read_plc(const std::filesystem::path& file);

/// The names of all formats that are read, or of those that are written: their extensions without the dot.
std::vector<std::string> plc_format_names(bool written = false);

/// Do the markers of facets survive in a file with this extension that `write_plc` writes?
bool keeps_markers(const std::filesystem::path& file);

/// Writes a surface or PLC. The extension determines the format: .stl (binary), .off, .obj, .ply (binary), .poly,
/// .smesh, .mesh, .meshb. The file appears completely or not at all (it is written under a temporary name and renamed).
///
/// \throw OutputError  cannot be written, unknown extension, or the format cannot hold the PLC (segments, holes,
/// regions in .stl)
/// \throw InputError   an index is out of range, or a list incomplete
void write_plc(const plc::InputPlc& plc, const std::filesystem::path& file);

}  // namespace ccdt::io
