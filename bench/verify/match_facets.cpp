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

std::array<Edge, 3> edges_of(const Face& v) {
  return {{{v[0], v[1]}, {v[1], v[2]}, {v[2], v[0]}}};
}

/// The boundary of the mesh: faces with one tetrahedron, counterclockwise seen from outside. The half-edge 3 * n + k is
/// the edge of face n that begins at its corner k.
struct Boundary {
  std::span<const std::uint32_t> faces;
  RawVector<Face> corners;
  std::vector<std::uint64_t> edges;  ///< the `edge_key` of each edge, ascending
  IndexLists half_edges;             ///< of each edge
  RawVector<std::uint32_t> edge_of;  ///< of each half-edge
};

Boundary find_boundary(const Topology& topology) {
  Boundary boundary;
  boundary.faces = topology.boundary_faces;
  const std::size_t size = boundary.faces.size();
  boundary.corners.resize(size);
  boundary.edge_of.resize(3 * size);
  std::vector<AtEdge> at_edges(3 * size);
  parallel_for(size, chunk_length, [&](std::size_t n) {
    boundary.corners[n] = outward(topology.mesh, topology.half_faces[boundary.faces[n]][0]);
    const auto edges = edges_of(boundary.corners[n]);
    for (std::size_t k = 0; k < 3; ++k)
      at_edges[3 * n + k] = {edge_key(edges[k][0], edges[k][1]), static_cast<std::uint32_t>(3 * n + k)};
  });
  boundary.half_edges.items.reserve(3 * size);
  for_each_edge_group(at_edges, [&](std::span<const AtEdge> group) {
    boundary.half_edges.first.push_back(static_cast<std::uint32_t>(boundary.half_edges.items.size()));
    for (const AtEdge& entry : group) {
      boundary.edge_of[entry.value] = static_cast<std::uint32_t>(boundary.edges.size());
      boundary.half_edges.items.push_back(entry.value);
    }
    boundary.edges.push_back(group[0].edge);
  });
  boundary.half_edges.first.push_back(static_cast<std::uint32_t>(3 * size));
  return boundary;
}

/// The links of the chains of edges, each with the edge, sorted.
std::vector<AtEdge> find_links(const Chains& chains) {
  std::vector<AtEdge> links;
  const auto links_in = [&](std::size_t e) { return std::max<std::size_t>(chains.of(e).size(), 1) - 1; };
  const auto count_in = [&](std::size_t e, std::size_t end) {
    std::size_t count = 0;
    for (; e < end; ++e) count += links_in(e);
    return count;
  };
  const auto fill = [&](std::size_t e, std::size_t end, std::size_t place) {
    for (; e < end; ++e)
      for (std::size_t k = 1; k <= links_in(e); ++k)
        links[place++] = {edge_key(chains.of(e)[k - 1], chains.of(e)[k]), static_cast<std::uint32_t>(e)};
  };
  parallel_pack(
      chains.first.size() - 1, chunk_length, count_in, [&](std::size_t size) { links.resize(size); }, fill);
  if (!std::ranges::is_sorted(links)) sort_in_runs(links);  // edges are, and most of them are chains of one link
  return links;
}

/// The boundary's edge with each link, or `none`.
RawVector<std::uint32_t> find_edges_with(const std::vector<AtEdge>& links, const Boundary& boundary) {
  const auto& edges = boundary.edges;
  RawVector<std::uint32_t> found(links.size());
  parallel_ranges(links.size(), chunk_length, [&](std::size_t begin, std::size_t end) {
    auto edge = std::ranges::lower_bound(edges, links[begin].edge);
    for (std::size_t i = begin; i < end; ++i) {
      while (edge != edges.end() && *edge < links[i].edge) ++edge;
      found[i] =
          edge != edges.end() && *edge == links[i].edge ? static_cast<std::uint32_t>(edge - edges.begin()) : none;
    }
  });
  return found;
}

/// The edges between two pieces that are missing in the boundary.
std::vector<bool> find_joined(const Surface& surface, const Chains& chains, const std::vector<AtEdge>& links,
                              std::span<const std::uint32_t> edge_with_link) {
  std::vector<bool> joined(surface.edges.size(), false);
  const auto join = [&](std::uint32_t e) { joined[e] = surface.use_count(e) == 2; };
  for (std::uint32_t e = 0; e < surface.edges.size(); ++e)
    if (chains.missing(e)) join(e);
  for (std::size_t i = 0; i < links.size(); ++i)
    if (edge_with_link[i] == none) join(links[i].value);
  return joined;
}

