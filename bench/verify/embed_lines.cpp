#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "bench/verify/edit_surface.h"
#include "bench/verify/exact.h"
#include "bench/verify/patches.h"
#include "bench/verify/piece_tree.h"
#include "engine/base/parallel.h"

namespace ccdt::verify {

namespace {

Point3 point_along(const Surface& surface, std::uint32_t edge, double fraction) {
  const auto& [a, b] = surface.edges[edge];
  return surface.at(a) + fraction * (surface.at(b) - surface.at(a));
}

bool has_edge(const Surface& surface, std::uint32_t piece, std::uint32_t edge) {
  return std::ranges::any_of(surface.uses.of(edge), [&](std::uint32_t use) { return surface.piece_of[use] == piece; });
}

/// Is the edge exactly in the plane of the triangle?
bool is_in_plane(const Surface& surface, std::uint32_t triangle, std::uint32_t edge) {
  const auto sides = surface.edges_of(triangle);
  return std::ranges::all_of(surface.edges[edge], [&](std::uint32_t end) {
    return orientation(surface.at(sides[0][0]), surface.at(sides[1][0]), surface.at(sides[2][0]), surface.at(end)) == 0;
  });
}

/// Is the edge parallel to the plane of the piece, up to the error of the slope of a piece of this size?
bool runs_along(const Surface& surface, std::uint32_t piece, std::uint32_t edge) {
  if (surface.tolerances.exact_contacts && surface.is_triangle(piece)) return is_in_plane(surface, piece, edge);
  const Point3& area = surface.area_vector[piece];
  const Point3 along = surface.at(surface.edges[edge][1]) - surface.at(surface.edges[edge][0]);
  const double squared_size = length(area);
  const double slack = 1 + std::sqrt(squared_length(along) / squared_size);
  return std::fabs(dot(area, along)) <= 2 * surface.tolerances.touch * slack * squared_size;
}

/// The edges that run along a piece without being one of its sides: the midpoint lies on the piece.
std::vector<std::uint32_t> find_touching(const Surface& surface, const PieceTree& tree) {
  const auto touches_a_piece = [&](std::uint32_t e) {
    const Point3 middle = point_along(surface, e, 0.5);
    bool touches = false;
    tree.for_each_near(middle, middle, [&](std::uint32_t p) {
      touches = touches || (!has_edge(surface, p, e) && runs_along(surface, p, e) &&
                            locate_on_piece(surface, p, middle) != PointOnPiece::off);
    });
    return touches;
  };
  return joined(parallel_chunks(surface.edges.size(), short_chunk_length, [&](std::size_t begin, std::size_t end) {
    std::vector<std::uint32_t> touching;
    for (auto e = static_cast<std::uint32_t>(begin); e < end; ++e)
      if (touches_a_piece(e)) touching.push_back(e);
    return touching;
  }));
}

std::vector<std::uint32_t> sites_of(const Surface& surface, std::uint32_t piece) {
  std::vector<std::uint32_t> sites;
  for (const auto& [site, next] : surface.edges_of(piece)) sites.push_back(site);
  return sites;
}

/// The vertices of the input that are not a corner of any piece. Those that the mesh lacks are left out.
std::vector<std::uint32_t> single_vertices(const Surface& surface) {
  std::vector<bool> is_corner(surface.sites.position.size(), false);
  for (const Edge& e : surface.directed) is_corner[e[0]] = true;
  std::vector<std::uint32_t> single;
  for (const std::uint32_t site : surface.sites.of_input)
    if (!is_corner[site] && surface.sites.in_mesh(site)) single.push_back(site);
  return single;
}

/// Splits the lines at all sites that lie on them. Splits all edges at the ends of lines and at single vertices, where
/// lines may cross. An edge is never split at a vertex of its own triangles; such triangles have no height.
void split_at_touches(const PieceTree& tree, const std::vector<std::uint32_t>& lines, Surface& surface) {
  std::vector<std::uint32_t> sites = single_vertices(surface);
  std::map<std::uint32_t, std::vector<std::uint32_t>> candidates;  // of each edge
  for (const std::uint32_t e : lines) {
    const auto& [a, b] = surface.edges[e];
    sites.insert(sites.end(), {a, b});
    tree.for_each_near(surface.at(a), surface.at(b), [&](std::uint32_t p) {
      const auto of_piece = sites_of(surface, p);
      candidates[e].insert(candidates[e].end(), of_piece.begin(), of_piece.end());
    });
  }
  sort_and_unique(sites);
  for (const std::uint32_t s : sites)
    tree.for_each_near(surface.at(s), surface.at(s), [&](std::uint32_t p) {
      for (const std::uint32_t use : surface.uses_of(p)) candidates[surface.edge_of[use]].push_back(s);
    });
  for (auto& [e, list] : candidates) {
    list = select_within(surface, surface.edges[e], list);
    for (const std::uint32_t use : surface.uses.of(e)) {
      if (list.empty()) break;
      if (!surface.is_triangle(surface.piece_of[use])) continue;
      const auto own = sites_of(surface, surface.piece_of[use]);
      std::erase_if(list, [&](std::uint32_t s) { return std::find(own.begin(), own.end(), s) != own.end(); });
    }
  }
  split_directed(
      [&](std::uint32_t e) {
        const auto found = candidates.find(e);
        return found == candidates.end() ? std::vector<std::uint32_t>{} : found->second;
      },
      surface);
}

/// Flat patches, and for each the lines of other patches within it.
struct Drawings {
  std::vector<bool> joined;  ///< for each edge: is it within a patch?
  Patches patches;
  std::map<std::uint32_t, std::vector<std::uint32_t>> lines;  ///< of a patch
};

/// The patches that contain a line with both ends.
std::vector<std::uint32_t> patches_around(const Surface& surface, const PieceTree& tree, const Patches& patches,
                                          std::uint32_t line) {
  const double flat = surface.tolerances.flat;
  std::vector<std::uint32_t> found;
  for (const double fraction : {0.5, 0.382, 0.707}) {  // if one point is on an edge within the patch, another is not
    const Point3 point = point_along(surface, line, fraction);
    tree.for_each_near(point, point, [&](std::uint32_t p) {
      const std::uint32_t patch = patches.of_piece[p];
      const auto in_plane = [&](std::uint32_t site) {
        return std::fabs(patches.height(patch, surface.at(site))) <= flat;
      };
      if (patches.thickness[patch] > flat || !in_plane(surface.edges[line][0]) || !in_plane(surface.edges[line][1]))
        return;
      if (std::ranges::any_of(patches.pieces.of(patch), [&](std::uint32_t q) { return has_edge(surface, q, line); }))
        return;
      if (locate_on_piece(surface, p, point) == PointOnPiece::within) found.push_back(patch);
    });
  }
  sort_and_unique(found);
  return found;
}

Drawings find_drawings(const Surface& surface, const PieceTree& tree) {
  const std::vector<std::uint32_t> touching = find_touching(surface, tree);
  Drawings drawings;
  drawings.joined = find_features(surface);
  drawings.joined.flip();
  for (const std::uint32_t e : touching) drawings.joined[e] = false;
  drawings.patches = group_pieces(surface, drawings.joined);
  for (const std::uint32_t e : touching)
    for (const std::uint32_t patch : patches_around(surface, tree, drawings.patches, e))
      drawings.lines[patch].push_back(e);
  return drawings;
}

/// The cells into which lines divide a patch: loops that follow the outline in its direction or consist only of lines.
std::vector<PolygonCell> divide_patch(const Surface& surface, const Drawings& drawings, std::uint32_t patch,
                                      const std::vector<std::uint32_t>& lines) {
  std::set<Edge> outline, undirected;
  for (const std::uint32_t p : drawings.patches.pieces.of(patch))
    for (const std::uint32_t use : surface.uses_of(p)) {
      if (drawings.joined[surface.edge_of[use]]) continue;
      const auto& [a, b] = surface.directed[use];
      outline.insert(drawings.patches.flipped[p] ? Edge{b, a} : Edge{a, b});
      undirected.insert(surface.edges[surface.edge_of[use]]);
    }
  for (const std::uint32_t e : lines) undirected.insert(surface.edges[e]);
  const auto drawn = trace_drawing(drawings.patches.normal[patch], undirected, surface.sites.position);
  std::vector<PolygonCell> cells;
  for (std::size_t i = 0; i < drawn.loops.size(); ++i) {
    const PolygonCell& loop = drawn.loops[i];
    const auto is_wrong_way = [&](const Edge& e) { return outline.count(e) == 0 && outline.count({e[1], e[0]}) > 0; };
    if (drawn.areas[i] > 0 && std::none_of(loop.begin(), loop.end(), is_wrong_way)) cells.push_back(drawn.cells[i]);
  }
  return cells;
}

void divide_patches(const Drawings& drawings, Surface& surface) {
  Pieces divided;
  for (std::uint32_t p = 0; p < surface.pieces(); ++p)
    if (drawings.lines.count(drawings.patches.of_piece[p]) == 0)
      divided.add(surface.edges_of(p), surface.marker[p], surface.number[p]);
  for (const auto& [patch, lines] : drawings.lines) {
    const std::uint32_t first = drawings.patches.pieces.of(patch)[0];
    for (const PolygonCell& cell : divide_patch(surface, drawings, patch, lines))
      divided.add(cell, surface.marker[first], surface.number[first]);
  }
  set_pieces(std::move(divided), surface);
}

}  // namespace

void embed_lines(Surface& surface) {
  const PieceTree given(surface);
  std::vector<std::uint32_t> lines = find_touching(surface, given);
  for (std::uint32_t e = 0; e < surface.edges.size(); ++e)
    if (surface.use_count(e) != 2) lines.push_back(e);
  if (lines.empty()) return;
  split_at_touches(given, lines, surface);
  const Drawings drawings = find_drawings(surface, PieceTree(surface));  // a split may divide a piece
  if (!drawings.lines.empty()) divide_patches(drawings, surface);
}

}  // namespace ccdt::verify
