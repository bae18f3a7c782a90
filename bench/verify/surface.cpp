#include "bench/verify/surface.h"

#include <bit>
#include <cmath>
#include <numeric>
#include <unordered_map>
#include <utility>

#include "bench/verify/polygon_cells.h"

namespace ccdt::verify {

namespace {

/// Three integers that name a point, or a cell of a grid.
using GridKey = std::array<std::int64_t, 3>;

struct GridKeyHash {
  std::size_t operator()(const GridKey& key) const {
    std::uint64_t h = 0;
    for (const std::int64_t part : key) {
      h = (h ^ static_cast<std::uint64_t>(part)) * 0x9E3779B97F4A7C15u;
      h ^= h >> 32;
    }
    return h;
  }
};

GridKey bits(const Point3& p) {
  const auto bits_of = [](double c) { return std::bit_cast<std::int64_t>(c + 0.0); };  // -0 is 0
  return {bits_of(p.x), bits_of(p.y), bits_of(p.z)};
}

/// Finds the nearest of a set of points within a fixed distance: a grid of cells of twice that size.
class NearestVertex {
 public:
  explicit NearestVertex(double tolerance) : tolerance_(tolerance) {}

  void add(const Point3& p, std::uint32_t vertex) { cells_.emplace(cell(p), std::pair{p, vertex}); }

  std::uint32_t find(const Point3& p) const {
    double best = tolerance_ * tolerance_;
    std::uint32_t nearest = none;
    const GridKey low = cell({p.x - tolerance_, p.y - tolerance_, p.z - tolerance_});
    const GridKey high = cell({p.x + tolerance_, p.y + tolerance_, p.z + tolerance_});
    for (std::int64_t x = low[0]; x <= high[0]; ++x)
      for (std::int64_t y = low[1]; y <= high[1]; ++y)
        for (std::int64_t z = low[2]; z <= high[2]; ++z) {
          const auto [begin, end] = cells_.equal_range({x, y, z});
          for (auto i = begin; i != end; ++i) {
            const double distance = squared_length(i->second.first - p);
            if (distance > best) continue;
            best = distance;
            nearest = i->second.second;
          }
        }
    return nearest;
  }

 private:
  /// Clamped, so that a vertex far away, which is near nothing, does not overflow the integers.
  GridKey cell(const Point3& p) const {
    const auto index = [&](double c) {
      return static_cast<std::int64_t>(std::fmin(std::fmax(std::floor(c / (2 * tolerance_)), -9e17), 9e17));
    };
    return {index(p.x), index(p.y), index(p.z)};
  }

