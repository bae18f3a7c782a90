#include "bench/verify/surface.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "bench/verify/polygon_cells.h"

namespace ccdt::verification {

namespace {

using Edge = std::array<std::uint32_t, 2>;

Edge ascending(const Edge& e) {
  return {std::min(e[0], e[1]), std::max(e[0], e[1])};
}

/// Do the edges enclose nothing, because each runs there and back?
bool is_empty(const Cell& cell) {
  std::vector<Edge> there = cell, back;
  for (const auto& [a, b] : cell) back.push_back({b, a});
  std::sort(there.begin(), there.end());
  std::sort(back.begin(), back.end());
  return there == back;
}

/// Leaves out what vertices in one place have made of no extent.
void add_piece(Surface& surface, Cell cell, int marker, std::uint32_t number) {
  std::erase_if(cell, [](const Edge& e) { return e[0] == e[1]; });
  if (is_empty(cell)) return;
  surface.directed.insert(surface.directed.end(), cell.begin(), cell.end());
  surface.piece_begin.push_back(static_cast<std::uint32_t>(surface.directed.size()));
  surface.marker.push_back(marker);
  surface.number.push_back(number);
}

void add_pieces(const InputPlc& input, Surface& surface) {
  const auto& site = surface.sites.of_input;
  surface.piece_begin.push_back(0);
  for (std::size_t i = 0; i < input.triangles.size(); ++i) {
    const auto& [a, b, c] = input.triangles[i];
    add_piece(surface, {{site[a], site[b]}, {site[b], site[c]}, {site[c], site[a]}},
              input.triangle_markers.empty() ? 0 : input.triangle_markers[i],
              input.triangle_numbers.empty() ? static_cast<std::uint32_t>(i) : input.triangle_numbers[i]);
  }
  for (const PolygonFacet& facet : input.polygon_facets) {
    PolygonCells cells = find_polygon_cells(facet, site, surface.sites.position);
    for (Cell& cell : cells.cells) add_piece(surface, std::move(cell), facet.marker, facet.number);
    surface.segments.insert(surface.segments.end(), cells.segments.begin(), cells.segments.end());
  }
  for (const auto& [a, b] : input.segments)
    if (site[a] != site[b]) surface.segments.push_back({site[a], site[b]});
}

void index_edges(Surface& surface) {
  const auto n = static_cast<std::uint32_t>(surface.directed.size());
  surface.piece_of.resize(n);
  for (std::uint32_t p = 0; p < surface.pieces(); ++p)
    for (std::uint32_t i = surface.piece_begin[p]; i < surface.piece_begin[p + 1]; ++i) surface.piece_of[i] = p;
  surface.uses.resize(n);
  for (std::uint32_t i = 0; i < n; ++i) surface.uses[i] = i;
  std::vector<std::uint64_t> key(n);  // both ends in one number, which compares faster
  for (std::uint32_t i = 0; i < n; ++i) {
    const Edge e = ascending(surface.directed[i]);
    key[i] = (std::uint64_t{e[0]} << 32) | e[1];
  }
  std::sort(surface.uses.begin(), surface.uses.end(),
            [&](std::uint32_t i, std::uint32_t j) { return key[i] != key[j] ? key[i] < key[j] : i < j; });
  surface.edge_of.resize(n);
  surface.edges.clear();
  surface.use_begin.clear();
  for (std::uint32_t i = 0; i < n; ++i) {
    const Edge e = ascending(surface.directed[surface.uses[i]]);
    if (surface.edges.empty() || surface.edges.back() != e) {
      surface.edges.push_back(e);
      surface.use_begin.push_back(i);
    }
    surface.edge_of[surface.uses[i]] = static_cast<std::uint32_t>(surface.edges.size() - 1);
  }
  surface.use_begin.push_back(n);
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
  std::sort(sites.begin(), sites.end());
  sites.erase(std::unique(sites.begin(), sites.end()), sites.end());
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

Tolerances find_tolerances(const InputPlc& input, double flatness) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  Point3 low{infinity, infinity, infinity}, high{-infinity, -infinity, -infinity};
  for (const Point3& p : input.vertices) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  const double box = input.vertices.empty() ? 0 : std::max({high.x - low.x, high.y - low.y, high.z - low.z});
  // A mesher may measure flatness against the next power of two above the box, and on both sides of a plane that is not
  // ours.
  return {box, 0.1 * flatness * box, 4 * flatness * box};
}

void index_surface(Surface& surface) {
  index_edges(surface);
  surface.area_vector.resize(surface.pieces());
  for (std::uint32_t p = 0; p < surface.pieces(); ++p) {
    const Point3 origin = surface.origin(p);
    Point3 sum;
    for (std::uint32_t i = surface.piece_begin[p]; i < surface.piece_begin[p + 1]; ++i)
      sum = sum + cross(surface.at(surface.directed[i][0]) - origin, surface.at(surface.directed[i][1]) - origin);
    surface.area_vector[p] = 0.5 * sum;
  }
}

void split_directed(const std::function<std::vector<std::uint32_t>(std::uint32_t edge)>& within, Surface& surface) {
  std::vector<Edge> directed;
  std::vector<std::uint32_t> begin = {0};
  for (std::uint32_t p = 0; p < surface.pieces(); ++p) {
    for (std::uint32_t i = surface.piece_begin[p]; i < surface.piece_begin[p + 1]; ++i) {
      auto between = within(surface.edge_of[i]);
      if (!surface.is_forward(i)) std::reverse(between.begin(), between.end());
      std::uint32_t from = surface.directed[i][0];
      for (const std::uint32_t s : between) {
        directed.push_back({from, s});
        from = s;
      }
      directed.push_back({from, surface.directed[i][1]});
    }
    begin.push_back(static_cast<std::uint32_t>(directed.size()));
  }
  if (directed.size() == surface.directed.size()) return;
  surface.directed = std::move(directed);
  surface.piece_begin = std::move(begin);
  index_surface(surface);
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
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  std::vector<std::uint32_t> within;
  for (const auto& [along, site] : found) within.push_back(site);
  return within;
}

Surface find_surface(const InputPlc& input, Sites sites, const Tolerances& tolerances) {
  Surface surface;
  surface.sites = std::move(sites);
  surface.tolerances = tolerances;
  add_pieces(input, surface);
  index_surface(surface);
  split_edges(surface);
  return surface;
}

}  // namespace ccdt::verification
