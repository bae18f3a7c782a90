#include "bench/verify/edit_surface.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "bench/verify/patches.h"
#include "engine/base/parallel.h"

namespace ccdt::verify {

namespace {

/// The pieces by their bounding boxes.
class PieceTree {
 public:
  explicit PieceTree(const Surface& surface)
      : tolerance_(surface.tolerances.flat), tree_(surface.boxes_of_pieces(), surface.tolerances) {}

  /// Calls visit(piece) for all pieces whose box the box of a and b touches within the tolerance.
  template <class Visit>
  void for_each_near(const Point3& a, const Point3& b, const Visit& visit) const {
    tree_.for_each_meeting(expanded(hull(box_of(a), box_of(b)), tolerance_), visit);
  }

 private:
  double tolerance_;
  ScaledBoxTree tree_;
};

double squared_distance(const Point3& p, const Point3& a, const Point3& b) {
  const double along = std::clamp(dot(p - a, b - a) / squared_length(b - a), 0.0, 1.0);
  return squared_length(p - a - along * (b - a));
}

/// The position of a point relative to a piece: in its plane and near its border, or within it.
enum class PointOnPiece { off, border, within };

PointOnPiece locate_on_piece(const Surface& surface, std::uint32_t piece, const Point3& p) {
  const Point3& area = surface.area_vector[piece];
  const double size = length(area), tolerance = surface.tolerances.place;
  const double height = dot(area, p - surface.origin(piece)) / size;
  if (std::fabs(height) > surface.tolerances.touch) return PointOnPiece::off;
  for (const auto& [a, b] : surface.edges_of(piece))
    if (squared_distance(p, surface.at(a), surface.at(b)) <= tolerance * tolerance) return PointOnPiece::border;
  // Its foot, as the drawing is seen along an axis, not along the normal.
  const Point3 foot = p - (height / size) * area;
  return encloses(area, surface.edges_of(piece), surface.sites.position, foot) ? PointOnPiece::within
                                                                               : PointOnPiece::off;
}

// Lines within facets.

Point3 point_along(const Surface& surface, std::uint32_t edge, double fraction) {
  const auto& [a, b] = surface.edges[edge];
  return surface.at(a) + fraction * (surface.at(b) - surface.at(a));
}

bool has_edge(const Surface& surface, std::uint32_t piece, std::uint32_t edge) {
  return std::ranges::any_of(surface.uses.of(edge), [&](std::uint32_t use) { return surface.piece_of[use] == piece; });
}

/// Does an edge run along the plane of the piece, as far as a piece of that size determines its slope?
bool runs_along(const Surface& surface, std::uint32_t piece, std::uint32_t edge) {
  const Point3& area = surface.area_vector[piece];
  const Point3 along = surface.at(surface.edges[edge][1]) - surface.at(surface.edges[edge][0]);
  const double squared_size = length(area);
  const double slack = 1 + std::sqrt(squared_length(along) / squared_size);
  return std::fabs(dot(area, along)) <= 2 * surface.tolerances.touch * slack * squared_size;
}

/// The edges whose midpoint lies on a foreign piece, along its plane.
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

/// Splits the lines at all sites that lie on them, and all edges at the ends of the lines. An edge is not split at a
/// vertex of its own triangles, which then have no height.
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

/// Patches in one plane, and the lines of others within each.
struct Drawings {
  std::vector<bool> joined;  ///< of each edge: it is within a patch
  Patches patches;
  std::map<std::uint32_t, std::vector<std::uint32_t>> lines;  ///< of a patch
};

/// The patches that contain a line with both ends.
std::vector<std::uint32_t> patches_around(const Surface& surface, const PieceTree& tree, const Patches& patches,
                                          std::uint32_t line) {
  const double flat = surface.tolerances.flat;
  std::vector<std::uint32_t> found;
  for (const double fraction : {0.5, 0.382, 0.707}) {  // where one is on an edge within the patch, another is not
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

/// The cells into which lines divide a patch: loops that have an edge of its outline to run along, or lines alone.
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

// Vertices that may slide.

/// The flatness of a patch that counts as flat, times the tolerance. The rest of the tolerance is for its other
/// vertices, which are compared with the plane of its corners.
constexpr double greatest_thickness = 0.25;

/// Sites of pieces and segments.
std::vector<bool> find_used(const Surface& surface) {
  std::vector<bool> used(surface.sites.position.size(), false);
  for (const Edge& e : surface.directed) used[e[0]] = used[e[1]] = true;
  for (const Edge& e : surface.segments) used[e[0]] = used[e[1]] = true;
  return used;
}

/// Finds the flat parts of a patch that is not flat, such as a flat face that continues as a round one without an edge:
/// sets of pieces grown from the largest ones along their plane.
class FlatParts {
 public:
  FlatParts(const Surface& surface, const std::vector<bool>& joined)
      : surface_(surface), joined_(joined), part_(surface.pieces(), none) {}

  void divide(std::span<const std::uint32_t> pieces) {
    std::vector<std::uint32_t> order(pieces.begin(), pieces.end());
    const auto area = [&](std::uint32_t p) { return squared_length(surface_.area_vector[p]); };
    std::stable_sort(order.begin(), order.end(), [&](std::uint32_t p, std::uint32_t q) { return area(p) > area(q); });
    for (const std::uint32_t seed : order)
      if (part_[seed] == none) grow(seed);
  }

  /// Are the pieces at an edge in different parts?
  bool parts(std::uint32_t edge) const {
    const auto use = surface_.uses.of(edge);
    return part_[surface_.piece_of[use[0]]] != part_[surface_.piece_of[use[1]]];
  }

 private:
  /// The distance of the sites of a facet from its plane if it is flat up to rounding.
  double tolerance() const { return 2 * surface_.tolerances.place; }

  void grow(std::uint32_t seed) {
    Point3 area = surface_.area_vector[seed];
    std::vector<std::uint32_t> members = {seed};
    part_[seed] = seed;
    for (std::size_t n = 0; n < members.size(); ++n) {
      for (const std::uint32_t use : surface_.uses_of(members[n])) {
        const std::uint32_t next = across(use);
        if (next == none || part_[next] != none || !is_within(next, surface_.origin(seed), area)) continue;
        part_[next] = seed;
        members.push_back(next);
        const Point3& more = surface_.area_vector[next];
        area = dot(area, more) < 0 ? area - more : area + more;
      }
    }
  }

  std::uint32_t across(std::uint32_t use) const {
    const std::uint32_t e = surface_.edge_of[use];
    if (!joined_[e]) return none;
    const auto uses = surface_.uses.of(e);
    return surface_.piece_of[uses[0] == use ? uses[1] : uses[0]];
  }

  bool is_within(std::uint32_t piece, const Point3& origin, const Point3& area) const {
    const double bound = tolerance() * length(area);
    return std::ranges::none_of(surface_.edges_of(piece), [&](const Edge& e) {
      return std::fabs(dot(area, surface_.at(e[0]) - origin)) > bound;
    });
  }

  const Surface& surface_;
  const std::vector<bool>& joined_;
  std::vector<std::uint32_t> part_;  // of each piece: its seed
};

bool is_thin(const Surface& surface, const Patches& patches, std::uint32_t patch) {
  return patches.thickness[patch] <= greatest_thickness * surface.tolerances.flat;
}

/// The edges within flat patches.
std::vector<bool> find_edges_to_merge(const Surface& surface) {
  std::vector<bool> joined = find_features(surface);
  joined.flip();
  const Patches patches = group_pieces(surface, joined);
  FlatParts flat_parts(surface, joined);
  for (std::uint32_t n = 0; n < patches.count(); ++n)
    if (!is_thin(surface, patches, n)) flat_parts.divide(patches.pieces.of(n));
  std::vector<bool> merged = joined;
  for (std::uint32_t e = 0; e < surface.edges.size(); ++e) merged[e] = joined[e] && !flat_parts.parts(e);
  return merged;
}

void merge_flat_patches(Surface& surface, Regions& regions) {
  const std::vector<bool> joined = find_edges_to_merge(surface);
  const Patches patches = group_pieces(surface, joined);
  Pieces merged;
  std::vector<std::uint32_t> of_side;
  const auto add = [&](std::span<const Edge> edges, std::uint32_t like) {
    merged.add(edges, surface.marker[like], surface.number[like]);
    of_side.insert(of_side.end(), {regions.of_side[2 * like], regions.of_side[2 * like + 1]});
  };
  for (std::uint32_t n = 0; n < patches.count(); ++n) {
    const auto pieces = patches.pieces.of(n);
    std::vector<Edge> outline;
    for (const std::uint32_t p : pieces)
      for (const std::uint32_t use : surface.uses_of(p)) {
        const auto& [a, b] = surface.directed[use];
        if (!joined[surface.edge_of[use]])
          outline.push_back(patches.flipped[p] == patches.flipped[pieces[0]] ? Edge{a, b} : Edge{b, a});
      }
    if (is_thin(surface, patches, n) && !outline.empty())
      add(outline, pieces[0]);
    else
      for (const std::uint32_t p : pieces) add(surface.edges_of(p), p);
  }
  set_pieces(std::move(merged), surface);
  regions.of_side = std::move(of_side);
}

/// Removes the segments that are features of the facets: these are required anyway.
void drop_segments_on_features(Surface& surface) {
  const std::vector<bool> features = find_features(surface);
  std::set<Edge> kept;
  for (const Edge& segment : surface.segments) kept.insert(ascending(segment));
  for (std::size_t e = 0; e < surface.edges.size(); ++e)
    if (features[e]) kept.erase(surface.edges[e]);
  surface.segments.assign(kept.begin(), kept.end());
}

/// A chain of sites that becomes one edge.
using Run = std::vector<std::uint32_t>;

class StraightRuns {
 public:
  explicit StraightRuns(const Surface& surface) : surface_(surface) {
    for (const Edge& e : surface.edges) join(e);
    for (const Edge& e : surface.segments) join(e);
    find_turning_back();
  }

  std::vector<Run> find() {
    std::vector<Run> runs;
    for (const auto& [site, around] : neighbors_) {
      if (is_passed(site)) continue;
      for (const std::uint32_t next : around) {
        Run run = follow(site, next);
        // It is found from both ends, if at all.
        if (run.size() > 2 && run.front() < run.back() && is_straight(run)) runs.push_back(std::move(run));
      }
    }
    return runs;
  }

 private:
  void join(const Edge& e) {
    neighbors_[e[0]].insert(e[1]);
    neighbors_[e[1]].insert(e[0]);
  }

  /// Which of the two neighbors of a site?
  std::size_t side(std::uint32_t site, std::uint32_t neighbor) const {
    return *neighbors_.at(site).begin() == neighbor ? 0 : 1;
  }
  bool has_two(std::uint32_t site) const { return neighbors_.at(site).size() == 2; }

  /// Sites at which a piece that comes from one neighbor does not continue to the other.
  void find_turning_back() {
    std::map<std::array<std::uint32_t, 2>, std::array<int, 2>> balance;  // of a site and a piece
    for (std::uint32_t i = 0; i < surface_.directed.size(); ++i) {
      const auto& [a, b] = surface_.directed[i];
      if (has_two(b)) ++balance[{b, surface_.piece_of[i]}][side(b, a)];
      if (has_two(a)) --balance[{a, surface_.piece_of[i]}][1 - side(a, b)];
    }
    for (const auto& [where, sum] : balance)
      if (sum != std::array{0, 0}) turning_back_.insert(where[0]);
  }

  bool is_passed(std::uint32_t site) const {
    if (!has_two(site) || turning_back_.count(site) > 0) return false;
    const auto& around = neighbors_.at(site);
    return is_between(*around.begin(), site, *around.rbegin());
  }

  bool is_between(std::uint32_t a, std::uint32_t site, std::uint32_t b) const {
    const Point3 axis = surface_.at(b) - surface_.at(a), p = surface_.at(site) - surface_.at(a);
    const double part = dot(p, axis) / squared_length(axis);
    const double tolerance = surface_.tolerances.place;
    return part > 0 && part < 1 && squared_length(p - part * axis) <= tolerance * tolerance;
  }

  Run follow(std::uint32_t from, std::uint32_t next) const {
    Run run = {from, next};
    while (is_passed(run.back())) {
      const auto& around = neighbors_.at(run.back());
      run.push_back(*around.begin() == run[run.size() - 2] ? *around.rbegin() : *around.begin());
    }
    return run;
  }

  bool is_straight(const Run& run) const {
    return std::all_of(run.begin() + 1, run.end() - 1,
                       [&](std::uint32_t site) { return is_between(run.front(), site, run.back()); });
  }

  const Surface& surface_;
  std::map<std::uint32_t, std::set<std::uint32_t>> neighbors_;
  std::set<std::uint32_t> turning_back_;
};

/// For every edge along a run, in either direction, what it becomes: the first edge the whole run, the others nothing.
std::map<Edge, Edge> find_replacements(const std::vector<Run>& runs) {
  constexpr Edge nothing = {none, none};
  std::map<Edge, Edge> become;
  for (const Run& run : runs) {
    for (std::size_t i = 0; i + 1 < run.size(); ++i)
      become[{run[i], run[i + 1]}] = become[{run[i + 1], run[i]}] = nothing;
    become[{run[0], run[1]}] = {run.front(), run.back()};
    become[{run.back(), run[run.size() - 2]}] = {run.back(), run.front()};
  }
  return become;
}

void merge_straight_chains(Surface& surface) {
  const std::map<Edge, Edge> become = find_replacements(StraightRuns(surface).find());
  if (become.empty()) return;
  const auto add = [&](const Edge& e, std::vector<Edge>& edges) {
    const auto found = become.find(e);
    const Edge& replacement = found == become.end() ? e : found->second;
    if (replacement[0] != none) edges.push_back(replacement);
  };
  Pieces merged;
  std::vector<Edge> edges;
  for (std::uint32_t p = 0; p < surface.pieces(); ++p) {
    edges.clear();
    for (const Edge& e : surface.edges_of(p)) add(e, edges);
    merged.add(edges, surface.marker[p], surface.number[p]);
  }
  std::vector<Edge> segments;
  for (const auto& [a, b] : surface.segments)
    for (const Edge& e : {Edge{a, b}, Edge{b, a}})
      if (e == Edge{a, b} || become.count(e) > 0) add(e, segments);
  for (Edge& e : segments) e = ascending(e);
  sort_and_unique(segments);
  surface.segments = std::move(segments);
  set_pieces(std::move(merged), surface);
}

/// Is an unused vertex on a piece or a segment nevertheless?
bool is_on_something(const Surface& surface, const PieceTree& tree, std::uint32_t site) {
  const Point3& p = surface.at(site);
  bool found = std::ranges::any_of(surface.segments, [&](const Edge& segment) {
    return !select_within(surface, segment, {&site, 1}).empty();
  });
  tree.for_each_near(
      p, p, [&](std::uint32_t piece) { found = found || locate_on_piece(surface, piece, p) != PointOnPiece::off; });
  return found;
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
  if (!drawings.lines.empty()) divide_patches(drawings, surface);
}

void let_vertices_slide(Surface& surface, Regions& regions) {
  const std::vector<bool> was_used = find_used(surface);
  merge_flat_patches(surface, regions);
  drop_segments_on_features(surface);
  merge_straight_chains(surface);
  const std::vector<bool> is_used = find_used(surface);
  const PieceTree tree(surface);
  surface.slides.assign(is_used.size(), false);
  for (const std::uint32_t site : surface.sites.of_input)
    if (!is_used[site])
      surface.slides[site] = was_used[site] || (!surface.sites.in_mesh(site) && is_on_something(surface, tree, site));
}

}  // namespace ccdt::verify
