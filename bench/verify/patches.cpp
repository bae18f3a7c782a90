#include "bench/verify/patches.h"

#include <algorithm>
#include <cmath>
#include <unordered_set>
#include <utility>

#include "bench/verify/exact.h"
#include "bench/verify/findings.h"
#include "engine/base/parallel.h"
#include "engine/base/union_find.h"

namespace ccdt::verify {

namespace {

/// The vertex of a piece that is farthest from the line ab.
Point3 farthest_from(const Surface& surface, std::uint32_t piece, const Point3& a, const Point3& axis) {
  Point3 farthest = a;
  double best = -1;
  for (const Edge& e : surface.edges_of(piece)) {
    const Point3 p = surface.at(e[0]);
    const double distance = squared_length(cross(axis, p - a));
    if (distance <= best) continue;
    best = distance;
    farthest = p;
  }
  return farthest;
}

/// The deviation of two pieces at an edge from one plane: the least altitude of the tetrahedron that they span, which
/// is small for needles with any normal.
double fold_width(const Surface& surface, std::uint32_t edge) {
  const Point3 a = surface.at(surface.edges[edge][0]), b = surface.at(surface.edges[edge][1]);
  const auto use = surface.uses.of(edge);
  const Point3 u = farthest_from(surface, surface.piece_of[use[0]], a, b - a) - a;
  const Point3 v = farthest_from(surface, surface.piece_of[use[1]], a, b - a) - a;
  const Point3 axis = b - a;
  const double base = std::max({squared_length(cross(axis, u)), squared_length(cross(axis, v)),
                                squared_length(cross(u, v)), squared_length(cross(u - axis, v - axis))});
  return base > 0 ? std::fabs(dot(axis, cross(u, v))) / std::sqrt(base) : 0;
}

/// Do two pieces lie on each other, as the two leaves of a closed book?
bool folds_back(const Surface& surface, std::uint32_t edge) {
  const auto use = surface.uses.of(edge);
  const double along =
      dot(surface.area_vector[surface.piece_of[use[0]]], surface.area_vector[surface.piece_of[use[1]]]);
  return (along < 0) == (surface.is_forward(use[0]) != surface.is_forward(use[1])) && along != 0;
}

/// Walks from one end of an edge to the other over mesh edges that lie along it.
class EdgeWalk {
 public:
  /// \param tolerance  greatest distance of a vertex from the edge
  EdgeWalk(const Topology& topology, const Surface& surface, Edge ends, double tolerance)
      : topology_(topology),
        surface_(surface),
        ends_(ends),
        origin_(surface.at(ends[0])),
        axis_(surface.at(ends[1]) - surface.at(ends[0])),
        tolerance_(tolerance) {
    length_ = length(axis_);
    axis_ = (1 / length_) * axis_;
  }

  /// Depth first, nearest vertices first; on nearly every edge there is only one way.
  bool run(std::vector<std::uint32_t>& chain) {
    std::vector<std::vector<std::pair<double, std::uint32_t>>> ahead;  // of each vertex of the chain, nearest last
    chain.assign(1, ends_[0]);
    seen_.insert(ends_[0]);
    ahead.push_back(ahead_of(ends_[0], 0));
    while (!ahead.empty()) {
      if (ahead.back().empty()) {
        ahead.pop_back();
        chain.pop_back();
        continue;
      }
      const auto [along, v] = ahead.back().back();
      ahead.back().pop_back();
      if (!seen_.insert(v).second) continue;
      chain.push_back(v);
      if (v == ends_[1]) return true;
      ahead.push_back(ahead_of(v, along));
    }
    return false;
  }

