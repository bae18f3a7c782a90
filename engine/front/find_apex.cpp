#include "engine/front/find_apex.h"

#include <algorithm>
#include <cmath>

#include "engine/front/visibility.h"
#include "engine/numbers/predicates.h"

namespace ccdt {
namespace {

constexpr double everywhere = 0x1p60;

/// The circumsphere in floating point, a little too large; endless where the four points are too flat to tell.
Ball circumsphere(const Point3& a, const Point3& b, const Point3& c, const Point3& d) {
  const Point3 u = b - a, v = c - a, w = d - a;
  const Point3 vw = cross(v, w), wu = cross(w, u), uv = cross(u, v);
  const double volume = dot(u, vw);
  const double size = std::sqrt(squared_length(u) * squared_length(v) * squared_length(w));
  if (std::fabs(volume) < 1e-9 * size) return {a, everywhere};
  const Point3 to_centre = (0.5 / volume) * (squared_length(u) * vw + squared_length(v) * wu + squared_length(w) * uv);
  const double radius = std::sqrt(squared_length(to_centre)) * (1 + 1e-6);
  return {a + to_centre, radius};
}

}  // namespace

ApexFinder::ApexFinder(const FacetMesh& facets, const Delaunay& delaunay)
    : facets_(facets), d_(delaunay), locator_(delaunay.vertices, facets.triangles) {}

std::optional<std::uint32_t> ApexFinder::find(const OrientedFace& face) {
  face_ = face.corners;
  best_ = ghost_vertex;
  const Point3 &a = d_.point(face_[0]), &b = d_.point(face_[1]), &c = d_.point(face_[2]);
  Ball ball{a, everywhere};
  const auto consider = [&](std::uint32_t v) {
    if (!is_better(v)) return;
    best_ = v;
    ball = circumsphere(a, b, c, d_.point(v));
  };
  // What is above the face and in a later, smaller sphere is in the earlier one too: one spiral is enough.
  locator_.spiral(approximate_centroid(a, b, c), consider, [&] { return ball; });
  if (best_ == ghost_vertex) return std::nullopt;
  return best_;
}

bool ApexFinder::is_better(std::uint32_t v) const {
  if (v == best_ || v == face_[0] || v == face_[1] || v == face_[2]) return false;
  const Point3 &a = d_.point(face_[0]), &b = d_.point(face_[1]), &c = d_.point(face_[2]), &p = d_.point(v);
  if (orient3d(a, b, c, p) <= 0) return false;
  if (best_ != ghost_vertex && !is_in_sphere(v)) return false;
  return is_visible(v);
}

/// Is v in the sphere of the face and the best vertex so far?
bool ApexFinder::is_in_sphere(std::uint32_t v) const {
  const DelaunayVertex &a = d_.vertices[face_[0]], &b = d_.vertices[face_[1]], &c = d_.vertices[face_[2]],
                       &d = d_.vertices[best_], &e = d_.vertices[v];
  return insphere_perturbed(a.point, b.point, c.point, d.point, e.point, {a.rank, b.rank, c.rank, d.rank, e.rank}) > 0;
}

bool ApexFinder::is_visible(std::uint32_t v) const {
  const Point3 &a = d_.point(face_[0]), &b = d_.point(face_[1]), &c = d_.point(face_[2]), &p = d_.point(v);
  return !locator_.any_near_edge(approximate_centroid(a, b, c), p, [&](std::uint32_t f) {
    const auto& t = facets_.triangles[f];
    if (t[0] == v || t[1] == v || t[2] == v) return false;
    return hides({&d_.point(t[0]), &d_.point(t[1]), &d_.point(t[2])}, p, a, b, c);
  });
}

}  // namespace ccdt
