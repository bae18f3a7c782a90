#include "engine/locate/cavity_locator.h"

#include <algorithm>

namespace ccdt {
namespace {

std::vector<std::uint32_t> vertices_of(const Delaunay& d, const std::vector<std::uint32_t>& cells) {
  std::vector<std::uint32_t> vertices;
  vertices.reserve(4 * cells.size());
  for (const std::uint32_t cell : cells)
    vertices.insert(vertices.end(), d.cells[cell].vertices.begin(), d.cells[cell].vertices.end());
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  return vertices;
}

}  // namespace

CavityLocator::CavityLocator(const FacetMesh& facets, std::span<const std::uint32_t> codes, const Delaunay& delaunay,
                             CellStar& star) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> found;  // Delaunay faces that have no code yet
  for (std::uint32_t i = 0; i < codes.size(); ++i) {
    if (codes[i] != no_neighbor) continue;
    const auto& [a, b, c] = facets.triangles[i];
    const std::uint32_t code = star.find_face(a, b, c);
    if (code == no_neighbor) {
      missing_.push_back(i);
    } else {
      found.emplace_back(i, code);
    }
  }
  pierced_ = find_pierced_cells(facets, missing_, delaunay, star);

  std::vector<std::vector<std::uint32_t>> faces(pierced_.cells.size());
  for (std::size_t i = 0; i < missing_.size(); ++i) faces[pierced_.part_of_face[i]].push_back(missing_[i]);
  triangles_ = missing_;
  const auto add_delaunay_face = [&](std::uint32_t triangle, std::uint32_t code) {
    const std::uint32_t above = cavity_of_cell(cell_of(code)),
                        below = cavity_of_cell(cell_of(delaunay.cells[cell_of(code)].neighbors[face_of(code)]));
    if (above != no_cavity) faces[above].push_back(triangle);
    if (below != no_cavity && below != above) faces[below].push_back(triangle);
    if (above != no_cavity || below != no_cavity) triangles_.push_back(triangle);
  };
  if (!missing_.empty()) {
    for (std::uint32_t i = 0; i < codes.size(); ++i)
      if (codes[i] != no_neighbor) add_delaunay_face(i, codes[i]);
    for (const auto& [triangle, code] : found) add_delaunay_face(triangle, code);
  }
  cavities_.reserve(faces.size());
  for (std::size_t i = 0; i < faces.size(); ++i)
    cavities_.emplace_back(delaunay.vertices, vertices_of(delaunay, pierced_.cells[i]), facets.triangles, faces[i]);
}

std::uint32_t CavityLocator::cavity_of_cell(std::uint32_t cell) const {
  const std::uint32_t* part = pierced_.part_of.find(cell);
  return part == nullptr ? no_cavity : *part;
}

std::uint32_t CavityLocator::cavity_of_triangle(std::uint32_t triangle) const {
  const auto found = std::lower_bound(missing_.begin(), missing_.end(), triangle);
  return found == missing_.end() || *found != triangle ? no_cavity : pierced_.part_of_face[found - missing_.begin()];
}

}  // namespace ccdt
