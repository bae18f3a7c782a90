#include "bench/verify/match_facets.h"

#include <cmath>
#include <set>

#include "engine/base/simplex_map.h"
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
  for (std::uint32_t f = 0; f < topology.faces.size(); ++f) {
    if (!topology.on_boundary(f)) continue;
    const auto n = static_cast<std::uint32_t>(boundary.faces.size());
    boundary.faces.push_back(f);
    boundary.corners.push_back(outward(topology.mesh, topology.half_faces[f][0]));
    for (const Edge& e : edges_of(boundary.corners.back())) boundary.at_edges.push_back({edge_key(e[0], e[1]), n});
  }
  std::sort(boundary.at_edges.begin(), boundary.at_edges.end());
  return boundary;
}

/// The edges between two pieces that the boundary does not have.
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
    std::sort(walls_.begin(), walls_.end());
  }

  void match() {
    const IndexLists parts = divide_boundary();
    for (std::size_t n = 0; n < boundary_.faces.size(); ++n) {
      const auto members = parts.of(n);
      if (members.empty() || match_part(members)) continue;
      for (const std::uint32_t m : members) matches_.stray_faces.push_back(boundary_.faces[m]);
    }
  }

 private:
  /// Sets of boundary faces that no wall divides.
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

  /// The walls around a part tell which patch it stands for, since no two patches have the same loops; needles aside,
  /// where shape tells.
  bool match_part(std::span<const std::uint32_t> members) {
    BoundaryPart part = make_part(members);
    for (const bool turned : {false, true}) {
      if (turned) part.turn();
      for (const std::uint32_t patch : find_candidates(part)) {
        if (patches_.open[patch] || patches_.links[patch] != part.links) continue;
        const std::uint32_t piece = patches_.pieces.of(patch)[0];
        std::string problem = compare_with_patch(topology_.mesh, surface_, patches_, patch, part.faces);
        if (problem.empty() && matches_.found[piece] != FoundAs::nothing)
          problem = "two sheets of the boundary are on it";
        if (problem.empty()) {
          record(members, patch, turned);
          return true;
        }
        matches_.problem[piece] = problem;
      }
    }
    return false;
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

/// Spreads a sheet of inner faces of the mesh over a patch, from the links around it inwards.
///
/// A facet that is flat only within the tolerance may carry flat tetrahedra, so that more than one sheet spans it. The
/// sheet taken is the topmost: its faces have tetrahedra above that are not flat, wherever the links are edges of that
/// sheet.
class Sheet {
 public:
  Sheet(const Topology& topology, const Surface& surface, const Patches& patches, std::uint32_t patch)
      : topology_(topology),
        patches_(patches),
        patch_(patch),
        open_(patches.links[patch]),
        flat_(surface.tolerances.flat),
        greatest_area_(1.001 * patches.area[patch] + surface.tolerances.flat * patches.perimeter[patch]) {
    walls_.insert(open_.begin(), open_.end());
  }

  std::vector<Face> faces;           ///< seen from above
  std::vector<std::uint32_t> above;  ///< the tetrahedron above each face

  /// \return whether the sheet spans the patch
  bool spread() {
    while (!open_.empty()) {
      const Edge edge = open_.back();
      open_.pop_back();
      if (done_.count(edge) == 0 && !add_face(edge[0], edge[1])) return false;
    }
    return true;
  }

 private:
  const Point3& at(std::uint32_t v) const { return topology_.mesh.vertices[v]; }

  bool in_plane(std::uint32_t v) const { return std::fabs(patches_.height(patch_, at(v))) <= flat_; }

  double area_above(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
    return 0.5 * dot(patches_.normal[patch_], cross(at(b) - at(a), at(c) - at(a)));
  }

  bool is_inner(const Face& face) const {
    const std::uint32_t f = find_face(topology_, face);
    return f != none && !topology_.on_boundary(f);
  }

  /// Adds the topmost face to the left of a directed edge.
  bool add_face(std::uint32_t a, std::uint32_t b) {
    const double least_area = -flat_ * length(at(b) - at(a));
    std::uint32_t best = none, best_tet = none;
    std::pair<bool, double> best_rank = {false, least_area};  // is it topmost? its area
    for (const std::uint32_t t : topology_.stars.of(a)) {
      const auto& tet = topology_.mesh.tetrahedra[t];
      if (std::find(tet.begin(), tet.end(), b) == tet.end()) continue;
      for (std::uint32_t corner = 0; corner < 4; ++corner) {
        const std::uint32_t apex = tet[corner];
        if (apex == a || apex == b) continue;
        const auto [u, v, w] = outward(topology_.mesh, 4 * t + corner);
        const std::uint32_t third = u != a && u != b ? u : v != a && v != b ? v : w;
        // Seen from within the tetrahedron, which is to be above, the face runs the other way round than outward.
        const bool runs = (u == b && v == a) || (v == b && w == a) || (w == b && u == a);
        if (!runs || !in_plane(third) || !is_inner({a, b, third})) continue;
        const std::pair<bool, double> rank = {!in_plane(apex), area_above(a, b, third)};
        if (rank <= best_rank || rank.second < least_area) continue;
        best = third;
        best_tet = t;
        best_rank = rank;
      }
    }
    if (best == none) return false;
    faces.push_back({a, b, best});
    above.push_back(best_tet);
    area_ += best_rank.second;
    return area_ <= greatest_area_ && close({a, b}) && close({b, best}) && close({best, a});
  }

  /// An edge of a new face: a link, or to be shared with the next face.
  bool close(const Edge& e) {
    const Edge reverse = {e[1], e[0]};
    if (!done_.insert(e).second) return false;
    if (walls_.count(e) == 0 && done_.count(reverse) == 0) open_.push_back(reverse);
    return true;
  }

  const Topology& topology_;
  const Patches& patches_;
  std::uint32_t patch_;
  std::vector<Edge> open_;
  double flat_, greatest_area_, area_ = 0;
  std::set<Edge> walls_, done_;
};

class InteriorMatcher {
 public:
  InteriorMatcher(const Topology& topology, const Surface& surface, FacetMatches& matches)
      : topology_(topology), surface_(surface), matches_(matches) {}

  /// Whole facets first, since the sheets of a facet need not agree about its inner edges; then as small as the mesh's
  /// edges allow, for facets that are bent a little.
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
  /// Matches what is left of the pieces patch by patch.
  void match_patches(const Patches& patches) {
    for (std::uint32_t n = 0; n < patches.count(); ++n) {
      const auto pieces = patches.pieces.of(n);
      if (std::ranges::any_of(pieces, [&](std::uint32_t p) { return matches_.found[p] != FoundAs::nothing; })) continue;
      const bool is_flat = patches.thickness[n] <= surface_.tolerances.flat;
      if (is_flat) matches_.planes.push_back({patches.normal[n], patches.center[n]});
      if (match_piece_by_piece(pieces, is_flat) || patches.open[n] || !is_flat) continue;
      match_by_sheet(patches, n);
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

  void match_by_sheet(const Patches& patches, std::uint32_t n) {
    Sheet sheet(topology_, surface_, patches, n);
    const std::uint32_t piece = patches.pieces.of(n)[0];
    const std::string problem = sheet.spread() ? compare_with_patch(topology_.mesh, surface_, patches, n, sheet.faces)
                                               : "no sheet of faces spans it";
    if (!problem.empty()) {
      matches_.problem[piece] = problem;
      return;
    }
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
