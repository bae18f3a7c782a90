#include "engine/improve/plan_reconnection.h"

#include <algorithm>
#include <array>

#include "engine/base/simplex_map.h"

namespace ccdt::improve {

using tets::CellComplex, tets::cell_of, tets::has;

namespace {

/// New cells are searched for at these numbers of vertices.
constexpr std::array<std::size_t, 3> sizes = {12, 18, 24};

/// Adds the vertex that sees the most faces, and all cells whose vertices are then all in the polyhedron. \return is
/// there one?
bool add_vertex(const CellComplex& x, ReconnectionScratch& polyhedron) {
  struct Apex {
    std::uint32_t vertex, faces;
    double quality;  ///< of the worst cell
  };
  std::vector<Apex> apexes;
  std::vector<std::uint32_t>& vertices = polyhedron.vertices;
  polyhedron.cells.visit_hull(x, [&](std::uint32_t code) {
    if (x.is_wall(code)) return;
    const std::uint32_t beyond = x.across(code), vertex = x.apex_of(beyond);
    const double quality = x.quality(cell_of(beyond));
    const auto known = std::ranges::find(apexes, vertex, &Apex::vertex);
    if (known == apexes.end()) {
      apexes.push_back({vertex, 1, quality});
      return;
    }
    ++known->faces;
    known->quality = std::min(known->quality, quality);
  });
  if (apexes.empty()) return false;
  const auto best = std::ranges::min_element(apexes, [](const Apex& a, const Apex& b) {
    return a.faces != b.faces ? a.faces > b.faces : a.quality < b.quality;
  });
  const std::uint32_t last = best->vertex;
  vertices.push_back(last);
  // Cells without the new vertex are there already.
  polyhedron.cells.grow(x, [&](std::uint32_t code) {
    if (x.is_wall(code)) return false;
    const std::uint32_t apex = x.apex_of(x.across(code));
    return apex == last || (has(x.cell(cell_of(code)).vertices, last) && has(vertices, apex));
  });
  return true;
}

/// Lists the faces of the polyhedron. \return is it a ball without walls, vertices and segments inside?
bool find_hull(const CellComplex& x, ReconnectionScratch& polyhedron) {
  const tets::CellSet& cells = polyhedron.cells;
  std::vector<tets::Triangle>& hull = polyhedron.hull;
  std::vector<std::uint64_t>& edges = polyhedron.edges;
  hull.clear();
  edges.clear();
  bool has_wall_inside = false;
  cells.visit_hull(x, [&](std::uint32_t code) {
    const std::uint32_t beyond = x.across(code);
    has_wall_inside = has_wall_inside || (beyond != tets::no_neighbor && cells.contains(cell_of(beyond)));
    if (has_wall_inside) return;
    const auto& [a, b, c] = hull.emplace_back(x.corners_of(code));
    edges.insert(edges.end(), {edge_key(a, b), edge_key(b, c), edge_key(c, a)});
  });
  if (has_wall_inside) return false;
  std::ranges::sort(edges);
  for (std::size_t i = 0; i < edges.size(); i += 2)
    if (edges[i] != edges[i + 1] || (i + 2 < edges.size() && edges[i] == edges[i + 2])) return false;
  // Euler's formula for a sphere; each edge is listed twice.
  return polyhedron.vertices.size() + hull.size() == edges.size() / 2 + 2 &&
         std::ranges::all_of(polyhedron.vertices, [&](std::uint32_t v) { return tets::is_on_hull(hull, v, v); }) &&
         keeps_segments(x, cells.cells(), [&](std::uint32_t a, std::uint32_t b) {
           return std::ranges::binary_search(edges, edge_key(a, b));
         });
}

}  // namespace

bool plan_reconnection(const CellComplex& x, CellId cell, double least, ReconnectionScratch& polyhedron,
                       tets::Change& change) {
  polyhedron.cells.start(x, cell);
  const auto& v = x.cell(cell).vertices;
  polyhedron.vertices.assign(v.begin(), v.end());
  for (const std::size_t size : sizes) {
    while (polyhedron.vertices.size() < size)
      if (!add_vertex(x, polyhedron)) return false;
    if (!find_hull(x, polyhedron)) continue;
    change.clear();
    if (!polyhedron.filler.fill(x, polyhedron.hull, x.region(cell), least, change.new_cells)) continue;
    change.old_cells = polyhedron.cells.cells();
    return true;
  }
  return false;
}

}  // namespace ccdt::improve
