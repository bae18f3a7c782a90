#include "engine/repair/fill_holes.h"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "engine/base/errors.h"
#include "engine/plc/edge_table.h"
#include "engine/plc/warped_facets.h"
#include "engine/repair/open_edges.h"

namespace ccdt::repair {
namespace {

using plc::EdgeTable;

std::vector<std::vector<VertexId>> find_rims(const EdgeTable& edges, Rims which) {
  OpenEdges rims = find_open_edges(edges);
  for (std::vector<VertexId>& chain : rims.chains)
    if (is_closed_by_an_edge(chain, edges, which)) rims.loops.push_back(std::move(chain));
  return std::move(rims.loops);
}

/// The triangles of a polygon; none if it cannot be triangulated.
std::vector<plc::VertexTriple> triangulate(std::span<const Point3> points, std::span<const VertexId> corners) {
  plc::InputPlc input;
  for (const VertexId v : corners) input.vertices.push_back(points[v]);
  plc::PolygonFacet facet;
  facet.polygons.resize(1);
  facet.polygons[0].resize(corners.size());
  std::iota(facet.polygons[0].begin(), facet.polygons[0].end(), 0u);
  input.polygon_facets.push_back(std::move(facet));
  std::vector<plc::VertexTriple> triangles;
  try {
    if (auto triangulated = plc::triangulate_warped_facets(input)) input = std::move(*triangulated);
    const plc::UncheckedPlc gathered = plc::gather_plc(input);
    // The corners are distinct, and the grid of a part is finer than that of the whole, so none were merged.
    for (const auto& [a, b, c] : gathered.triangles.corners) triangles.push_back({corners[a], corners[b], corners[c]});
  } catch (const InputError&) {
    triangles.clear();
  }
  return triangles;
}

/// Do the triangles face the same way as their neighbor across the edge ab?
bool fits(const std::vector<plc::VertexTriple>& filling, const plc::VertexTriple& neighbor, VertexId a, VertexId b) {
  const bool along = plc::runs_along(neighbor, a, b);
  return std::ranges::none_of(
      filling, [&](const plc::VertexTriple& t) { return along ? plc::runs_along(t, a, b) : plc::runs_along(t, b, a); });
}

}  // namespace

std::size_t FilledHoles::triangles() const {
  std::size_t sum = 0;
  for (const Lid& lid : lids) sum += lid.triangles.size();
  return sum;
}

FilledHoles fill_holes(plc::UncheckedPlc& soup, Rims which, double reach) {
  const EdgeTable edges = plc::make_edge_table(soup.triangles.corners);
  FilledHoles holes;
  for (const std::vector<VertexId>& loop : find_rims(edges, which)) {
    const std::vector<plc::VertexTriple> filling = triangulate(soup.plc.vertices, loop);
    if (filling.empty()) continue;
    Lid lid;
    std::vector<Point3> rim;
    for (const plc::VertexTriple& t : filling) lid.triangles.push_back(plc::points_of(soup.plc.vertices, t));
    for (const VertexId v : loop) rim.push_back(soup.plc.vertices[v]);
    lid.reach = reach_of(lid.triangles, rim);
    if (lid.reach > reach) {
      ++holes.left_open;
      holes.farthest = std::max(holes.farthest, lid.reach);
      continue;
    }
    const std::uint32_t neighbor = triangle_at(edges, loop[0], loop[1]);
    const int marker = soup.triangles.markers[neighbor];
    const std::uint32_t number = soup.triangles.numbers[neighbor];
    const bool is_right = fits(filling, soup.triangles.corners[neighbor], loop[0], loop[1]);
    for (const auto& [a, b, c] : filling)
      soup.triangles.add(is_right ? plc::VertexTriple{a, b, c} : plc::VertexTriple{a, c, b}, marker, number);
    holes.lids.push_back(std::move(lid));
    holes.rims.push_back(loop);
  }
  return holes;
}

}  // namespace ccdt::repair
