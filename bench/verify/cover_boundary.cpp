#include <algorithm>

#include "bench/verify/covers.h"
#include "bench/verify/union_find.h"

namespace ccdt::verification {

namespace {

using Edge = std::array<std::uint32_t, 2>;

/// Both ends of an edge in one number, whatever its direction.
std::uint64_t key(const Edge& e) {
  return (std::uint64_t{std::min(e[0], e[1])} << 32) | std::max(e[0], e[1]);
}

/// An edge of the mesh and something at it.
struct At {
  std::uint64_t edge;  ///< its key
  std::uint32_t what;

  friend bool operator<(const At& a, const At& b) { return a.edge != b.edge ? a.edge < b.edge : a.what < b.what; }
};

std::span<const At> all_at(const std::vector<At>& sorted, std::uint64_t edge) {
  const auto begin =
      std::lower_bound(sorted.begin(), sorted.end(), edge, [](const At& a, std::uint64_t e) { return a.edge < e; });
  auto end = begin;
  while (end != sorted.end() && end->edge == edge) ++end;
  return {begin, end};
}

std::span<const At> all_at(const std::vector<At>& sorted, const Edge& edge) {
  return all_at(sorted, key(edge));
}

/// The boundary of the mesh: faces with one tetrahedron, counterclockwise seen from outside.
struct Boundary {
  std::vector<std::uint32_t> faces;
  std::vector<std::array<std::uint32_t, 3>> corners;
  std::vector<At> at_edges;  ///< each edge with the faces at it
};

Boundary find_boundary(const TetMesh& mesh, const Topology& topology) {
  Boundary boundary;
  for (std::uint32_t f = 0; f < topology.faces.size(); ++f) {
    if (!topology.on_boundary(f)) continue;
    const auto n = static_cast<std::uint32_t>(boundary.faces.size());
    const auto v = outward(mesh, topology.half_faces[f][0]);
    boundary.faces.push_back(f);
    boundary.corners.push_back(v);
    for (int i = 0; i < 3; ++i)
      boundary.at_edges.push_back({key({v[static_cast<std::size_t>(i)], v[static_cast<std::size_t>((i + 1) % 3)]}), n});
  }
  std::sort(boundary.at_edges.begin(), boundary.at_edges.end());
  return boundary;
}

/// Each link of the chains of edges that part patches, with the edge.
std::vector<At> find_walls(const Surface& surface, const Chains& chains, const std::vector<bool>& joined) {
  std::vector<At> walls;
  for (std::uint32_t e = 0; e < surface.edges.size(); ++e) {
    if (joined[e]) continue;
    const auto chain = chains.of(e);
    for (std::size_t k = 1; k < chain.size(); ++k) walls.push_back({key({chain[k - 1], chain[k]}), e});
  }
  std::sort(walls.begin(), walls.end());
  return walls;
}

/// The edges between two pieces that the boundary does not have.
std::vector<bool> find_joined(const Surface& surface, const Chains& chains, const Boundary& boundary) {
  std::vector<bool> joined(surface.edges.size(), false);
  for (std::uint32_t e = 0; e < surface.edges.size(); ++e) {
    if (surface.use_count(e) != 2) continue;
    const auto chain = chains.of(e);
    joined[e] = chain.empty();
    for (std::size_t k = 1; k < chain.size() && !joined[e]; ++k)
      joined[e] = all_at(boundary.at_edges, {chain[k - 1], chain[k]}).empty();
  }
  return joined;
}

/// Sets of boundary faces that no wall divides.
std::vector<std::vector<std::uint32_t>> divide_boundary(const Boundary& boundary, const std::vector<At>& walls) {
  UnionFind sets(boundary.faces.size());
  for (std::size_t i = 0; i < boundary.at_edges.size();) {
    std::size_t end = i;
    while (end < boundary.at_edges.size() && boundary.at_edges[end].edge == boundary.at_edges[i].edge) ++end;
    if (end - i == 2 && all_at(walls, boundary.at_edges[i].edge).empty())
      sets.join(boundary.at_edges[i].what, boundary.at_edges[i + 1].what);
    i = end;
  }
  std::vector<std::vector<std::uint32_t>> parts;
  std::vector<std::uint32_t> number(boundary.faces.size(), none);
  for (std::uint32_t n = 0; n < boundary.faces.size(); ++n) {
    std::uint32_t& part = number[sets.root(n)];
    if (part == none) {
      part = static_cast<std::uint32_t>(parts.size());
      parts.emplace_back();
    }
    parts[part].push_back(n);
  }
  return parts;
}

/// A part of the boundary: its faces, and the walls around it with the part to their left, sorted.
struct Part {
  std::vector<std::array<std::uint32_t, 3>> faces;
  std::vector<Edge> links;

