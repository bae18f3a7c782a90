#include "engine/plc/strict_places.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "engine/base/box.h"
#include "engine/base/parallel.h"
#include "engine/geometry/box_tree.h"

namespace ccdt::plc {
namespace {

double share_in(const FacetPart& part, const Strictness& strictness) {
  double share = strictness.share;
  const Box box = bounding_box(part.corners);
  for (const auto& [other, its_share] : strictness.places)
    if (bounding_box(other.corners).meets(box) && have_close_normals(other, part)) share = std::min(share, its_share);
  return share;
}

/// \param least  the smallest one before 0
double next_share(double share, double least) {
  return share > 1.5 * least ? share / 10 : 0;
}

/// The vertices of a facet are within the tolerance of one plane on both sides, so those of its parts are within twice
/// that of any parallel plane through one of them.
bool is_in_plane(const Point3& p, const FacetPart& part, double tolerance) {
  return std::fabs(dot(p - part.corners[0], part.normal)) <= 2 * tolerance * std::sqrt(squared_length(part.normal));
}

}  // namespace

std::vector<double> tolerances_of(std::span<const Point3> vertices, std::span<const std::array<VertexId, 3>> triangles,
                                  const Strictness& strictness, double tolerance) {
  std::vector<double> tolerances(triangles.size(), strictness.share * tolerance);
  if (strictness.places.empty()) return tolerances;
  RawVector<Box> boxes(strictness.places.size());
  for (std::size_t i = 0; i < boxes.size(); ++i) boxes[i] = bounding_box(strictness.places[i].part.corners);
  const BoxTree tree(std::move(boxes));
  parallel_for(triangles.size(), 4096, [&](std::size_t t) {
    const auto& [a, b, c] = triangles[t];
    const std::array corners = {vertices[a], vertices[b], vertices[c]};
    tree.for_each_meeting(bounding_box(corners), [&](std::uint32_t i) {
      const auto& [part, share] = strictness.places[i];
      if (std::ranges::all_of(corners, [&](const Point3& p) { return is_in_plane(p, part, tolerance); }))
        tolerances[t] = std::min(tolerances[t], share * tolerance);
    });
  });
  return tolerances;
}

bool tighten(std::span<const FacetPart> parts, Strictness& strictness) {
  constexpr double least_in_places = 0.1, least_everywhere = 1e-3;
  std::vector<StrictPlace> places;
  bool helps = !parts.empty();
  for (const FacetPart& part : parts) {
    const double share = share_in(part, strictness);
    places.push_back({part, next_share(share, least_in_places)});
    helps = helps && share > 0;
  }
  if (helps) {
    strictness.places.insert(strictness.places.end(), places.begin(), places.end());
    return true;
  }
  if (strictness.share == 0) return false;
  strictness.share = next_share(strictness.share, least_everywhere);
  return true;
}

}  // namespace ccdt::plc
