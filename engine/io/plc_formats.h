#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "engine/io/file_bytes.h"
#include "engine/io/output_file.h"
#include "engine/plc/input.h"

/// The formats of surfaces and piecewise linear complexes, one file a format and direction, dispatched by `read_plc`
/// and `write_plc`. No reader builds a mesh structure: what the file says is what the caller gets, non-manifold or not.
/// (OpenMesh's readers drop faces that do not fit a half-edge mesh, take coordinates in single precision and are silent
/// about truncation and NaN; so they serve as the independent cross-reader of our tests, not here.)
namespace ccdt::io {

/// The readers fill all of an `InputPlc` but its name. All throw InputError as `read_plc` says.
InputPlc read_stl(const FileBytes& file);
InputPlc read_off(const FileBytes& file);
InputPlc read_obj(const FileBytes& file);
InputPlc read_ply(const FileBytes& file);
InputPlc read_poly(const FileBytes& file);
InputPlc read_smesh(const FileBytes& file);
InputPlc read_node(const FileBytes& file);
InputPlc read_medit_plc(const FileBytes& file);

/// The writers expect what `check_format_holds` has checked.
void write_stl(const InputPlc& plc, OutputFile& out);
void write_off(const InputPlc& plc, OutputFile& out);
void write_obj(const InputPlc& plc, OutputFile& out);
void write_ply(const InputPlc& plc, OutputFile& out);
void write_poly(const InputPlc& plc, OutputFile& out);
void write_smesh(const InputPlc& plc, OutputFile& out);
void write_medit_plc(const InputPlc& plc, OutputFile& out);

/// Adds a facet with one loop: a triangle, a polygon, or, of two corners, a segment. Less is nothing.
void add_facet(InputPlc& plc, std::span<const std::uint32_t> corners, int marker, std::uint32_t number);

/// To be called when all facets are in: numbers that equal the indices are not kept, nor are markers that are all 0.
void finish_facets(InputPlc& plc);

/// One facet with one loop, wherever the PLC holds it.
struct FacetLoop {
  std::span<const std::uint32_t> corners;
  int marker = 0;
  const PolygonFacet* polygon = nullptr;  ///< null for a triangle
};

/// All facets, in the order of their numbers in the file that they came from.
std::vector<FacetLoop> facets_in_order(const InputPlc& plc);

/// What a format can hold.
struct FormatLimits {
  std::string_view name;
  std::size_t most_corners = 0;  ///< of a facet
  bool several_polygons = false, segments = false, seeds = false, loose_vertices = true;
};

/// \throw OutputError  the PLC has what the format cannot hold, or no vertices
void check_format_holds(const InputPlc& plc, const FormatLimits& limits, const std::string& file);

/// Our writers leave this comment in the formats that are read with seeds when the PLC goes by even and odd.
inline constexpr std::string_view even_odd_claim = "# ccdt inside even_odd";
InputPlc::Inside inside_claimed(const FileBytes& file);

}  // namespace ccdt::io
