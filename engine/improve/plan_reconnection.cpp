#include "engine/improve/plan_reconnection.h"

#include <algorithm>
#include <array>

#include "engine/base/simplex_map.h"

namespace ccdt::improve {

using tets::cell_of, tets::corners_of_face, tets::face_code, tets::no_neighbor;

namespace {

/// The numbers of vertices at which new cells are searched for.
constexpr std::array<std::size_t, 3> sizes = {12, 18, 24};

}  // namespace

bool Reconnection::plan(std::uint32_t cell, double least, Change& change) {
  start(cell);
  for (const std::size_t size : sizes) {
    while (vertices_.size() < size)
      if (!grow()) return false;
    if (!find_hull()) continue;
    change.clear();
    if (!filler_.fill(hull_, x_.region(cell), least, change.new_cells)) continue;
    change.old_cells = cells_;
    return true;
  }
  return false;
}

void Reconnection::start(std::uint32_t cell) {
  marks_.clear(x_.cell_count());
  cells_.clear();
  const auto& v = x_.cell(cell).vertices;
  vertices_.assign(v.begin(), v.end());
  add(cell);
}

void Reconnection::add(std::uint32_t cell) {
  marks_.mark(cell);
  cells_.push_back(cell);
}

/// Calls visit(code) for the faces of neighbors of a cell that are not in the polyhedron, except behind walls.
template <class Visit>
void Reconnection::visit_neighbors(std::uint32_t cell, const Visit& visit) const {
  for (std::uint32_t f = 0; f < 4; ++f) {
    const std::uint32_t code = face_code(cell, f);
    if (x_.is_wall(code) || marks_.is_marked(cell_of(x_.across(code)))) continue;
    visit(x_.across(code));
  }
}

/// Adds the vertex that sees the most faces, and all cells between vertices that are there. \return is there one?
bool Reconnection::grow() {
  struct Apex {
    std::uint32_t vertex, faces;
    double quality;  ///< of the worst cell
  };
  std::vector<Apex> apexes;
  const auto see = [&](std::uint32_t code) {
    const std::uint32_t vertex = x_.apex_of(code);
    const double quality = x_.quality(cell_of(code));
    const auto known = std::ranges::find(apexes, vertex, &Apex::vertex);
    if (known == apexes.end()) {
      apexes.push_back({vertex, 1, quality});
      return;
    }
    ++known->faces;
    known->quality = std::min(known->quality, quality);
  };
  for (const std::uint32_t c : cells_) visit_neighbors(c, see);
  if (apexes.empty()) return false;
  const auto best = std::ranges::min_element(apexes, [](const Apex& a, const Apex& b) {
    return a.faces != b.faces ? a.faces > b.faces : a.quality < b.quality;
  });
  vertices_.push_back(best->vertex);
  add_cells_inside();
  return true;
}

/// Adds the cells whose vertices are all there.
void Reconnection::add_cells_inside() {
  for (std::size_t i = 0; i < cells_.size(); ++i)
    visit_neighbors(cells_[i], [&](std::uint32_t code) {
      if (std::ranges::find(vertices_, x_.apex_of(code)) != vertices_.end()) add(cell_of(code));
    });
}

/// Lists the faces of the polyhedron. \return is it a ball without walls, vertices and segments inside?
bool Reconnection::find_hull() {
  hull_.clear();
  edges_.clear();
  for (const std::uint32_t c : cells_) {
    for (std::uint32_t f = 0; f < 4; ++f) {
      const std::uint32_t code = face_code(c, f), beyond = x_.across(code);
      if (beyond != no_neighbor && marks_.is_marked(cell_of(beyond))) {
        if (x_.is_wall(code)) return false;
        continue;
      }
      const auto& [a, b, d] = hull_.emplace_back(corners_of_face(x_.cell(c).vertices, f));
      edges_.insert(edges_.end(), {edge_key(a, b), edge_key(b, d), edge_key(d, a)});
    }
  }
  std::ranges::sort(edges_);
  for (std::size_t i = 0; i < edges_.size(); i += 2)
    if (edges_[i] != edges_[i + 1] || (i + 2 < edges_.size() && edges_[i] == edges_[i + 2])) return false;
  const auto rest = std::ranges::unique(edges_);
  edges_.erase(rest.begin(), rest.end());
  // Euler's formula for a sphere.
  return vertices_.size() + hull_.size() == edges_.size() + 2 && are_vertices_on_hull() && are_segments_on_hull();
}

bool Reconnection::are_vertices_on_hull() const {
  return std::ranges::all_of(vertices_, [&](std::uint32_t v) {
    return std::ranges::any_of(hull_, [&](const auto& face) { return std::ranges::find(face, v) != face.end(); });
  });
}

bool Reconnection::are_segments_on_hull() const {
  return std::ranges::all_of(cells_, [&](std::uint32_t c) {
    const auto& v = x_.cell(c).vertices;
    for (std::uint32_t i = 0; i < 4; ++i)
      for (std::uint32_t j = 0; j < i; ++j)
        if (x_.is_segment(v[i], v[j]) && !std::ranges::binary_search(edges_, edge_key(v[i], v[j]))) return false;
    return true;
  });
}

}  // namespace ccdt::improve
