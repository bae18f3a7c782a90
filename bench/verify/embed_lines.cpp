#include "bench/verify/embed_lines.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "bench/verify/covers.h"
#include "bench/verify/piece_tree.h"
#include "bench/verify/polygon_cells.h"

namespace ccdt::verification {

namespace {

using Edge = std::array<std::uint32_t, 2>;

Point3 point_along(const Surface& surface, std::uint32_t edge, double fraction) {
  const auto& [a, b] = surface.edges[edge];
  return surface.at(a) + fraction * (surface.at(b) - surface.at(a));
}

bool has_edge(const Surface& surface, std::uint32_t piece, std::uint32_t edge) {
  return std::any_of(&surface.uses[surface.use_begin[edge]],
                     &surface.uses[surface.use_begin[edge]] + surface.use_count(edge),
                     [&](std::uint32_t use) { return surface.piece_of[use] == piece; });
}

/// Does an edge run along the piece's plane, as far as a piece of that size tells its slope?
bool runs_along(const Surface& surface, std::uint32_t piece, std::uint32_t edge) {
  const Point3& area = surface.area_vector[piece];
  const Point3 along = surface.at(surface.edges[edge][1]) - surface.at(surface.edges[edge][0]);
  const double squared_size = std::sqrt(squared_length(area));
  const double slack = 1 + std::sqrt(squared_length(along) / squared_size);
  return std::fabs(dot(area, along)) <= 2 * surface.tolerances.flat * slack * squared_size;
}

/// The edges with the middle on a piece that is not theirs, along its plane.
std::vector<std::uint32_t> find_touching(const Surface& surface, const PieceTree& tree) {
  std::vector<std::uint32_t> touching;
  for (std::uint32_t e = 0; e < surface.edges.size(); ++e) {
    const Point3 middle = point_along(surface, e, 0.5);
    bool touches = false;
    tree.for_each_near(middle, middle, [&](std::uint32_t p) {
      touches = touches ||
                (!has_edge(surface, p, e) && runs_along(surface, p, e) && place_of(surface, p, middle) != Place::off);
    });
    if (touches) touching.push_back(e);
  }
  return touching;
}

std::vector<std::uint32_t> sites_of(const Surface& surface, std::uint32_t piece) {
  std::vector<std::uint32_t> sites;
  for (std::uint32_t i = surface.piece_begin[piece]; i < surface.piece_begin[piece + 1]; ++i)
    sites.push_back(surface.directed[i][0]);
  return sites;
}

/// Splits the lines at all sites that lie on them, and all edges at the ends of the lines. An edge is left whole at a
/// vertex of its own pieces, as in a triangle of no height.
void split_at_touches(const PieceTree& tree, const std::vector<std::uint32_t>& lines, Surface& surface) {
  std::vector<std::uint32_t> sites;
  std::map<std::uint32_t, std::vector<std::uint32_t>> candidates;  // of each edge
  for (const std::uint32_t e : lines) {
    const auto& [a, b] = surface.edges[e];
    sites.insert(sites.end(), {a, b});
    tree.for_each_near(surface.at(a), surface.at(b), [&](std::uint32_t p) {
      const auto of_piece = sites_of(surface, p);
      candidates[e].insert(candidates[e].end(), of_piece.begin(), of_piece.end());
    });
  }
  std::sort(sites.begin(), sites.end());
  sites.erase(std::unique(sites.begin(), sites.end()), sites.end());
  for (const std::uint32_t s : sites)
    tree.for_each_near(surface.at(s), surface.at(s), [&](std::uint32_t p) {
      for (std::uint32_t i = surface.piece_begin[p]; i < surface.piece_begin[p + 1]; ++i)
        candidates[surface.edge_of[i]].push_back(s);
    });
  for (auto& [e, list] : candidates) {
    list = select_within(surface, surface.edges[e], list);
    for (std::uint32_t i = surface.use_begin[e]; i < surface.use_begin[e + 1] && !list.empty(); ++i) {
      const auto own = sites_of(surface, surface.piece_of[surface.uses[i]]);
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

/// Patches in one plane, and the lines of others within each.
struct Drawings {
  std::vector<bool> joined;  ///< of each edge: it is within a patch
  Patches patches;
  std::map<std::uint32_t, std::vector<std::uint32_t>> lines;  ///< of a patch
};

/// The patches that a line lies in, which it must with both ends.
std::vector<std::uint32_t> patches_around(const Surface& surface, const PieceTree& tree, const Patches& patches,
                                          std::uint32_t line) {
  const double flat = surface.tolerances.flat;
  std::vector<std::uint32_t> found;
  for (const double fraction : {0.5, 0.382, 0.707}) {  // where one is on an edge within the patch, another is not
    const Point3 point = point_along(surface, line, fraction);
    tree.for_each_near(point, point, [&](std::uint32_t p) {
      const std::uint32_t patch = patches.of_piece[p];
      const auto in_plane = [&](std::uint32_t site) {
        return std::fabs(dot(patches.normal[patch], surface.at(site) - patches.centre[patch])) <= flat;
      };
      if (patches.thickness[patch] > flat || !in_plane(surface.edges[line][0]) || !in_plane(surface.edges[line][1]))
        return;
      const auto own = patches.pieces_of(patch);
      if (std::any_of(own.begin(), own.end(), [&](std::uint32_t q) { return has_edge(surface, q, line); })) return;
      if (place_of(surface, p, point) == Place::within) found.push_back(patch);
    });
  }
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

Drawings find_drawings(const Surface& surface, const PieceTree& tree) {
  const std::vector<std::uint32_t> touching = find_touching(surface, tree);
  Drawings drawings;
  drawings.joined = find_features(surface);
  drawings.joined.flip();
  for (const std::uint32_t e : touching) drawings.joined[e] = false;
  Chains none_yet;
  none_yet.begin.assign(surface.edges.size() + 1, 0);
  drawings.patches = group_pieces(surface, none_yet, drawings.joined);
  for (const std::uint32_t e : touching)
    for (const std::uint32_t patch : patches_around(surface, tree, drawings.patches, e))
      drawings.lines[patch].push_back(e);
  return drawings;
}

/// The cells into which lines divide a patch: loops that have an edge of its outline to run along, or lines alone.
std::vector<Cell> divide_patch(const Surface& surface, const Drawings& drawings, std::uint32_t patch,
                               const std::vector<std::uint32_t>& lines) {
  std::set<Edge> outline, undirected;
  for (const std::uint32_t p : drawings.patches.pieces_of(patch))
    for (std::uint32_t i = surface.piece_begin[p]; i < surface.piece_begin[p + 1]; ++i) {
      if (drawings.joined[surface.edge_of[i]]) continue;
      const auto& [a, b] = surface.directed[i];
      outline.insert(drawings.patches.flipped[p] ? Edge{b, a} : Edge{a, b});
      undirected.insert(surface.edges[surface.edge_of[i]]);
    }
  for (const std::uint32_t e : lines) undirected.insert(surface.edges[e]);
  const auto drawn = trace_drawing(drawings.patches.normal[patch], undirected, surface.sites.position);
  std::vector<Cell> cells;
  for (std::size_t i = 0; i < drawn.loops.size(); ++i) {
    const Cell& loop = drawn.loops[i];
    const auto is_wrong_way = [&](const Edge& e) { return outline.count(e) == 0 && outline.count({e[1], e[0]}) > 0; };
    if (drawn.areas[i] > 0 && std::none_of(loop.begin(), loop.end(), is_wrong_way)) cells.push_back(drawn.cells[i]);
  }
  return cells;
}

void replace_pieces(const Drawings& drawings, Surface& surface) {
  Surface drawn;
  drawn.piece_begin.push_back(0);
  const auto add = [&](std::span<const Edge> edges, std::uint32_t like) {
    drawn.directed.insert(drawn.directed.end(), edges.begin(), edges.end());
    drawn.piece_begin.push_back(static_cast<std::uint32_t>(drawn.directed.size()));
    drawn.marker.push_back(surface.marker[like]);
    drawn.number.push_back(surface.number[like]);
  };
  for (std::uint32_t p = 0; p < surface.pieces(); ++p)
    if (drawings.lines.count(drawings.patches.of_piece[p]) == 0)
      add(std::span(surface.directed)
              .subspan(surface.piece_begin[p], surface.piece_begin[p + 1] - surface.piece_begin[p]),
          p);
  for (const auto& [patch, lines] : drawings.lines)
    for (const Cell& cell : divide_patch(surface, drawings, patch, lines))
      add(cell, drawings.patches.pieces_of(patch)[0]);
  surface.piece_begin = std::move(drawn.piece_begin);
  surface.directed = std::move(drawn.directed);
  surface.marker = std::move(drawn.marker);
  surface.number = std::move(drawn.number);
  surface.piece_of.clear();
  index_surface(surface);
}

}  // namespace

void embed_lines(Surface& surface) {
  const PieceTree tree(surface);
  std::vector<std::uint32_t> lines = find_touching(surface, tree);
  for (std::uint32_t e = 0; e < surface.edges.size(); ++e)
    if (surface.use_count(e) != 2) lines.push_back(e);
  if (lines.empty()) return;
  split_at_touches(tree, lines, surface);
  const Drawings drawings = find_drawings(surface, tree);
  if (!drawings.lines.empty()) replace_pieces(drawings, surface);
}

}  // namespace ccdt::verification
