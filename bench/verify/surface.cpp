#include "bench/verify/surface.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "bench/verify/exact.h"
#include "engine/base/flatness.h"
#include "engine/base/parallel.h"
#include "engine/base/simplex_map.h"
#include "engine/base/sort_in_runs.h"

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

/// Twice the area.
Point3 area_vector(std::span<const Edge> loop, std::span<const Point3> position) {
  Point3 sum;
  if (loop.empty()) return sum;
  const Point3 origin = position[loop[0][0]];
  for (const auto& [a, b] : loop) sum = sum + cross(position[a] - origin, position[b] - origin);
  return sum;
}

/// The longest of the vectors whose sum is the area vector. It is along the normal even if a loop runs back over
/// itself.
Point3 normal_of(std::span<const Edge> loop, std::span<const Point3> position) {
  Point3 longest;
  for (const auto& [a, b] : loop) {
    const Point3& origin = position[loop[0][0]];
    const Point3 part = cross(position[a] - origin, position[b] - origin);
    if (squared_length(part) > squared_length(longest)) longest = part;
  }
  return longest;
}

/// Finds which sites of a list are on an edge.
class SiteFinder {
 public:
  SiteFinder(const Surface& surface, std::vector<std::uint32_t> sites)
      : surface_(surface), sites_(std::move(sites)), tree_(boxes_of(surface, sites_), surface.tolerances) {}

  /// The sites on the edge in order from its first end to its second, without the ends.
  std::vector<std::uint32_t> within(const Edge& edge) const {
    std::vector<std::uint32_t> near;
    const Box box = hull(box_of(surface_.at(edge[0])), box_of(surface_.at(edge[1])));
    tree_.for_each_meeting(expanded(box, surface_.tolerances.place),
                           [&](std::uint32_t i) { near.push_back(sites_[i]); });
    return select_within(surface_, edge, near);
  }

 private:
  static RawVector<Box> boxes_of(const Surface& surface, std::span<const std::uint32_t> sites) {
    RawVector<Box> places;
    for (const std::uint32_t s : sites) places.push_back(box_of(surface.at(s)));
    return places;
  }

  const Surface& surface_;
  std::vector<std::uint32_t> sites_;
  ScaledBoxTree tree_;
};

bool meets_a_site_twice(std::span<const Edge> loop) {
  std::set<std::uint32_t> met;
  return std::ranges::any_of(loop, [&](const Edge& e) { return !met.insert(e[0]).second; });
}

/// Is one of the loop's sites within one of its edges?
bool runs_over_itself(const Surface& surface, std::span<const Edge> loop) {
  constexpr std::size_t few = 32;
  if (loop.size() == 3) return false;
  std::vector<std::uint32_t> sites;
  for (const Edge& e : loop) sites.push_back(e[0]);
  if (loop.size() <= few)
    return std::ranges::any_of(loop, [&](const Edge& e) { return !select_within(surface, e, sites).empty(); });
  const SiteFinder finder(surface, std::move(sites));
  return std::ranges::any_of(loop, [&](const Edge& e) { return !finder.within(e).empty(); });
}

/// A drawing of the facet as seen along the axis that is nearest to its normal.
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

/// Closed walks around the drawing's faces, each with its face to the left. At each vertex, a walk leaves by the next
/// edge clockwise from the one by which it arrived.
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

struct PolygonCells {
  std::vector<PolygonCell> cells;
  std::vector<Edge> segments;  ///< edges that the polygons draw within the facet
};

/// The edges of polygons, each once, split where other polygons have a site on them.
std::set<Edge> find_lines(const Surface& surface, const std::vector<PolygonCell>& polygons) {
  std::vector<std::uint32_t> sites;
  for (const PolygonCell& polygon : polygons)
    for (const Edge& e : polygon) sites.insert(sites.end(), e.begin(), e.end());
  sort_and_unique(sites);
  std::set<Edge> lines;
  for (const PolygonCell& polygon : polygons)
    for (const Edge& e : polygon) {
      std::uint32_t from = e[0];
      for (const std::uint32_t to : select_within(surface, e, sites))
        lines.insert(ascending(Edge{std::exchange(from, to), to}));
      lines.insert(ascending(Edge{from, e[1]}));
    }
  return lines;
}

