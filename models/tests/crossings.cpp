#include "models/tests/crossings.h"

#include <algorithm>
#include <cmath>

#include "engine/geometry/box_tree.h"

namespace ccdt::testing {
namespace {

using Triangle = std::array<std::uint32_t, 3>;

/// Six times the volume of a tetrahedron, or 0 if it is flat up to rounding, so that neighbors in a tilted plane do not
/// cross.
double volume(const Point3& a, const Point3& b, const Point3& c, const Point3& d) {
  const Point3 u = b - a, v = c - a, w = d - a;
  const double value = dot(cross(u, v), w);
  const double longest = std::sqrt(std::max({squared_length(u), squared_length(v), squared_length(w)}));
  return std::fabs(value) < 1e-10 * longest * longest * longest ? 0 : value;
}

bool has(const Triangle& t, std::uint32_t v) {
  return std::find(t.begin(), t.end(), v) != t.end();
}

bool edge_pierces(std::span<const Point3> p, std::uint32_t from, std::uint32_t to, const Triangle& t) {
  if (has(t, from) || has(t, to)) return false;
  const Point3 &a = p[t[0]], &b = p[t[1]], &c = p[t[2]], &d = p[from], &e = p[to];
  if (volume(a, b, c, d) * volume(a, b, c, e) >= 0) return false;
  const double ab = volume(d, e, a, b), bc = volume(d, e, b, c), ca = volume(d, e, c, a);
  return (ab > 0 && bc > 0 && ca > 0) || (ab < 0 && bc < 0 && ca < 0);
}

bool folded(std::span<const Point3> p, const Triangle& s, const Triangle& t) {
  const auto normal = [&](const Triangle& x) { return cross(p[x[1]] - p[x[0]], p[x[2]] - p[x[0]]); };
  const Point3 m = normal(s), n = normal(t);
  return dot(m, n) < -0.9999 * std::sqrt(squared_length(m) * squared_length(n));
}

bool cross_or_fold(std::span<const Point3> p, const Triangle& s, const Triangle& t) {
  const auto shared = std::count_if(s.begin(), s.end(), [&](std::uint32_t v) { return has(t, v); });
  if (shared == 3) return true;
  if (shared == 2) return folded(p, s, t);
  for (std::size_t k = 0; k < 3; ++k) {
    if (edge_pierces(p, s[k], s[(k + 1) % 3], t) || edge_pierces(p, t[k], t[(k + 1) % 3], s)) return true;
  }
  return false;
}

}  // namespace

std::vector<std::pair<std::size_t, std::size_t>> crossings(std::span<const Point3> vertices,
                                                           std::span<const Triangle> triangles) {
  const auto box = [&](const Triangle& t) {
    return bounding_box(std::array{vertices[t[0]], vertices[t[1]], vertices[t[2]]});
  };
  std::vector<std::pair<std::size_t, std::size_t>> found;
  BoxTree(triangles, box).for_each_pair([&](std::size_t i, std::size_t j) {
    if (cross_or_fold(vertices, triangles[i], triangles[j])) found.push_back(std::minmax(i, j));
  });
  std::sort(found.begin(), found.end());
  return found;
}

}  // namespace ccdt::testing
