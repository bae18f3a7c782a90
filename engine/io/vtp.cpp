#include "engine/io/formats.h"
#include "engine/io/vtk_values.h"

namespace ccdt::io {
namespace {

/// Cells of one kind, such as Polys: their corners, one cell after the other, and where those of each end.
class VtpCells {
 public:
  VtpCells(const VtkArrays& arrays, const char* parent, std::size_t count, std::size_t vertices)
      : arrays_(arrays), vertices_(vertices) {
    if (count == 0) return;  // the arrays may be missing
    place_ = arrays.begin_of(arrays.required(parent, "connectivity"));
    connectivity_ = values_of(parent, "connectivity");
    offsets_ = values_of(parent, "offsets");
    arrays.check_size(arrays.required(parent, "offsets"), offsets_.size(), count);
  }

  std::size_t size() const { return offsets_.size(); }

  /// \param corners  gets those of the cell
  void read_corners(std::size_t cell, std::vector<std::uint32_t>& corners) const {
    const std::int64_t begin = cell == 0 ? 0 : offsets_[cell - 1], end = offsets_[cell];
    if (begin < 0 || end < begin || static_cast<std::size_t>(end) > connectivity_.size())
      refuse(cell, "its offsets " + std::to_string(begin) + " and " + std::to_string(end) + " are wrong");
    corners.clear();
    for (std::int64_t i = begin; i < end; ++i) {
      const std::int64_t v = connectivity_[static_cast<std::size_t>(i)];
      if (v < 0 || static_cast<std::size_t>(v) >= vertices_)
        refuse(cell, "vertex index " + std::to_string(v) + " is out of range: the file has " +
                         std::to_string(vertices_) + " vertices, counted from 0");
      corners.push_back(static_cast<std::uint32_t>(v));
    }
  }

  [[noreturn]] void refuse(std::size_t cell, const std::string& what) const {
    arrays_.fail(place_, "cell " + std::to_string(cell) + ": " + what);
  }

 private:
  std::vector<std::int64_t> values_of(const char* parent, const char* name) const {
    const auto stored = arrays_.read<std::int64_t>(arrays_.required(parent, name));
    std::vector<std::int64_t> values(stored.size());
    stored.read(0, values.size(), values.data());
    return values;
  }

  const VtkArrays& arrays_;
  std::size_t vertices_, place_ = 0;
  std::vector<std::int64_t> connectivity_, offsets_;
};

}  // namespace

plc::InputPlc read_vtp(const FileBytes& file) {
  const VtkArrays arrays(file, "PolyData");
  plc::InputPlc plc;
  plc.vertices = read_vtk_points(arrays);
  const std::size_t verts = arrays.claimed("NumberOfVerts"), lines = arrays.claimed("NumberOfLines"),
                    polygons = arrays.claimed("NumberOfPolys");
  if (arrays.claimed("NumberOfStrips") > 0)
    arrays.fail(0, "it has strips of triangles", "make triangles of them (in ParaView: Triangulate)");
  const auto markers = read_vtk_attributes(arrays, "marker", verts + lines + polygons);
  const auto marker_of = [&](std::size_t cell) {
    std::int64_t marker = 0;
    if (markers.size() > 0) markers.read(cell, cell + 1, &marker);
    return static_cast<int>(marker);
  };
  std::vector<std::uint32_t> corners;
  const VtpCells facets(arrays, "Polys", polygons, plc.vertices.size());
  for (std::size_t i = 0; i < facets.size(); ++i) {
    facets.read_corners(i, corners);
    if (corners.size() < 3) facets.refuse(i, "it has " + std::to_string(corners.size()) + " corners, but needs three");
    add_facet(plc, corners, marker_of(verts + lines + i), i);
  }
  const VtpCells chains(arrays, "Lines", lines, plc.vertices.size());
  for (std::size_t i = 0; i < chains.size(); ++i) {
    chains.read_corners(i, corners);
    for (std::size_t k = 0; k + 1 < corners.size(); ++k)
      add_facet(plc, std::span(corners).subspan(k, 2), marker_of(verts + i), 0);
  }
  finish_facets(plc);
  return plc;
}

}  // namespace ccdt::io
