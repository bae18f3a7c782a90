#include "bench/verify/polygon_cells.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace ccdt::verify {

namespace {

std::vector<Edge> edges_of(const std::vector<std::uint32_t>& polygon, std::span<const std::uint32_t> site_of_input) {
  std::vector<Edge> edges;
  const std::size_t n = polygon.size();
  for (std::size_t i = 0; i < n && n > 1; ++i) {
    const Edge e = {site_of_input[polygon[i]], site_of_input[polygon[(i + 1) % n]]};
    if (e[0] != e[1]) edges.push_back(e);
  }
  return edges;
}

Point3 area_vector(const PolygonCell& loop, std::span<const Point3> position) {
  Point3 sum;
  if (loop.empty()) return sum;
  const Point3 origin = position[loop[0][0]];
  for (const auto& [a, b] : loop) sum = sum + cross(position[a] - origin, position[b] - origin);
  return sum;
}

/// A drawing of the facet seen along the axis that its plane is most across.
struct Drawing {
  std::size_t first = 0, second = 1;
  std::span<const Point3> position;

  std::array<double, 2> at(const Point3& p) const { return {as_array(p)[first], as_array(p)[second]}; }
  std::array<double, 2> at(std::uint32_t site) const { return at(position[site]); }
};

Drawing draw(const Point3& normal, std::span<const Point3> position) {
  const auto n = as_array(normal);
  std::size_t axis = 0;
  for (std::size_t i = 1; i < 3; ++i)
    if (std::fabs(n[i]) > std::fabs(n[axis])) axis = i;
  Drawing drawing{(axis + 1) % 3, (axis + 2) % 3, position};
  if (n[axis] < 0) std::swap(drawing.first, drawing.second);
  return drawing;
}

double area(const Drawing& drawing, const PolygonCell& loop) {
  double sum = 0;
  const auto o = drawing.at(loop[0][0]);
  for (const auto& [u, v] : loop) {
    const auto a = drawing.at(u), b = drawing.at(v);
    sum += (a[0] - o[0]) * (b[1] - o[1]) - (a[1] - o[1]) * (b[0] - o[0]);
  }
  return sum / 2;
}

bool contains(const Drawing& drawing, std::span<const Edge> loop, const std::array<double, 2>& p) {
  bool inside = false;
  for (const auto& [u, v] : loop) {
    const auto a = drawing.at(u), b = drawing.at(v);
    if ((a[1] > p[1]) == (b[1] > p[1])) continue;
    if (p[0] < a[0] + (p[1] - a[1]) / (b[1] - a[1]) * (b[0] - a[0])) inside = !inside;
  }
  return inside;
}

/// Closed walks around the drawing's faces, each with its face to the left: at each vertex the next edge clockwise from
/// the one that it came by.
std::vector<PolygonCell> trace_loops(const Drawing& drawing, const std::set<Edge>& undirected) {
  std::map<std::uint32_t, std::vector<std::pair<double, std::uint32_t>>> around;
  for (const auto& [a, b] : undirected) {
    const auto p = drawing.at(a), q = drawing.at(b);
    around[a].push_back({std::atan2(q[1] - p[1], q[0] - p[0]), b});
    around[b].push_back({std::atan2(p[1] - q[1], p[0] - q[0]), a});
  }
  for (auto& [v, out] : around) std::sort(out.begin(), out.end());
  const auto next = [&](const Edge& e) -> Edge {
    const auto& out = around[e[1]];
    const auto back = std::find_if(out.begin(), out.end(), [&](const auto& o) { return o.second == e[0]; });
    return {e[1], (back == out.begin() ? out.back() : *(back - 1)).second};
  };
  std::set<Edge> left;
  for (const auto& [a, b] : undirected) left.insert({{a, b}, {b, a}});
  std::vector<PolygonCell> loops;
  while (!left.empty()) {
    loops.emplace_back();
    for (Edge e = *left.begin(); left.erase(e) > 0; e = next(e)) loops.back().push_back(e);
  }
  return loops;
}

bool share_a_vertex(const std::vector<Edge>& a, const std::vector<Edge>& b) {
  for (const auto& e : a)
    for (const auto& f : b)
      if (e[0] == f[0]) return true;
  return false;
}

/// The smallest of the outer loops around a point that `skip` does not rule out, or none.
template <class Skip>
std::size_t smallest_around(const Drawing& drawing, const std::vector<PolygonCell>& loops,
                            const std::vector<double>& areas, const std::array<double, 2>& p, const Skip& skip) {
  std::size_t smallest = loops.size();
  for (std::size_t i = 0; i < loops.size(); ++i) {
    if (areas[i] <= 0 || (smallest < loops.size() && areas[i] >= areas[smallest])) continue;
    if (contains(drawing, loops[i], p) && !skip(i)) smallest = i;
  }
  return smallest;
}

}  // namespace

