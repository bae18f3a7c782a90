#include "engine/sizes/curved_edges.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "engine/base/portable_math.h"
#include "engine/base/simplex_map.h"

namespace ccdt::sizes {
namespace {

/// The side of a facet at a segment.
struct FacetSide {
  Point3 normal;  ///< of length one
  double height;  ///< of the triangle over the segment
  RegionId above;
};

/// The sides of all facets, by segment.
std::vector<std::vector<FacetSide>> sides_of_segments(const plc::Plc& plc) {
  std::vector<std::array<VertexId, 2>> ends;
  for (const plc::Segment& s : plc.segments) ends.push_back(s.ends);
  const EdgeMap segment_of_edge(ends, plc.vertices.size());
  std::vector<std::vector<FacetSide>> sides(plc.segments.size());
  for (const plc::Facet& facet : plc.facets) {
    const Point3 normal = normalized(plc::sum_of_normals(plc.triangles_of(facet), plc.vertices));
    for (const auto& t : plc.triangles_of(facet)) {
      for (std::size_t i = 0; i < 3; ++i) {
        const std::uint32_t s = segment_of_edge.find(t[i], t[(i + 1) % 3]);
        if (s == none) continue;
        const Point3 a = plc.vertices[t[i]], b = plc.vertices[t[(i + 1) % 3]], c = plc.vertices[t[(i + 2) % 3]];
        sides[s].push_back({normal, length(area_vector({a, b, c})) / length(b - a), facet.above});
      }
    }
  }
  return sides;
}

}  // namespace

void add_curved_edges(const plc::Plc& plc, double angle, double sharp, const LengthRange& lengths,
                      std::vector<SizedPlace>& places) {
  const auto sides = sides_of_segments(plc);
  for (std::size_t s = 0; s < plc.segments.size(); ++s) {
    if (sides[s].size() != 2) continue;
    const auto& [one, other] = std::array{sides[s][0], sides[s][1]};
    const double cosine = dot(one.normal, other.normal) * (one.above == other.above ? 1 : -1);
    const double turn = portable::arc_cosine(std::clamp(cosine, -1.0, 1.0));
    if (turn == 0 || turn > sharp) continue;
    const double wanted = std::max(lengths.least, angle * 0.5 * (one.height + other.height) / turn);
    if (wanted >= lengths.most) continue;
    const Point3 a = plc.vertices[plc.segments[s].ends[0]], b = plc.vertices[plc.segments[s].ends[1]];
    const double pieces = std::ceil(length(b - a) / wanted);
    for (double i = 0; i < pieces; ++i)
      places.push_back({hull(box_of(a + (i / pieces) * (b - a)), box_of(a + ((i + 1) / pieces) * (b - a))), wanted});
  }
}

}  // namespace ccdt::sizes
