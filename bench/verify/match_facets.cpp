#include "bench/verify/match_facets.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "bench/verify/spread_sheet.h"
#include "engine/base/simplex_map.h"
#include "engine/base/sort_in_runs.h"
#include "engine/base/union_find.h"

namespace ccdt::verify {

namespace {

/// The entries of an edge in a sorted list.
std::span<const AtEdge> entries_at(const std::vector<AtEdge>& sorted, const Edge& e) {
  const auto found = std::ranges::equal_range(sorted, edge_key(e[0], e[1]), {}, &AtEdge::edge);
  return {found.begin(), found.end()};
}

std::array<Edge, 3> edges_of(const Face& v) {
  return {{{v[0], v[1]}, {v[1], v[2]}, {v[2], v[0]}}};
}

/// The boundary of the mesh: faces with one tetrahedron, counterclockwise seen from outside.
struct Boundary {
  std::vector<std::uint32_t> faces;
  std::vector<Face> corners;
  std::vector<AtEdge> at_edges;  ///< each edge with the faces at it, sorted
};

Boundary find_boundary(const Topology& topology) {
  Boundary boundary;
  for (const std::uint32_t f : topology.boundary_faces) {
    const auto n = static_cast<std::uint32_t>(boundary.faces.size());
    boundary.faces.push_back(f);
    boundary.corners.push_back(outward(topology.mesh, topology.half_faces[f][0]));
    for (const Edge& e : edges_of(boundary.corners.back())) boundary.at_edges.push_back({edge_key(e[0], e[1]), n});
  }
  sort_in_runs(boundary.at_edges);
  return boundary;
}

/// The edges between two pieces that are missing in the boundary.
std::vector<bool> find_joined(const Surface& surface, const Chains& chains, const Boundary& boundary) {
  std::vector<bool> joined(surface.edges.size(), false);
  for (std::uint32_t e = 0; e < surface.edges.size(); ++e) {
    if (surface.use_count(e) != 2) continue;
    const auto chain = chains.of(e);
    joined[e] = chain.empty();
    for (std::size_t k = 1; k < chain.size() && !joined[e]; ++k)
      joined[e] = entries_at(boundary.at_edges, {chain[k - 1], chain[k]}).empty();
  }
  return joined;
}

/// A part of the boundary: its faces, and the walls around it with the part to their left, sorted.
struct BoundaryPart {
  std::vector<Face> faces;
  std::vector<Edge> links;

  /// The same seen from the other side.
  void turn() {
    for (Face& f : faces) std::swap(f[1], f[2]);
    for (Edge& e : links) std::swap(e[0], e[1]);
    std::sort(links.begin(), links.end());
  }
};

class BoundaryMatcher {
 public:
  BoundaryMatcher(const Topology& topology, const Surface& surface, const Chains& chains, FacetMatches& matches)
      : topology_(topology), surface_(surface), matches_(matches), boundary_(find_boundary(topology)) {
    const std::vector<bool> joined = find_joined(surface, chains, boundary_);
    patches_ = group_pieces(surface, chains, joined);
    for (std::uint32_t e = 0; e < surface.edges.size(); ++e) {
      const auto chain = chains.of(e);
      for (std::size_t k = 1; k < chain.size() && !joined[e]; ++k)
        walls_.push_back({edge_key(chain[k - 1], chain[k]), e});
    }
    sort_in_runs(walls_);
  }

  void match() {
    const IndexLists parts = divide_boundary();
    std::vector<Match> first(boundary_.faces.size());  // of the part with the name n
    parallel_for(first.size(), short_chunk_length, [&](std::size_t n) { first[n] = find_first(parts.of(n)); });
    for (std::size_t n = 0; n < boundary_.faces.size(); ++n) {
      const auto members = parts.of(n);
      if (members.empty() || record_if_free(members, first[n]) || match_part(members)) continue;
      for (const std::uint32_t m : members) matches_.stray_faces.push_back(boundary_.faces[m]);
    }
  }

 private:
  /// A patch that a part of the boundary looks like; `turned`: as seen from inside the mesh.
  struct Match {
    std::uint32_t patch = none;
    bool turned = false;
  };

  /// Sets of boundary faces that are not divided by walls.
  IndexLists divide_boundary() {
    UnionFind sets(boundary_.faces.size());
    for_each_edge_group(boundary_.at_edges, [&](std::span<const AtEdge> group) {
      const bool is_wall = std::ranges::binary_search(walls_, group[0].edge, {}, &AtEdge::edge);
      if (group.size() == 2 && !is_wall) sets.join(group[0].value, group[1].value);
    });
    return make_index_lists(boundary_.faces.size(), [&](const auto& add) {
      for (std::uint32_t n = 0; n < boundary_.faces.size(); ++n) add(sets.find(n), n);
    });
  }