DrawnLoops trace_drawing(const Point3& normal, const std::set<Edge>& undirected, std::span<const Point3> position) {
  const Drawing drawing = draw(normal, position);
  DrawnLoops drawn;
  auto& [loops, areas, cells] = drawn;
  loops = trace_loops(drawing, undirected);
  double largest = 0;
  for (const auto& loop : loops) areas.push_back(area(drawing, loop));
  for (const double a : areas) largest = std::max(largest, std::fabs(a));
  for (double& a : areas)
    if (std::fabs(a) < 1e-14 * largest) a = 0;  // a walk around edges that enclose nothing
  cells = loops;
  for (std::size_t i = 0; i < loops.size(); ++i) {
    if (areas[i] > 0) continue;
    const std::size_t around = smallest_around(drawing, loops, areas, drawing.at(loops[i][0][0]),
                                               [&](std::size_t j) { return share_a_vertex(loops[i], loops[j]); });
    if (around < loops.size()) cells[around].insert(cells[around].end(), loops[i].begin(), loops[i].end());
  }
  return drawn;
}

bool encloses(const Point3& normal, std::span<const Edge> loop, std::span<const Point3> position, const Point3& point) {
  const Drawing drawing = draw(normal, position);
  return contains(drawing, loop, drawing.at(point));
}

PolygonCells find_polygon_cells(const plc::PolygonFacet& facet, std::span<const std::uint32_t> site_of_input,
                                std::span<const Point3> position) {
  PolygonCells result;
  std::vector<PolygonCell> polygons;
  for (const auto& polygon : facet.polygons) polygons.push_back(edges_of(polygon, site_of_input));
  if (polygons.size() == 1 && facet.holes.empty()) {
    result.cells.push_back(polygons[0]);
    return result;
  }
  Point3 normal;
  std::set<Edge> undirected;
  for (const auto& polygon : polygons) {
    const Point3 n = area_vector(polygon, position);
    if (squared_length(n) > squared_length(normal)) normal = n;
    for (const Edge& e : polygon) undirected.insert(ascending(e));
  }
  const Drawing drawing = draw(normal, position);
  const auto [loops, areas, cells] = trace_drawing(normal, undirected, position);
  std::vector<bool> dropped(loops.size(), false);
  for (const Point3& hole : facet.holes) {
    const std::size_t around =
        smallest_around(drawing, loops, areas, drawing.at(hole), [](std::size_t) { return false; });
    if (around < loops.size()) dropped[around] = true;
  }
  std::set<Edge> kept;
  for (std::size_t i = 0; i < loops.size(); ++i) {
    if (areas[i] <= 0 || dropped[i]) continue;
    result.cells.push_back(cells[i]);
    kept.insert(cells[i].begin(), cells[i].end());
  }
  for (const auto& [a, b] : undirected)
    if (kept.count({a, b}) > 0 && kept.count({b, a}) > 0) result.segments.push_back({a, b});
  return result;
}

}  // namespace ccdt::verify
