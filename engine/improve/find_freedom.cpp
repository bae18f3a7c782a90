#include "engine/improve/find_freedom.h"

#include <array>
#include <cstdint>
#include <optional>

#include "engine/base/hash_table.h"
#include "engine/base/index.h"
#include "engine/base/simplex_map.h"
#include "engine/geometry/predicates.h"
#include "engine/plc/plane_steps.h"

namespace ccdt::improve {
namespace {

Freedom along_line(const Point3& a, const Point3& b) {
  return {1, plc::shortest_step(a, b), {}};
}

/// The facets and segments around a vertex of the PLC.
struct VertexSurroundings {
  FacetId facet;  ///< the first
  bool several_facets = false;
  bool flat = true;      ///< all facets are exactly flat
  bool crossed = false;  ///< some facet lacks one of the first two segments
  std::uint32_t segment_count = 0;
  std::array<std::uint32_t, 2> segments{};  ///< the first two
};

class FreedomFinder {
 public:
  FreedomFinder(const plc::Plc& plc, const protection::SegmentChains& chains)
      : plc_(plc),
        chains_(chains),
        around_(plc.vertices.size()),
        may_slide_along_(plc.segments.size(), true),
        steps_(plc.facets.size()) {
    look_at_segments();
    look_at_facets();
  }

  std::vector<Freedom> find(std::size_t vertices) {
    std::vector<Freedom> freedom(vertices);
    for (std::uint32_t v = 0; v < plc_.vertices.size(); ++v) freedom[v] = of_vertex(v);
    for (std::uint32_t s = 0; s < chains_.size(); ++s) {
      const Freedom along = may_slide_along_[s] ? along_line(end(s, 0), end(s, 1)) : fixed;
      for (std::size_t i = 1; i + 1 < chains_[s].size(); ++i) freedom[chains_[s][i].vertex] = along;
    }
    return freedom;
  }

 private:
  static constexpr Freedom fixed{0, {}, {}};

  const Point3& point(std::uint32_t v) const { return plc_.vertices[v]; }
  const Point3& end(std::uint32_t segment, int i) const { return point(plc_.segments[segment].ends[i]); }
  std::uint32_t other_end(std::uint32_t segment, std::uint32_t v) const {
    const auto& ends = plc_.segments[segment].ends;
    return ends[0] == v ? ends[1] : ends[0];
  }

  void look_at_segments() {
    segment_of_edge_.reserve(plc_.segments.size());
    for (std::uint32_t s = 0; s < plc_.segments.size(); ++s) {
      segment_of_edge_.set(edge_key(plc_.segments[s].ends[0], plc_.segments[s].ends[1]), s);
      for (const VertexId v : plc_.segments[s].ends) {
        VertexSurroundings& around = around_[v];
        if (around.segment_count < 2) around.segments[around.segment_count] = s;
        ++around.segment_count;
      }
    }
  }

  void look_at_facets() {
    for (std::uint32_t f = 0; f < plc_.facets.size(); ++f) {
      const plc::Facet& facet = plc_.facets[f];
      for (const auto& t : plc_.triangles_of(facet))
        for (const VertexId v : t) look_at(FacetId(f), t, v);
      if (!facet.exactly_flat) forbid_edges(facet);
    }
    for (std::uint32_t s = 0; s < plc_.segments.size(); ++s)
      if (plc_.segments[s].touching) may_slide_along_[s] = false;
  }

  void forbid_edges(const plc::Facet& facet) {
    for (const auto& [a, b, c] : plc_.triangles_of(facet))
      for (const std::uint64_t edge : {edge_key(a, b), edge_key(b, c), edge_key(c, a)})
        if (const std::uint32_t* const segment = segment_of_edge_.find(edge)) may_slide_along_[*segment] = false;
  }

  void look_at(FacetId facet, const std::array<VertexId, 3>& triangle, std::uint32_t v) {
    VertexSurroundings& around = around_[v];
    around.flat = around.flat && plc_.facets[facet].exactly_flat;
    if (around.facet.is_none()) around.facet = facet;
    around.several_facets = around.several_facets || around.facet != facet;
    if (around.segment_count != 2) return;
    const auto& [a, b, c] = triangle;
    for (const std::uint32_t s : around.segments)
      if (orient3d(point(a), point(b), point(c), point(other_end(s, v))) != 0) around.crossed = true;
  }

  Freedom of_vertex(std::uint32_t v) const {
    const VertexSurroundings& around = around_[v];
    if (!around.flat) return fixed;
    if (around.segment_count == 2) return of_junction(v, around);
    if (around.segment_count > 0 || around.facet.is_none() || around.several_facets) return fixed;
    return in_plane(around.facet);
  }

  Freedom in_plane(FacetId facet) const {
    if (!steps_[facet]) steps_[facet] = plc::steps_of_facet(plc_.triangles_of(plc_.facets[facet]), plc_.vertices);
    return steps_[facet] ? Freedom{2, steps_[facet]->u, steps_[facet]->v} : fixed;
  }

  /// Two segments on one line that meet without overlap are on opposite sides of their vertex.
  Freedom of_junction(std::uint32_t v, const VertexSurroundings& around) const {
    const auto [s, t] = around.segments;
    if (around.crossed || plc_.segments[s].marker != plc_.segments[t].marker) return fixed;
    if (!may_slide_along_[s] || !may_slide_along_[t]) return fixed;
    const std::uint32_t before = other_end(s, v), after = other_end(t, v);
    return collinear(point(before), point(v), point(after)) ? along_line(point(v), point(after)) : fixed;
  }

  const plc::Plc& plc_;
  const protection::SegmentChains& chains_;
  std::vector<VertexSurroundings> around_;
  // Are all facets at the segment exactly flat, and are the cells around it connected? Where the domain touches itself
  // along the segment, they are not, and a star would have only some of them.
  std::vector<char> may_slide_along_;
  HashTable<std::uint64_t, std::uint32_t> segment_of_edge_;
  mutable std::vector<std::optional<plc::PlaneSteps>> steps_;  // by facet, computed when needed
};

}  // namespace

std::vector<Freedom> find_freedom(const plc::Plc& plc, const protection::SegmentChains& chains, std::size_t vertices) {
  return FreedomFinder(plc, chains).find(vertices);
}

}  // namespace ccdt::improve