  BoundaryPart make_part(std::span<const std::uint32_t> members) const {
    BoundaryPart part;
    for (const std::uint32_t n : members) {
      part.faces.push_back(boundary_.corners[n]);
      for (const Edge& e : edges_of(boundary_.corners[n]))
        if (entries_at(boundary_.at_edges, e).size() != 2 || !entries_at(walls_, e).empty()) part.links.push_back(e);
    }
    std::sort(part.links.begin(), part.links.end());
    return part;
  }

  /// Patches that have the first link of a part.
  std::vector<std::uint32_t> find_candidates(const BoundaryPart& part) const {
    std::vector<std::uint32_t> result;
    if (part.links.empty()) return result;
    for (const auto& [wall, edge] : entries_at(walls_, part.links[0]))
      for (const std::uint32_t use : surface_.uses.of(edge))
        result.push_back(patches_.of_piece[surface_.piece_of[use]]);
    sort_and_unique(result);
    return result;
  }

  /// The walls around a part determine its patch, because no two patches have the same loops, except needles, for which
  /// the shape decides. Calls visit(match, problem) for each patch with the part's walls until that returns true.
  ///
  /// \return  whether it did
  template <class Visit>
  bool visit_matches(std::span<const std::uint32_t> members, const Visit& visit) const {
    BoundaryPart part = make_part(members);
    for (const bool turned : {false, true}) {
      if (turned) part.turn();
      for (const std::uint32_t patch : find_candidates(part)) {
        if (patches_.open[patch] || patches_.links[patch] != part.links) continue;
        if (visit(Match{patch, turned}, compare_with_patch(topology_.mesh, surface_, patches_, patch, part.faces)))
          return true;
      }
    }
    return false;
  }

  /// The first patch with the part's walls, if nothing is wrong with it. It does not depend on other matches.
  Match find_first(std::span<const std::uint32_t> members) const {
    Match first;
    if (members.empty()) return first;
    visit_matches(members, [&](const Match& match, const std::string& problem) {
      if (problem.empty()) first = match;
      return true;
    });
    return first;
  }

  bool is_free(const Match& match) const {
    return matches_.found[patches_.pieces.of(match.patch)[0]] == FoundAs::nothing;
  }

  bool record_if_free(std::span<const std::uint32_t> members, const Match& match) {
    if (match.patch == none || !is_free(match)) return false;
    record(members, match.patch, match.turned);
    return true;
  }

  bool match_part(std::span<const std::uint32_t> members) {
    return visit_matches(members, [&](const Match& match, const std::string& problem) {
      if (problem.empty() && record_if_free(members, match)) return true;
      matches_.problem[patches_.pieces.of(match.patch)[0]] =
          problem.empty() ? "two sheets of the boundary are on it" : problem;
      return false;
    });
  }

  /// Records that a part of the boundary stands for a patch. `turned`: the patch is seen from inside the mesh.
  void record(std::span<const std::uint32_t> members, std::uint32_t patch, bool turned) {
    const auto is_above = [&](std::uint32_t piece) { return turned != patches_.flipped[piece]; };
    for (const std::uint32_t p : patches_.pieces.of(patch))
      matches_.found[p] = is_above(p) ? FoundAs::boundary_of_above : FoundAs::boundary_of_below;
    const std::uint32_t p = patches_.pieces.of(patch)[0];
    for (const std::uint32_t n : members) {
      const std::uint32_t tet = topology_.half_faces[boundary_.faces[n]][0] / 4;
      matches_.faces.push_back({boundary_.faces[n], p, is_above(p) ? tet : none, is_above(p) ? none : tet, none});
    }
  }

  const Topology& topology_;
  const Surface& surface_;
  FacetMatches& matches_;
  Boundary boundary_;
  Patches patches_;
  std::vector<AtEdge> walls_;  // links of the chains of edges that part patches, with the edge; sorted
};

class InteriorMatcher {
 public:
  InteriorMatcher(const Topology& topology, const Surface& surface, FacetMatches& matches)
      : topology_(topology), surface_(surface), matches_(matches) {}

  /// The faces that the mesh lists go before others that span the same facet as well. Whole facets come first, because
  /// the sheets of a facet need not agree on its inner edges; then parts as small as the edges of the mesh allow, for
  /// slightly bent facets.
  void match(const Chains& chains, const std::vector<bool>& features) {
    const auto is_left = [&](std::uint32_t use) { return matches_.found[surface_.piece_of[use]] == FoundAs::nothing; };
    std::vector<bool> joined(surface_.edges.size());
    for (const bool whole : {true, false}) {
      for (std::uint32_t e = 0; e < surface_.edges.size(); ++e)
        joined[e] = surface_.use_count(e) == 2 && std::ranges::all_of(surface_.uses.of(e), is_left) &&
                    (chains.missing(e) || (whole && !features[e]));
      match_patches(group_pieces(surface_, chains, joined));
    }
  }

