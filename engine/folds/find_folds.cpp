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

/// Must the edge between two coplanar faces be flipped to make them Delaunay?
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
  FoldFinder(const plc::Plc& plc, const delaunay::Delaunay& delaunay, const protection::SegmentChains& chains,
             const facets::FacetMesh& facets, std::span<const std::uint32_t> codes)
      : plc_(plc), d_(delaunay), facets_(facets), codes_(codes) {
    for (std::uint32_t s = 0; s < chains.size(); ++s) {
      const auto chain = chains[s];
      for (std::size_t i = 0; i + 1 < chain.size(); ++i)
        segment_of_.insert(edge_key(chain[i].vertex, chain[i + 1].vertex), s);
    }
  }

  LooseFolds find() {
    look_at_sides([](const AtEdge&) { return true; }, [&](std::span<const AtEdge> around) { look_at(around); });
    return std::move(loose_);
  }

  std::vector<std::uint32_t> find_touching() {
    look_at_sides([&](const AtEdge& side) { return !facet_of(side).exactly_flat && segment_of_.contains(side.edge); },
                  [&](std::span<const AtEdge> around) { add_touching(around, *segment_of_.find(around[0].edge)); });
    return std::move(loose_.touching);
  }

 private:
  template <class IsWanted, class LookAt>
  void look_at_sides(const IsWanted& is_wanted, const LookAt& look_at) {
    std::vector<AtEdge> sides;
    for (std::uint32_t i = 0; i < facets_.triangles.size(); ++i)
      for (std::size_t k = 0; k < 3; ++k) {
        const AtEdge side{edge_key(facets_.triangles[i][k], facets_.triangles[i][(k + 1) % 3]), i};
        if (is_wanted(side)) sides.push_back(side);
      }
    for_each_edge_group(sides, [&](std::span<const AtEdge> around) {
      if (around.size() > 1) look_at(around);
    });
    for (auto* list : {&loose_.faces, &loose_.segments, &loose_.touching}) {
      std::ranges::sort(*list);
      const auto repeated = std::ranges::unique(*list);
      list->erase(repeated.begin(), repeated.end());
    }
  }

  const plc::Facet& facet_of(const AtEdge& side) const { return plc_.facets[facets_.facet[side.value]]; }

  void look_at(std::span<const AtEdge> around) {
    const std::uint64_t edge = around[0].edge;
    const std::uint32_t* const segment = segment_of_.find(edge);
    if (std::ranges::all_of(around, [&](const AtEdge& side) { return facet_of(side).exactly_flat; })) return;
    if (segment == nullptr) {
      if (!is_delaunay(around) && is_grazeable(around, false))
        for (const AtEdge& side : around) loose_.faces.push_back(side.value);
      return;
    }
    add_touching(around, *segment);
    if (!plc_.segments[*segment].grazeable && !is_delaunay(around) && is_grazeable(around, true))
      loose_.segments.push_back(*segment);
  }

  void add_touching(std::span<const AtEdge> around, std::uint32_t segment) {
    for (std::size_t i = 1; i < around.size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        if (facets_.facet[around[i].value] == facets_.facet[around[j].value] &&
            !has_segment(facet_of(around[i]), segment))
          loose_.touching.insert(loose_.touching.end(), {around[i].value, around[j].value});
  }

  bool is_delaunay(std::span<const AtEdge> around) const {
    const auto is_face = [&](const AtEdge& side) { return codes_[side.value] != delaunay::no_neighbor; };
    const std::uint64_t edge = around[0].edge;
    return std::ranges::any_of(around, is_face) ||
           delaunay::has_edge(d_, static_cast<std::uint32_t>(edge >> 32), static_cast<std::uint32_t>(edge));
  }

  /// Is the segment one of this facet?
  bool has_segment(const plc::Facet& facet, std::uint32_t segment) const {
    const auto [a, b] = plc_.segments[segment].ends;
    return std::ranges::any_of(plc_.triangles_of(facet), [&](const Triangle& t) {
      return std::ranges::find(t, a) != t.end() && std::ranges::find(t, b) != t.end();
    });
  }

  /// On which side of one face at an edge is another one?
  int turn(const AtEdge& side, const AtEdge& other) const {
    const Triangle& t = facets_.triangles[side.value];
    const VertexId apex = corner_beside(facets_.triangles[other.value], side.edge);
    return orient3d(d_.point(t[0]), d_.point(t[1]), d_.point(t[2]), d_.point(apex));
  }

  /// Does the domain span 180 degrees or more on one side of a face at the edge? Then no other face is on that side.
  bool is_grazeable(std::span<const AtEdge> around, bool is_segment) const {
    if (around.size() == 2 && !is_segment && turn(around[0], around[1]) == 0)
      return is_illegal(d_, facets_.triangles[around[0].value],
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

  const plc::Plc& plc_;
  const delaunay::Delaunay& d_;
  const facets::FacetMesh& facets_;
  const std::span<const std::uint32_t> codes_;
  HashTable<std::uint64_t, std::uint32_t> segment_of_;  // by edge
  LooseFolds loose_;
};

}  // namespace

LooseFolds find_loose_folds(const plc::Plc& plc, const delaunay::Delaunay& delaunay,
                            const protection::SegmentChains& chains, const facets::FacetMesh& facets,
                            std::span<const std::uint32_t> codes) {
  return FoldFinder(plc, delaunay, chains, facets, codes).find();
}

std::vector<std::uint32_t> find_touching_faces(const plc::Plc& plc, const delaunay::Delaunay& delaunay,
                                               const protection::SegmentChains& chains,
                                               const facets::FacetMesh& facets) {
  return FoldFinder(plc, delaunay, chains, facets, {}).find_touching();
}

bool is_grazeable_fold(const plc::Plc& plc, const plc::Facet& facet, int turn) {
  const bool above = plc.regions[facet.above].inside, below = plc.regions[facet.below].inside;
  return (turn >= 0 && below) || (turn <= 0 && above);
}

}  // namespace ccdt::folds