  /// The same seen from the other side.
  void turn() {
    for (auto& f : faces) std::swap(f[1], f[2]);
    for (Edge& e : links) std::swap(e[0], e[1]);
    std::sort(links.begin(), links.end());
  }
};

Part make_part(const Boundary& boundary, const std::vector<std::uint32_t>& members, const std::vector<At>& walls) {
  Part part;
  for (const std::uint32_t n : members) {
    const auto& v = boundary.corners[n];
    part.faces.push_back(v);
    for (const Edge& e : {Edge{v[0], v[1]}, Edge{v[1], v[2]}, Edge{v[2], v[0]}})
      if (all_at(boundary.at_edges, e).size() != 2 || !all_at(walls, e).empty()) part.links.push_back(e);
  }
  std::sort(part.links.begin(), part.links.end());
  return part;
}

/// Patches that have the first link of a part.
std::vector<std::uint32_t> candidates(const Surface& surface, const Patches& patches, const std::vector<At>& walls,
                                      const Part& part) {
  std::vector<std::uint32_t> result;
  if (part.links.empty()) return result;
  for (const At& wall : all_at(walls, part.links[0]))
    for (std::uint32_t i = surface.use_begin[wall.what]; i < surface.use_begin[wall.what + 1]; ++i)
      result.push_back(patches.of_piece[surface.piece_of[surface.uses[i]]]);
  std::sort(result.begin(), result.end());
  result.erase(std::unique(result.begin(), result.end()), result.end());
  return result;
}

/// Records that a part of the boundary stands for a patch. `turned`: the patch is seen from inside the mesh.
void match(const Topology& topology, const Boundary& boundary, const std::vector<std::uint32_t>& members,
           const Patches& patches, std::uint32_t patch, bool turned, Covers& covers) {
  for (const std::uint32_t p : patches.pieces_of(patch))
    covers.found[p] = turned != patches.flipped[p] ? Found::boundary_of_above : Found::boundary_of_below;
  const std::uint32_t p = patches.pieces_of(patch)[0];
  for (const std::uint32_t n : members) {
    const std::uint32_t tet = topology.half_faces[boundary.faces[n]][0] / 4;
    const bool above = turned != patches.flipped[p];
    covers.faces.push_back({boundary.faces[n], p, above ? tet : none, above ? none : tet, none});
  }
}

/// The walls around a part tell which patch it stands for, since no two patches have the same loops; needles aside,
/// where shape tells.
bool match_part(const TetMesh& mesh, const Topology& topology, const Surface& surface, const Boundary& boundary,
                const std::vector<At>& walls, const Patches& patches, const std::vector<std::uint32_t>& members,
                Covers& covers) {
  Part part = make_part(boundary, members, walls);
  for (const bool turned : {false, true}) {
    if (turned) part.turn();
    for (const std::uint32_t patch : candidates(surface, patches, walls, part)) {
      const auto links = patches.links_of(patch);
      if (patches.open[patch] || !std::equal(links.begin(), links.end(), part.links.begin(), part.links.end()))
        continue;
      const std::uint32_t piece = patches.pieces_of(patch)[0];
      std::string problem = compare_with_patch(mesh, surface, patches, patch, part.faces);
      if (problem.empty() && covers.found[piece] != Found::nothing) problem = "two sheets of the boundary are on it";
      if (!problem.empty()) {
        covers.problem[piece] = problem;
        continue;
      }
      match(topology, boundary, members, patches, patch, turned, covers);
      return true;
    }
  }
  return false;
}

}  // namespace

void cover_boundary(const TetMesh& mesh, const Topology& topology, const Surface& surface, const Chains& chains,
                    Covers& covers) {
  const Boundary boundary = find_boundary(mesh, topology);
  const std::vector<bool> joined = find_joined(surface, chains, boundary);
  const Patches patches = group_pieces(surface, chains, joined);
  const std::vector<At> walls = find_walls(surface, chains, joined);
  for (const auto& members : divide_boundary(boundary, walls)) {
    if (match_part(mesh, topology, surface, boundary, walls, patches, members, covers)) continue;
    for (const std::uint32_t n : members) covers.stray_faces.push_back(boundary.faces[n]);
  }
}

}  // namespace ccdt::verification
