#include "engine/folds/find_folds.h"

#include <algorithm>
#include <array>
#include <span>

#include "engine/base/hash_table.h"
#include "engine/base/simplex_map.h"
#include "engine/geometry/predicates.h"

namespace ccdt::folds {
namespace {

using Triangle = std::array<VertexId, 3>;

VertexId corner_beside(const Triangle& t, std::uint64_t edge) {
  return *std::ranges::find_if(t, [&](VertexId v) { return v != edge >> 32 && v != (edge & 0xFFFFFFFFu); });
}

/// Must the edge of two coplanar faces be flipped to make their triangulation Delaunay?
bool is_illegal(const delaunay::Delaunay& d, const Triangle& t, VertexId apex) {
  const auto& v = d.vertices;
  const Point3 &a = v[t[0]].point, &b = v[t[1]].point, &c = v[t[2]].point;
  for (const Point3& up : {Point3{1, 0, 0}, Point3{0, 1, 0}, Point3{0, 0, 1}})
    for (const Point3& above : {a + up, a - up})
      if (orient3d(a, b, c, above) > 0)
        return incircle_perturbed(a, b, c, above, v[apex].point,
                                  {v[t[0]].rank, v[t[1]].rank, v[t[2]].rank, v[apex].rank}) > 0;
  return true;
}

/// Looks at the faces around each edge.
class FoldFinder {
 public:
  FoldFinder(const plc::Plc& plc, const protection::ProtectedDelaunay& surface, const facets::FacetMesh& facets)
      : plc_(plc), surface_(surface), facets_(facets) {
    for (std::uint32_t s = 0; s < surface.chains.size(); ++s) {
      const auto chain = surface.chains[s];
      for (std::size_t i = 0; i + 1 < chain.size(); ++i)
        segment_of_.insert(edge_key(chain[i].vertex, chain[i + 1].vertex), s);
    }
  }

  Folds find() {
    std::vector<AtEdge> sides;
    sides.reserve(3 * facets_.triangles.size());
    for (std::uint32_t i = 0; i < facets_.triangles.size(); ++i)
      for (std::size_t k = 0; k < 3; ++k)
        sides.push_back({edge_key(facets_.triangles[i][k], facets_.triangles[i][(k + 1) % 3]), i});
    for_each_edge_group(sides, [&](std::span<const AtEdge> around) {
      if (around.size() > 1) look_at(around);
    });
    for (auto* list : {&folds_.loose_faces, &folds_.loose_segments}) {
      std::ranges::sort(*list);
      const auto repeated = std::ranges::unique(*list);
      list->erase(repeated.begin(), repeated.end());
    }
    return std::move(folds_);
  }

 private:
  const plc::Facet& facet_of(const AtEdge& side) const { return plc_.facets[facets_.facet[side.value]]; }

  void look_at(std::span<const AtEdge> around) {
    const std::uint64_t edge = around[0].edge;
    const std::uint32_t* const segment = segment_of_.find(edge);
    if (std::ranges::all_of(around, [&](const AtEdge& side) { return facet_of(side).exactly_flat; })) return;
    if (segment == nullptr) {
      if (is_grazeable(around, false)) note(edge, nullptr, around);
      return;
    }
    for (std::size_t i = 1; i < around.size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        if (facets_.facet[around[i].value] == facets_.facet[around[j].value] &&
            !has_segment(facet_of(around[i]), *segment))
          folds_.loose_faces.insert(folds_.loose_faces.end(), {around[i].value, around[j].value});
    if (!surface_.must_be_chain[*segment] && is_grazeable(around, true)) note(edge, segment, around);
  }

  /// Is the segment one of this facet?
  bool has_segment(const plc::Facet& facet, std::uint32_t segment) const {
    const auto [a, b] = plc_.segments[segment].ends;
    return std::ranges::any_of(plc_.triangles_of(facet), [&](const Triangle& t) {
      return std::ranges::find(t, a) != t.end() && std::ranges::find(t, b) != t.end();
    });
  }

  /// On which side of a face is another one at the edge?
  int turn(const AtEdge& side, const AtEdge& other) const {
    const Triangle& t = facets_.triangles[side.value];
    const VertexId apex = corner_beside(facets_.triangles[other.value], side.edge);
    const delaunay::Delaunay& d = surface_.delaunay;
    return orient3d(d.point(t[0]), d.point(t[1]), d.point(t[2]), d.point(apex));
  }

  /// Is a sector of the domain of 180 degrees or more around the edge? The next face is then not on that side.
  bool is_grazeable(std::span<const AtEdge> around, bool is_segment) const {
    if (around.size() == 2 && !is_segment && turn(around[0], around[1]) == 0)
      return is_illegal(surface_.delaunay, facets_.triangles[around[0].value],
                        corner_beside(facets_.triangles[around[1].value], around[0].edge));
    return std::ranges::any_of(around, [&](const AtEdge& side) {
      bool above = plc_.regions[facet_of(side).above].inside, below = plc_.regions[facet_of(side).below].inside;
      for (const AtEdge& other : around) {
        if (&other == &side) continue;
        const int its = turn(side, other);
        above = above && its <= 0, below = below && its >= 0;
      }
      return above || below;
    });
  }

  void note(std::uint64_t edge, const std::uint32_t* segment, std::span<const AtEdge> around) {
    const protection::PieceEnds ends = {static_cast<std::uint32_t>(edge >> 32), static_cast<std::uint32_t>(edge)};
    if (delaunay::has_edge(surface_.delaunay, ends[0], ends[1]))
      folds_.edges.push_back(ends);
    else if (segment != nullptr)
      folds_.loose_segments.push_back(*segment);
    else
      for (const AtEdge& side : around) folds_.loose_faces.push_back(side.value);
  }

  const plc::Plc& plc_;
  const protection::ProtectedDelaunay& surface_;
  const facets::FacetMesh& facets_;
  HashTable<std::uint64_t, std::uint32_t> segment_of_;  // by edge
  Folds folds_;
};

}  // namespace

Folds find_folds(const plc::Plc& plc, const protection::ProtectedDelaunay& surface, const facets::FacetMesh& facets) {
  return FoldFinder(plc, surface, facets).find();
}

bool is_grazeable_fold(const plc::Plc& plc, const plc::Facet& facet, int turn) {
  const bool above = plc.regions[facet.above].inside, below = plc.regions[facet.below].inside;
  return (turn >= 0 && below) || (turn <= 0 && above);
}

}  // namespace ccdt::folds