 private:
  /// Matches the remaining pieces patch by patch.
  void match_patches(const Patches& patches) {
    for (std::uint32_t n = 0; n < patches.count(); ++n) {
      const auto pieces = patches.pieces.of(n);
      if (std::ranges::any_of(pieces, [&](std::uint32_t p) { return matches_.found[p] != FoundAs::nothing; })) continue;
      const bool is_flat = patches.thickness[n] <= surface_.tolerances.flat;
      if (is_flat) matches_.planes.push_back({patches.normal[n], patches.center[n]});
      const bool may_have_sheet = is_flat && !patches.open[n];
      if (may_have_sheet && match_by_sheet(patches, n, SheetFaces::listed)) continue;
      if (match_piece_by_piece(pieces, is_flat) || !may_have_sheet) continue;
      if (!match_by_sheet(patches, n, SheetFaces::all)) match_by_sheet(patches, n, SheetFaces::without_dead_ends);
    }
  }

  std::uint32_t last_plane() const { return static_cast<std::uint32_t>(matches_.planes.size() - 1); }

  /// Each piece is a face of the mesh as it is.
  /// \param is_flat  the pieces lie in the last of the planes
  bool match_piece_by_piece(std::span<const std::uint32_t> pieces, bool is_flat) {
    std::vector<MatchedFace> faces;
    for (const std::uint32_t p : pieces) {
      if (!surface_.is_triangle(p)) return false;
      const auto edges = surface_.edges_of(p);
      const Face corners = {edges[0][0], edges[1][0], edges[2][0]};
      const std::uint32_t f = find_face(topology_, corners);
      if (f == none || topology_.on_boundary(f)) return false;
      const auto out = outward(topology_.mesh, topology_.half_faces[f][0]);
      const bool first_is_below = std::find(out.begin(), out.end(), corners[0]) - out.begin() ==
                                  (std::find(out.begin(), out.end(), corners[1]) - out.begin() + 2) % 3;
      const std::uint32_t first = topology_.half_faces[f][0] / 4, second = topology_.half_faces[f][1] / 4;
      faces.push_back(
          {f, p, first_is_below ? second : first, first_is_below ? first : second, is_flat ? last_plane() : none});
    }
    for (const std::uint32_t p : pieces) matches_.found[p] = FoundAs::interior;
    matches_.faces.insert(matches_.faces.end(), faces.begin(), faces.end());
    return true;
  }

  bool match_by_sheet(const Patches& patches, std::uint32_t n, SheetFaces which) {
    const std::uint32_t piece = patches.pieces.of(n)[0];
    const std::optional<Sheet> sheet = spread_sheet(topology_, surface_, patches, n, which);
    matches_.problem[piece] =
        sheet ? compare_with_patch(topology_.mesh, surface_, patches, n, sheet->faces) : "no sheet of faces spans it";
    if (!matches_.problem[piece].empty()) return false;
    record(patches, n, *sheet);
    return true;
  }

  void record(const Patches& patches, std::uint32_t n, const Sheet& sheet) {
    const std::uint32_t piece = patches.pieces.of(n)[0];
    for (std::size_t i = 0; i < sheet.faces.size(); ++i) {
      const std::uint32_t f = find_face(topology_, sheet.faces[i]);
      std::uint32_t above = sheet.above[i], below = topology_.across(f, above);
      if (patches.flipped[piece]) std::swap(above, below);
      matches_.faces.push_back({f, piece, above, below, last_plane()});
    }
    for (const std::uint32_t p : patches.pieces.of(n)) matches_.found[p] = FoundAs::interior;
  }

  const Topology& topology_;
  const Surface& surface_;
  FacetMatches& matches_;
};

}  // namespace

FacetMatches match_facets(const Topology& topology, const Surface& surface, const Chains& chains,
                          const std::vector<bool>& features) {
  FacetMatches matches;
  matches.found.assign(surface.pieces(), FoundAs::nothing);
  matches.problem.resize(surface.pieces());
  matches.is_matched.assign(topology.faces.size(), false);
  BoundaryMatcher(topology, surface, chains, matches).match();
  if (std::ranges::count(matches.found, FoundAs::nothing) > 0)
    InteriorMatcher(topology, surface, matches).match(chains, features);
  for (const MatchedFace& f : matches.faces) matches.is_matched[f.face] = true;
  return matches;
}

}  // namespace ccdt::verify
