#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "bench/verify/edit_surface.h"
#include "bench/verify/patches.h"
#include "bench/verify/piece_tree.h"

namespace ccdt::verify {

namespace {

/// The greatest thickness of a patch that counts as flat, in multiples of the tolerance. The rest of the tolerance is
/// for the patch's other vertices, which are compared with the plane of its corners.
constexpr double greatest_thickness = 0.25;

/// For each site: does a piece or a segment use it?
std::vector<bool> find_used(const Surface& surface) {
  std::vector<bool> used(surface.sites.position.size(), false);
  for (const Edge& e : surface.directed) used[e[0]] = used[e[1]] = true;
  for (const Edge& e : surface.segments) used[e[0]] = used[e[1]] = true;
  return used;
}

/// Finds the flat parts of a patch that is not flat, such as a flat face that continues as a round one without an edge.
/// A part grows from one of the largest pieces, along the plane of this piece.
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
void remove_segments_on_features(Surface& surface) {
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
        // A run between two ends is found from both of them, so one direction is enough.
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

  /// Finds the sites where the border of a piece comes from one neighbor and does not continue to the other.
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

/// What every edge along a run becomes, in either direction: the first edge becomes the whole run, the others vanish.
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

/// Does an unused vertex lie on a piece or a segment?
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

void let_vertices_slide(Surface& surface, Regions& regions) {
  const std::vector<bool> was_used = find_used(surface);
  merge_flat_patches(surface, regions);
  remove_segments_on_features(surface);
  merge_straight_chains(surface);
  const std::vector<bool> is_used = find_used(surface);
  const PieceTree tree(surface);
  surface.slides.assign(is_used.size(), false);
  for (const std::uint32_t site : surface.sites.of_input)
    if (!is_used[site])
      surface.slides[site] = was_used[site] || (!surface.sites.in_mesh(site) && is_on_something(surface, tree, site));
}

}  // namespace ccdt::verify