/// A part of the boundary: its faces, and the walls around it with the part to their left, sorted.
struct BoundaryPart {
  std::vector<Face> faces;
  std::vector<Edge> links;
  std::vector<std::uint32_t> candidates;  ///< patches that have the first of these links

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
    const std::vector<AtEdge> links = find_links(chains);
    const RawVector<std::uint32_t> edge_with_link = find_edges_with(links, boundary_);
    const std::vector<bool> joined = find_joined(surface, chains, links, edge_with_link);
    patches_ = group_pieces(surface, chains, joined);
    walls_ = make_index_lists(boundary_.edges.size(), [&](const auto& add) {
      for (std::size_t i = 0; i < links.size(); ++i)
        if (edge_with_link[i] != none && !joined[links[i].value]) add(edge_with_link[i], links[i].value);
    });
  }

  void match() {
    const IndexLists parts = divide_boundary();
    std::vector<Match> first(boundary_.faces.size());  // of the part with the name n
    parallel_ranges(first.size(), short_chunk_length, [&](std::size_t n, std::size_t end) {
      BoundaryPart part;
      for (; n < end; ++n) first[n] = find_first(parts.of(n), part);
    });
    matches_.faces.reserve(boundary_.faces.size());
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

  /// Does an edge of the boundary divide it into parts?
  bool divides(std::uint32_t edge) const {
    return boundary_.half_edges.of(edge).size() != 2 || !walls_.of(edge).empty();
  }

  /// Sets of boundary faces that are not divided by walls.
  IndexLists divide_boundary() {
    UnionFind sets(boundary_.faces.size());
    for (std::uint32_t edge = 0; edge < boundary_.edges.size(); ++edge) {
      if (divides(edge)) continue;
      const auto half_edges = boundary_.half_edges.of(edge);
      sets.join(half_edges[0] / 3, half_edges[1] / 3);
    }
    return make_index_lists(boundary_.faces.size(), [&](const auto& add) {
      for (std::uint32_t n = 0; n < boundary_.faces.size(); ++n) add(sets.find(n), n);
    });
  }

  void make_part(std::span<const std::uint32_t> members, BoundaryPart& part) const {
    part.faces.clear();
    part.links.clear();
    for (const std::uint32_t n : members) {
      part.faces.push_back(boundary_.corners[n]);
      const auto edges = edges_of(boundary_.corners[n]);
      for (std::size_t k = 0; k < 3; ++k)
        if (divides(boundary_.edge_of[3 * n + k])) part.links.push_back(edges[k]);
    }
    std::sort(part.links.begin(), part.links.end());
  }

  void find_candidates(std::span<const std::uint32_t> members, BoundaryPart& part) const {
    part.candidates.clear();
    for (const std::uint32_t n : members) {
      const auto edges = edges_of(boundary_.corners[n]);
      for (std::size_t k = 0; k < 3; ++k) {
        if (part.links.empty() || ascending(edges[k]) != ascending(part.links[0])) continue;
        for (const std::uint32_t edge : walls_.of(boundary_.edge_of[3 * n + k]))
          for (const std::uint32_t use : surface_.uses.of(edge))
            part.candidates.push_back(patches_.of_piece[surface_.piece_of[use]]);
      }
    }
    sort_and_unique(part.candidates);
  }

  /// The walls around a part determine its patch, because no two patches have the same loops, except needles, for which
  /// the shape decides. Calls visit(match, problem) for each patch with the part's walls until that returns true.
  ///
  /// \return  whether it did
  template <class Visit>
  bool visit_matches(std::span<const std::uint32_t> members, BoundaryPart& part, const Visit& visit) const {
    make_part(members, part);
    for (const bool turned : {false, true}) {
      if (turned) part.turn();
      find_candidates(members, part);
      for (const std::uint32_t patch : part.candidates) {
        if (patches_.open[patch] || !std::ranges::equal(patches_.links_of(patch), part.links)) continue;
        if (visit(Match{patch, turned}, compare_with_patch(topology_.mesh, surface_, patches_, patch, part.faces)))
          return true;
      }
    }
    return false;
  }

  /// The first patch with the part's walls, if nothing is wrong with it. It does not depend on other matches.
  Match find_first(std::span<const std::uint32_t> members, BoundaryPart& part) const {
    Match first;
    if (members.empty()) return first;
    visit_matches(members, part, [&](const Match& match, const std::string& problem) {
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
    BoundaryPart part;
    return visit_matches(members, part, [&](const Match& match, const std::string& problem) {
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
  IndexLists walls_;  // for each boundary edge: the surface's edges along it that separate patches
};

class InteriorMatcher {
 public:
  InteriorMatcher(const Topology& topology, const Surface& surface, FacetMatches& matches)
      : topology_(topology), surface_(surface), matches_(matches) {}

  /// If several sets of faces span a facet, those that the mesh lists have priority. Whole facets come first, because
  /// the sheets of a facet need not agree on its inner edges. Then, for facets that are not quite flat, come parts
  /// whose own triangles the mesh does not list, and parts as small as the edges of the mesh allow.
  void match(const Chains& chains, const std::vector<bool>& features) {
    const auto is_left = [&](std::uint32_t use) { return matches_.found[surface_.piece_of[use]] == FoundAs::nothing; };
    const auto is_unlisted = [&](std::uint32_t use) {
      const std::uint32_t face = face_of_piece(surface_.piece_of[use]);
      return face != none && !topology_.listed[face];
    };
    std::vector<bool> joined(surface_.edges.size());
    for (const Parts parts : {Parts::whole_facets, Parts::unlisted, Parts::smallest}) {
      for (std::uint32_t e = 0; e < surface_.edges.size(); ++e) {
        const auto uses = surface_.uses.of(e);
        joined[e] = uses.size() == 2 && std::ranges::all_of(uses, is_left) &&
                    (chains.missing(e) ||
                     (!features[e] && (parts == Parts::whole_facets ||
                                       (parts == Parts::unlisted && std::ranges::all_of(uses, is_unlisted)))));
      }
      match_patches(group_pieces(surface_, chains, joined), parts);
    }
  }

 private:
  enum class Parts : std::uint8_t { whole_facets, unlisted, smallest };

  /// The piece itself as a face of the mesh; `none` if it is not one.
  std::uint32_t face_of_piece(std::uint32_t piece) const {
    if (!surface_.is_triangle(piece)) return none;
    const auto edges = surface_.edges_of(piece);
    return find_face(topology_, {edges[0][0], edges[1][0], edges[2][0]});
  }

  bool is_listed(std::uint32_t piece) const {
    const std::uint32_t face = face_of_piece(piece);
    return face != none && topology_.listed[face];
  }

  /// Matches the remaining pieces patch by patch.
  void match_patches(const Patches& patches, Parts parts) {
    const bool needs_listed = parts != Parts::smallest && !topology_.mesh.faces.empty();
    for (std::uint32_t n = 0; n < patches.count(); ++n) {
      const auto pieces = patches.pieces.of(n);
      if (std::ranges::any_of(pieces, [&](std::uint32_t p) { return matches_.found[p] != FoundAs::nothing; })) continue;
      const bool is_flat = patches.thickness[n] <= surface_.tolerances.flat;
      if (is_flat) matches_.planes.push_back({patches.normal[n], patches.center[n]});
      const bool may_have_sheet = is_flat && !patches.open[n];
      if (may_have_sheet && match_by_sheet(patches, n, SheetFaces::listed)) continue;
      const bool may_be_whole = !needs_listed || std::ranges::all_of(pieces, [&](auto p) { return is_listed(p); });
      if ((may_be_whole && match_piece_by_piece(pieces, is_flat)) || !may_have_sheet) continue;
      if (!match_by_sheet(patches, n, SheetFaces::all)) match_by_sheet(patches, n, SheetFaces::without_dead_ends);
    }
  }

  std::uint32_t last_plane() const { return static_cast<std::uint32_t>(matches_.planes.size() - 1); }

  /// Matches the pieces if each of them is a face of the mesh.
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
  matches.is_matched.assign(topology.face_count(), false);
  BoundaryMatcher(topology, surface, chains, matches).match();
  if (std::ranges::count(matches.found, FoundAs::nothing) > 0)
    InteriorMatcher(topology, surface, matches).match(chains, features);
  for (const MatchedFace& f : matches.faces) matches.is_matched[f.face] = true;
  return matches;
}

}  // namespace ccdt::verify