 private:
  std::vector<std::pair<double, std::uint32_t>> ahead_of(std::uint32_t vertex, double from) const {
    std::vector<std::pair<double, std::uint32_t>> ahead;
    for (const std::uint32_t t : topology_.stars.of(vertex))
      for (const std::uint32_t v : topology_.mesh.tetrahedra[t]) {
        if (seen_.count(v) > 0) continue;
        const Point3 p = topology_.mesh.vertices[v] - origin_;
        const double along = v == ends_[1] ? length_ : dot(p, axis_);
        if (along <= from || along > length_) continue;
        if (v != ends_[1] && (squared_length(p - along * axis_) > tolerance_ * tolerance_ || is_beside(v))) continue;
        ahead.emplace_back(along, v);
      }
    std::sort(ahead.rbegin(), ahead.rend());
    ahead.erase(std::unique(ahead.begin(), ahead.end()), ahead.end());
    return ahead;
  }

  /// Is the vertex one of the input that is near the edge, but not on it?
  bool is_beside(std::uint32_t vertex) const {
    return surface_.tolerances.exact_contacts && surface_.sites.is_given[vertex] &&
           !are_on_one_line(surface_.at(ends_[0]), surface_.at(ends_[1]), surface_.at(vertex));
  }

  const Topology& topology_;
  const Surface& surface_;
  Edge ends_;
  Point3 origin_, axis_;
  double length_ = 0, tolerance_;
  std::unordered_set<std::uint32_t> seen_;
};

void join_pieces(const Surface& surface, const std::vector<bool>& joined, Patches& patches) {
  // The two sides of each piece: 2 * piece is the side to which its normal points.
  UnionFind sides(2 * std::size_t{surface.pieces()});
  for (std::uint32_t e = 0; e < surface.edges.size(); ++e) {
    if (!joined[e]) continue;
    const auto use = surface.uses.of(e);
    const std::uint32_t a = 2 * surface.piece_of[use[0]], b = 2 * surface.piece_of[use[1]];
    const std::uint32_t flip = surface.is_forward(use[0]) == surface.is_forward(use[1]) ? 1 : 0;
    sides.join(a, b + flip);
    sides.join(a + 1, b + 1 - flip);
  }
  std::vector<std::uint32_t> number(surface.pieces(), none);
  std::uint32_t count = 0;
  for (std::uint32_t p = 0; p < surface.pieces(); ++p) {
    const std::uint32_t first = sides.find(2 * p);  // a side of the patch's first piece
    std::uint32_t& its_number = number[first / 2];
    if (its_number == none) its_number = count++;
    patches.of_piece.push_back(its_number);
    patches.flipped.push_back(first % 2 == 1);
  }
  patches.open.assign(count, 0);
  patches.pieces = make_index_lists(count, [&](const auto& add) {
    for (std::uint32_t p = 0; p < surface.pieces(); ++p) add(patches.of_piece[p], p);
  });
}

/// Calls visit(use, chain) for the edges of pieces around a patch.
template <class Visit>
void visit_outline(const Surface& surface, const Chains& chains, const std::vector<bool>& joined,
                   const Patches& patches, std::size_t patch, const Visit& visit) {
  for (const std::uint32_t p : patches.pieces.of(patch))
    for (const std::uint32_t use : surface.uses_of(p))
      if (!joined[surface.edge_of[use]]) visit(use, chains.of(surface.edge_of[use]));
}

void find_links(const Surface& surface, const Chains& chains, const std::vector<bool>& joined, Patches& patches) {
  patches.first_link.resize(patches.count() + 1);
  const auto count_in = [&](std::size_t n, std::size_t end) {
    std::size_t count = 0;
    for (; n < end; ++n)
      visit_outline(surface, chains, joined, patches, n, [&](std::uint32_t, std::span<const std::uint32_t> chain) {
        count += std::max<std::size_t>(chain.size(), 1) - 1;
      });
    return count;
  };
  const auto make_room = [&](std::size_t size) {
    patches.links.resize(size);
    patches.first_link.back() = size;
  };
  const auto fill = [&](std::size_t n, std::size_t end, std::size_t place) {
    for (; n < end; ++n) {
      patches.first_link[n] = place;
      visit_outline(surface, chains, joined, patches, n, [&](std::uint32_t use, std::span<const std::uint32_t> chain) {
        if (chain.empty()) patches.open[n] = 1;
        const bool backward = surface.is_forward(use) == patches.flipped[surface.piece_of[use]];
        for (std::size_t k = 1; k < chain.size(); ++k)
          patches.links[place++] = {chain[backward ? k : k - 1], chain[backward ? k - 1 : k]};
      });
      std::sort(patches.links.data() + patches.first_link[n], patches.links.data() + place);
    }
  };
  parallel_pack(patches.count(), short_chunk_length, count_in, make_room, fill);
}

void find_plane(const Surface& surface, std::uint32_t n, Patches& patches) {
  Point3 sum, center;
  double corners = 0, thickness = 0, perimeter = 0;
  for (const std::uint32_t p : patches.pieces.of(n)) {
    sum = sum + (patches.flipped[p] ? -1.0 : 1.0) * surface.area_vector[p];
    for (const auto& [site, next] : surface.edges_of(p)) {
      center = center + (surface.at(site) - surface.origin(p)) + surface.origin(p);
      ++corners;
    }
  }
  const double area = length(sum);
  patches.normal[n] = area > 0 ? (1 / area) * sum : Point3{};
  patches.center[n] = (1 / corners) * center;
  for (const std::uint32_t p : patches.pieces.of(n))
    for (const auto& [site, next] : surface.edges_of(p))
      thickness = std::max(thickness, std::fabs(patches.height(n, surface.at(site))));
  for (const auto& [a, b] : patches.links_of(n)) perimeter += length(surface.at(a) - surface.at(b));
  patches.area[n] = area;
  patches.thickness[n] = thickness;
  patches.perimeter[n] = perimeter;
}

void find_planes(const Surface& surface, Patches& patches) {
  const std::size_t count = patches.count();
  for (std::vector<Point3>* const list : {&patches.normal, &patches.center}) list->resize(count);
  for (std::vector<double>* const list : {&patches.area, &patches.thickness, &patches.perimeter}) list->resize(count);
  parallel_for(count, short_chunk_length,
               [&](std::size_t n) { find_plane(surface, static_cast<std::uint32_t>(n), patches); });
}

/// The vertices along an edge. Two edges of a needle may be within the tolerance of each other, so chains closer to the
/// edge come first: a chain on the edge up to rounding is right.
bool find_chain(const Topology& topology, const Surface& surface, const Edge& edge, std::vector<std::uint32_t>& chain) {
  for (const double part : {1e-5, 1e-2, 1.0})
    if (EdgeWalk(topology, surface, edge, part * surface.tolerances.place).run(chain)) return true;
  return false;
}

/// Must a mesh have this edge?
bool is_feature(const Surface& surface, std::uint32_t e) {
  if (surface.use_count(e) != 2) return true;
  const auto use = surface.uses.of(e);
  if (surface.marker[surface.piece_of[use[0]]] != surface.marker[surface.piece_of[use[1]]] ||
      fold_width(surface, e) > surface.tolerances.flat)
    return true;
  if (!folds_back(surface, e)) return false;
  // Two leaves of one needle count as flat; two broad ones are a fold that must be kept.
  const double edge_length = length(surface.at(surface.edges[e][0]) - surface.at(surface.edges[e][1]));
  const auto broad = [&](std::uint32_t u) {
    return length(surface.area_vector[surface.piece_of[u]]) > surface.tolerances.flat * edge_length;
  };
  return broad(use[0]) && broad(use[1]);
}

struct ChainsOfRange {
  std::vector<std::uint32_t> items, lengths;  ///< the vertices of all chains in order, and the length of each chain
};

}  // namespace

std::vector<bool> find_features(const Surface& surface) {
  const auto parts = parallel_chunks(surface.edges.size(), chunk_length, [&](std::size_t begin, std::size_t end) {
    std::vector<bool> features;
    for (auto e = static_cast<std::uint32_t>(begin); e < end; ++e) features.push_back(is_feature(surface, e));
    return features;
  });
  return joined(parts);
}

Chains find_chains(const Topology& topology, const Surface& surface, std::span<const Edge> edges) {
  const auto parts = parallel_chunks(edges.size(), short_chunk_length, [&](std::size_t begin, std::size_t end) {
    ChainsOfRange range;
    std::vector<std::uint32_t> chain;
    for (const Edge& edge : edges.subspan(begin, end - begin)) {
      const std::size_t before = range.items.size();
      if (surface.sites.in_mesh(edge[0]) && surface.sites.in_mesh(edge[1])) {
        if (has_edge(topology, edge[0], edge[1]))
          range.items.insert(range.items.end(), edge.begin(), edge.end());
        else if (find_chain(topology, surface, edge, chain))
          range.items.insert(range.items.end(), chain.begin(), chain.end());
      }
      range.lengths.push_back(static_cast<std::uint32_t>(range.items.size() - before));
    }
    return range;
  });
  Chains chains;
  chains.first.reserve(edges.size() + 1);
  chains.first.push_back(0);
  for (const ChainsOfRange& range : parts) {
    chains.items.insert(chains.items.end(), range.items.begin(), range.items.end());
    for (const std::uint32_t length : range.lengths) chains.first.push_back(chains.first.back() + length);
  }
  return chains;
}

Patches group_pieces(const Surface& surface, const Chains& chains, const std::vector<bool>& joined) {
  Patches patches;
  join_pieces(surface, joined, patches);
  find_links(surface, chains, joined, patches);
  find_planes(surface, patches);
  return patches;
}

Patches group_pieces(const Surface& surface, const std::vector<bool>& joined) {
  Chains no_chains;
  no_chains.first.assign(surface.edges.size() + 1, 0);
  return group_pieces(surface, no_chains, joined);
}

std::string compare_with_patch(const mesh::TetMesh& mesh, const Surface& surface, const Patches& patches,
                               std::uint32_t patch, std::span<const Face> faces) {
  const auto pieces = patches.pieces.of(patch);
  if (pieces.size() == 1 && surface.is_triangle(pieces[0]) && faces.size() == 1)
    return {};  // the links are the whole triangle
  const double flat = surface.tolerances.flat;
  if (patches.thickness[patch] > flat)
    return "edges of facets that are not in one plane are missing; the patch is " +
           std::to_string(patches.thickness[patch] / flat) + " tolerances thick";
  const Point3 normal = patches.normal[patch];
  const double slack = surface.tolerances.place * patches.perimeter[patch];
  double area = 0;
  std::vector<std::uint32_t> vertices;
  for (const auto& [a, b, c] : faces) {
    for (const std::uint32_t v : {a, b, c}) {
      vertices.push_back(v);
      if (std::fabs(patches.height(patch, mesh.vertices[v])) > flat)
        return "the vertex " + text(mesh.vertices[v]) + " is not in the plane of the facet";
    }
    const Point3 ab = mesh.vertices[b] - mesh.vertices[a], ac = mesh.vertices[c] - mesh.vertices[a];
    const double face_area = 0.5 * dot(normal, cross(ab, ac));
    const double longest = std::sqrt(std::max({squared_length(ab), squared_length(ac), squared_length(ac - ab)}));
    if (face_area < -surface.tolerances.flat * longest)
      return "a face of the mesh at " + text(mesh.vertices[a]) + " is turned over";
    area += face_area;
  }
  if (std::fabs(area - patches.area[patch]) > 1e-9 * patches.area[patch] + slack)
    return "the area is " + std::to_string(area) + " instead of " + std::to_string(patches.area[patch]);
  std::sort(vertices.begin(), vertices.end());
  for (const std::uint32_t p : pieces)
    for (const auto& [site, next] : surface.edges_of(p))
      if (!std::binary_search(vertices.begin(), vertices.end(), site))
        return "no face of the mesh there has the vertex of the facet " + text(surface.at(site));
  return {};
}

}  // namespace ccdt::verify