/// How many edges of an outline are between each of its cells and the outside, at least.
std::vector<std::size_t> find_depths(std::span<const PolygonCell> cells, const std::vector<double>& areas) {
  std::map<Edge, std::size_t> to_the_left;
  for (std::size_t i = 0; i < cells.size(); ++i)
    if (areas[i] > 0)
      for (const Edge& e : cells[i]) to_the_left[e] = i;
  std::vector<std::size_t> depth(cells.size(), 0), queue;
  const auto enter = [&](std::size_t cell, std::size_t its_depth) {
    if (depth[cell] > 0) return;
    depth[cell] = its_depth;
    queue.push_back(cell);
  };
  for (const auto& [edge, cell] : to_the_left)
    if (!to_the_left.contains({edge[1], edge[0]})) enter(cell, 1);
  for (std::size_t next = 0; next < queue.size(); ++next)
    for (const Edge& e : cells[queue[next]])
      if (const auto across = to_the_left.find({e[1], e[0]}); across != to_the_left.end())
        enter(across->second, depth[queue[next]] + 1);
  return depth;
}

/// The cells into which the polygons of a facet divide their plane, without those that hold a hole's point. An edge
/// counts once, however often the polygons run along it. In a surface, a polygon is an outline, which may run around
/// holes by bridges: every second cell from the outside is a hole.
PolygonCells find_polygon_cells(const plc::PolygonFacet& facet, plc::InputPlc::Inside inside, const Surface& surface) {
  const std::span<const std::uint32_t> site_of_input = surface.sites.of_input;
  const std::span<const Point3> position = surface.sites.position;
  PolygonCells result;
  std::vector<PolygonCell> polygons;
  for (const auto& polygon : facet.polygons) polygons.push_back(edges_of(polygon, site_of_input));
  if (is_one_loop(facet) && !meets_a_site_twice(polygons[0]) && !runs_over_itself(surface, polygons[0])) {
    result.cells.push_back(polygons[0]);
    return result;
  }
  Point3 normal;
  for (const auto& polygon : polygons) {
    const Point3 n = normal_of(polygon, position);
    if (squared_length(n) > squared_length(normal)) normal = n;
  }
  const std::set<Edge> undirected = find_lines(surface, polygons);
  const Drawing drawing = draw(normal, position);
  const auto [loops, areas, cells] = trace_drawing(normal, undirected, position);
  std::vector<bool> dropped(loops.size(), false);
  for (const Point3& hole : facet.holes) {
    const std::size_t around =
        smallest_around(drawing, loops, areas, drawing.at(hole), [](std::size_t) { return false; });
    if (around < loops.size()) dropped[around] = true;
  }
  const bool is_outline = inside == plc::InputPlc::Inside::even_odd && is_one_loop(facet);
  std::vector<std::size_t> depths(cells.size(), 1);
  if (is_outline) depths = find_depths(cells, areas);
  std::set<Edge> kept;
  for (std::size_t i = 0; i < loops.size(); ++i) {
    if (areas[i] <= 0 || dropped[i] || depths[i] % 2 == 0) continue;
    result.cells.push_back(cells[i]);
    kept.insert(cells[i].begin(), cells[i].end());
  }
  if (is_outline) return result;
  for (const auto& [a, b] : undirected)
    if (kept.count({a, b}) > 0 && kept.count({b, a}) > 0) result.segments.push_back({a, b});
  return result;
}

/// Do the edges enclose nothing, because each occurs in both directions or because all are on one line?
bool is_empty(const PolygonCell& cell, std::span<const Point3> position) {
  if (cell.empty()) return true;
  const auto& [a, b] = cell[0];
  if (std::ranges::all_of(cell,
                          [&](const Edge& e) { return are_on_one_line(position[a], position[b], position[e[0]]); }))
    return true;
  std::vector<Edge> there = cell, back;
  for (const auto& [from, to] : cell) back.push_back({to, from});
  std::sort(there.begin(), there.end());
  std::sort(back.begin(), back.end());
  return there == back;
}

/// Adds a piece unless it has no area, which may also be because vertices are in one place.
void add_piece(PolygonCell cell, int marker, std::uint32_t number, std::span<const Point3> position, Pieces& pieces) {
  std::erase_if(cell, [](const Edge& e) { return e[0] == e[1]; });
  if (!is_empty(cell, position)) pieces.add(cell, marker, number);
}