  double tolerance_;
  std::unordered_multimap<GridKey, std::pair<Point3, std::uint32_t>, GridKeyHash> cells_;
};

/// Do the edges enclose nothing, because each runs there and back?
bool is_empty(const PolygonCell& cell) {
  std::vector<Edge> there = cell, back;
  for (const auto& [a, b] : cell) back.push_back({b, a});
  std::sort(there.begin(), there.end());
  std::sort(back.begin(), back.end());
  return there == back;
}

/// Leaves out what vertices in one place have made of no extent.
void add_piece(PolygonCell cell, int marker, std::uint32_t number, Pieces& pieces) {
  std::erase_if(cell, [](const Edge& e) { return e[0] == e[1]; });
  if (!is_empty(cell)) pieces.add(cell, marker, number);
}

Pieces find_pieces(const plc::InputPlc& input, Surface& surface) {
  const auto& site = surface.sites.of_input;
  Pieces pieces;
  for (std::size_t i = 0; i < input.triangles.size(); ++i) {
    const auto& [a, b, c] = input.triangles[i];
    add_piece({{site[a], site[b]}, {site[b], site[c]}, {site[c], site[a]}},
              input.triangle_markers.empty() ? 0 : input.triangle_markers[i],
              input.triangle_numbers.empty() ? static_cast<std::uint32_t>(i) : input.triangle_numbers[i], pieces);
  }
  for (const plc::PolygonFacet& facet : input.polygon_facets) {
    PolygonCells cells = find_polygon_cells(facet, site, surface.sites.position);
    for (PolygonCell& cell : cells.cells) add_piece(std::move(cell), facet.marker, facet.number, pieces);
    surface.segments.insert(surface.segments.end(), cells.segments.begin(), cells.segments.end());
  }
  for (const auto& [a, b] : input.segments)
    if (site[a] != site[b]) surface.segments.push_back({site[a], site[b]});
  return pieces;
}

void index_edges(Surface& surface) {
  const std::size_t n = surface.directed.size();
  surface.piece_of.resize(n);
  for (std::uint32_t p = 0; p < surface.pieces(); ++p)
    for (const std::uint32_t use : surface.uses_of(p)) surface.piece_of[use] = p;
  std::vector<std::uint64_t> keys(n);  // compare faster than edges
  std::transform(surface.directed.begin(), surface.directed.end(), keys.begin(),
                 [](const Edge& e) { return key(ascending(e)); });
  auto& [first, uses] = surface.uses;
  uses.resize(n);
  std::iota(uses.begin(), uses.end(), 0u);
  std::sort(uses.begin(), uses.end(),
            [&](std::uint32_t i, std::uint32_t j) { return keys[i] != keys[j] ? keys[i] < keys[j] : i < j; });
  surface.edge_of.resize(n);
  surface.edges.clear();
  first.clear();
  for (std::uint32_t i = 0; i < n; ++i) {
    if (i == 0 || keys[uses[i]] != keys[uses[i - 1]]) {
      surface.edges.push_back(ascending(surface.directed[uses[i]]));
      first.push_back(i);
    }
    surface.edge_of[uses[i]] = static_cast<std::uint32_t>(surface.edges.size() - 1);
  }
  first.push_back(static_cast<std::uint32_t>(n));
}

/// The sites strictly within an edge out of those in the order of their x.
std::vector<std::uint32_t> sites_within(const Surface& surface, const Edge& edge,
                                        const std::vector<std::uint32_t>& sites) {
  const double a = surface.at(edge[0]).x, b = surface.at(edge[1]).x, tolerance = surface.tolerances.place;
  const auto x = [&](std::uint32_t site) { return surface.at(site).x; };
  const auto begin = std::ranges::lower_bound(sites, std::min(a, b) - tolerance, {}, x);
  const auto end = std::ranges::upper_bound(sites, std::max(a, b) + tolerance, {}, x);
  return select_within(surface, edge, {begin, end});
}

/// Splits edges that do not have two facets at the ends of others of that kind. (An edge between two facets is complete
/// as it is.)
void split_edges(Surface& surface) {
  std::vector<std::uint32_t> sites;
  for (std::uint32_t e = 0; e < surface.edges.size(); ++e)
    if (surface.use_count(e) != 2) sites.insert(sites.end(), surface.edges[e].begin(), surface.edges[e].end());
  if (sites.empty()) return;
  sort_and_unique(sites);
  std::sort(sites.begin(), sites.end(),
            [&](std::uint32_t a, std::uint32_t b) { return surface.at(a).x < surface.at(b).x; });
  split_directed(
      [&](std::uint32_t e) {
        return surface.use_count(e) == 2 ? std::vector<std::uint32_t>{}
                                         : sites_within(surface, surface.edges[e], sites);
      },
      surface);
}

}  // namespace

Sites match_sites(const plc::InputPlc& input, const mesh::TetMesh& mesh, const Topology& topology, double tolerance) {
  Sites sites;
  sites.mesh_vertices = static_cast<std::uint32_t>(mesh.vertices.size());
  sites.position = mesh.vertices;
  sites.of_input.assign(input.vertices.size(), none);
  std::unordered_map<GridKey, std::uint32_t, GridKeyHash> exact;
  exact.reserve(mesh.vertices.size());
  for (std::uint32_t v = 0; v < mesh.vertices.size(); ++v)
    if (topology.used(v)) exact.emplace(bits(mesh.vertices[v]), v);
  bool all_exact = true;
  for (std::size_t i = 0; i < input.vertices.size(); ++i) {
    const auto found = exact.find(bits(input.vertices[i]));
    if (found != exact.end()) sites.of_input[i] = found->second;
    all_exact = all_exact && found != exact.end();
  }
  if (all_exact) return sites;

  NearestVertex near(tolerance);
  for (std::uint32_t v = 0; v < mesh.vertices.size(); ++v)
    if (topology.used(v)) near.add(mesh.vertices[v], v);
  std::vector<bool> moved(mesh.vertices.size(), false);
  for (std::size_t i = 0; i < input.vertices.size(); ++i) {
    std::uint32_t& site = sites.of_input[i];
    if (site != none) continue;
    site = near.find(input.vertices[i]);
    if (site != none && !moved[site]) {
      moved[site] = true;
      sites.position[site] = input.vertices[i];
    }
    if (site != none) continue;
    site = exact.emplace(bits(input.vertices[i]), static_cast<std::uint32_t>(sites.position.size())).first->second;
    if (site == sites.position.size()) sites.position.push_back(input.vertices[i]);
  }
  return sites;
}

Tolerances find_tolerances(const plc::InputPlc& input, double flatness) {
  const Box bounds = bounding_box(input.vertices);
  const Point3 extent = bounds.high - bounds.low;
  const double box = input.vertices.empty() ? 0 : std::max({extent.x, extent.y, extent.z});
  // A mesher may measure flatness against the next power of two above the box, and on both sides of a plane that is not
  // ours.
  return {box, 0.1 * flatness * box, 4 * flatness * box};
}

void Pieces::add(std::span<const Edge> edges, int its_marker, std::uint32_t its_number) {
  directed.insert(directed.end(), edges.begin(), edges.end());
  piece_begin.push_back(static_cast<std::uint32_t>(directed.size()));
  marker.push_back(its_marker);
  number.push_back(its_number);
}

Box Surface::box_of_piece(std::uint32_t piece) const {
  Box box = box_of(origin(piece));
  for (const auto& [site, next] : edges_of(piece)) box = hull(box, box_of(at(site)));
  return box;
}

void set_pieces(Pieces pieces, Surface& surface) {
  static_cast<Pieces&>(surface) = std::move(pieces);
  index_edges(surface);
  surface.area_vector.resize(surface.pieces());
  for (std::uint32_t p = 0; p < surface.pieces(); ++p) {
    const Point3 origin = surface.origin(p);
    Point3 sum;
    for (const auto& [a, b] : surface.edges_of(p)) sum = sum + cross(surface.at(a) - origin, surface.at(b) - origin);
    surface.area_vector[p] = 0.5 * sum;
  }
}

void split_directed(const std::function<std::vector<std::uint32_t>(std::uint32_t edge)>& within, Surface& surface) {
  Pieces split;
  std::vector<Edge> edges;
  for (std::uint32_t p = 0; p < surface.pieces(); ++p) {
    edges.clear();
    for (const std::uint32_t use : surface.uses_of(p)) {
      auto between = within(surface.edge_of[use]);
      if (!surface.is_forward(use)) std::reverse(between.begin(), between.end());
      between.push_back(surface.directed[use][1]);
      std::uint32_t from = surface.directed[use][0];
      for (const std::uint32_t to : between) edges.push_back({std::exchange(from, to), to});
    }
    split.add(edges, surface.marker[p], surface.number[p]);
  }
  if (split.directed.size() > surface.directed.size()) set_pieces(std::move(split), surface);
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
    if (squared_length(p - (along / length) * (b - a)) <= tolerance * tolerance) found.push_back({along, s});
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

}  // namespace ccdt::verify