/// Adds the triangles that have an area.
void add_triangles(const plc::InputPlc& input, const Sites& sites, Pieces& pieces) {
  const auto site = [&](std::size_t i, std::size_t k) { return sites.of_input[input.triangles[i][k]]; };
  const auto at = [&](std::size_t i, std::size_t k) { return sites.position[site(i, k)]; };
  const auto with_area = parallel_select(input.triangles.size(), chunk_length,
                                         [&](std::size_t i) { return !are_on_one_line(at(i, 0), at(i, 1), at(i, 2)); });
  for (const std::uint32_t i : with_area)
    pieces.add(std::array<Edge, 3>{{{site(i, 0), site(i, 1)}, {site(i, 1), site(i, 2)}, {site(i, 2), site(i, 0)}}},
               input.triangle_markers.empty() ? 0 : input.triangle_markers[i],
               input.triangle_numbers.empty() ? i : input.triangle_numbers[i]);
}

Pieces find_pieces(const plc::InputPlc& input, Surface& surface) {
  const auto& site = surface.sites.of_input;
  Pieces pieces;
  add_triangles(input, surface.sites, pieces);
  for (const plc::PolygonFacet& facet : input.polygon_facets) {
    PolygonCells cells = find_polygon_cells(facet, input.inside, surface);
    for (PolygonCell& cell : cells.cells)
      add_piece(std::move(cell), facet.marker, facet.number, surface.sites.position, pieces);
    surface.segments.insert(surface.segments.end(), cells.segments.begin(), cells.segments.end());
  }
  for (const auto& [a, b] : input.segments)
    if (site[a] != site[b]) surface.segments.push_back({site[a], site[b]});
  return pieces;
}

void index_edges(Surface& surface) {
  const std::size_t n = surface.directed.size();
  surface.piece_of.resize(n);
  surface.edge_of.resize(n);
  std::vector<AtEdge> at_edges(n);  // the directed edges
  parallel_for(surface.pieces(), chunk_length, [&](std::size_t p) {
    for (const std::uint32_t use : surface.uses_of(static_cast<std::uint32_t>(p))) {
      surface.piece_of[use] = static_cast<std::uint32_t>(p);
      at_edges[use] = {edge_key(surface.directed[use][0], surface.directed[use][1]), use};
    }
  });
  auto& [first, uses] = surface.uses;
  surface.edges.clear();
  first.clear();
  uses.clear();
  uses.reserve(n);
  for_each_edge_group(at_edges, [&](std::span<const AtEdge> group) {
    first.push_back(static_cast<std::uint32_t>(uses.size()));
    for (const AtEdge& entry : group) {
      surface.edge_of[entry.value] = static_cast<std::uint32_t>(surface.edges.size());
      uses.push_back(entry.value);
    }
    surface.edges.push_back(ascending(surface.directed[group[0].value]));
  });
  first.push_back(static_cast<std::uint32_t>(n));
}

/// Splits each edge that is not between two facets at the ends of other such edges. (An edge between two facets is
/// complete as it is.)
void split_edges(Surface& surface) {
  std::vector<std::uint32_t> sites;
  for (std::uint32_t e = 0; e < surface.edges.size(); ++e)
    if (surface.use_count(e) != 2) sites.insert(sites.end(), surface.edges[e].begin(), surface.edges[e].end());
  if (sites.empty()) return;
  sort_and_unique(sites);
  const SiteFinder finder(surface, std::move(sites));
  split_directed(
      [&](std::uint32_t e) {
        return surface.use_count(e) == 2 ? std::vector<std::uint32_t>{} : finder.within(surface.edges[e]);
      },
      surface);
}

}  // namespace

Tolerances find_tolerances(const plc::InputPlc& input, double flatness) {
  const double box = largest_extent(input.vertices);
  // A mesher may measure flatness against the next power of two above the box, and on both sides of a plane that is not
  // ours.
  constexpr double slack = 4;
  const double flat = slack * flatness_for(input.vertices, flatness) * box;
  // New vertices of the mesh are rounded, too.
  const double rounding = std::numeric_limits<double>::epsilon() * largest_coordinate(input.vertices);
  return {box, rounding, 0.1 * flatness * box + rounding, flat + rounding, slack * flatness * box + rounding};
}

Tolerances narrowed(const Tolerances& given, double part) {
  const auto narrow = [&](double tolerance) { return part * (tolerance - given.rounding) + given.rounding; };
  return {given.box, given.rounding, narrow(given.place), narrow(given.flat), narrow(given.touch)};
}

Tolerances exact_contacts(const Tolerances& given, double part) {
  const double rounding = part > 0 ? 1e-12 * given.box + given.rounding : 1e-15 * given.box;
  return {given.box, rounding, rounding, part > 0 ? narrowed(given, part).flat : rounding, rounding, true};
}

void Pieces::add(std::span<const Edge> edges, int its_marker, std::uint32_t its_number) {
  directed.insert(directed.end(), edges.begin(), edges.end());
  piece_begin.push_back(static_cast<std::uint32_t>(directed.size()));
  marker.push_back(its_marker);
  number.push_back(its_number);
}

ScaledBoxTree::ScaledBoxTree(RawVector<Box> boxes, const Tolerances& tolerances)
    : scale_(tolerances.box > 1e-300 ? std::ldexp(1, 21 - std::ilogb(tolerances.box)) : 1), tree_([&] {
        for (Box& box : boxes) box = scaled(box);
        return std::move(boxes);
      }()) {}

RawVector<Box> Surface::boxes_of_pieces() const {
  RawVector<Box> boxes(pieces(), empty_box);
  parallel_for(pieces(), chunk_length, [&](std::size_t p) {
    for (const auto& [site, next] : edges_of(static_cast<std::uint32_t>(p)))
      boxes[p] = hull(boxes[p], box_of(at(site)));
  });
  return boxes;
}

void set_pieces(Pieces pieces, Surface& surface) {
  static_cast<Pieces&>(surface) = std::move(pieces);
  index_edges(surface);
  surface.area_vector.resize(surface.pieces());
  parallel_for(surface.pieces(), chunk_length, [&](std::size_t p) {
    const auto edges = surface.edges_of(static_cast<std::uint32_t>(p));
    surface.area_vector[p] = 0.5 * area_vector(edges, surface.sites.position);
  });
}

std::vector<std::uint32_t> select_within(const Surface& surface, const Edge& edge,
                                         std::span<const std::uint32_t> sites) {
  const Point3 a = surface.at(edge[0]), b = surface.at(edge[1]);
  const double tolerance = surface.tolerances.place, length = std::sqrt(squared_length(b - a));
  std::vector<std::pair<double, std::uint32_t>> found;
  for (const std::uint32_t s : sites) {
    if (s == edge[0] || s == edge[1]) continue;
    const Point3 p = surface.at(s) - a;
    const double along = dot(p, b - a) / length;
    if (along <= 0 || along >= length) continue;
    if (squared_length(p - (along / length) * (b - a)) > tolerance * tolerance) continue;
    if (!surface.tolerances.exact_contacts || are_on_one_line(a, b, surface.at(s))) found.push_back({along, s});
  }
  sort_and_unique(found);
  std::vector<std::uint32_t> within;
  for (const auto& [along, site] : found) within.push_back(site);
  return within;
}

Surface find_surface(const plc::InputPlc& input, Sites sites, const Tolerances& tolerances) {
  Surface surface;
  surface.sites = std::move(sites);
  surface.tolerances = tolerances;
  set_pieces(find_pieces(input, surface), surface);
  split_edges(surface);
  return surface;
}

void split_segments(const std::vector<bool>& chosen, Surface& surface) {
  if (std::ranges::find(chosen, true) == chosen.end()) return;
  std::vector<std::uint32_t> sites = surface.sites.of_input;
  sort_and_unique(sites);
  const SiteFinder finder(surface, std::move(sites));
  std::vector<Edge> parts;
  for (std::size_t s = 0; s < surface.segments.size(); ++s) {
    auto [from, end] = surface.segments[s];
    if (chosen[s])
      for (const std::uint32_t to : finder.within(surface.segments[s])) parts.push_back({std::exchange(from, to), to});
    parts.push_back({from, end});
  }
  surface.segments = std::move(parts);
}

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
    // The loop's vertices may be on the border of the cell, for example if a line crosses the cell.
    const auto& [a, b] = loops[i][0];
    const auto within = drawing.at(position[a] + 0.5 * (position[b] - position[a]));
    const std::size_t around = smallest_around(drawing, loops, areas, within,
                                               [&](std::size_t j) { return share_a_vertex(loops[i], loops[j]); });
    if (around < loops.size()) cells[around].insert(cells[around].end(), loops[i].begin(), loops[i].end());
  }
  return drawn;
}

bool encloses(const Point3& normal, std::span<const Edge> loop, std::span<const Point3> position, const Point3& point) {
  const Drawing drawing = draw(normal, position);
  return contains(drawing, loop, drawing.at(point));
}

}  // namespace ccdt::verify
