#include "models/tests/crossings.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace ccdt::testing {
namespace {

using Triangle = std::array<std::uint32_t, 3>;
using Cell = std::array<int, 3>;

/// Six times the volume of a tetrahedron, 0 when it is flat but for rounding: neighbours in a tilted plane do not
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

/// The largest extent of a triangle, so that each covers few cells.
double cell_size(std::span<const Point3> p, std::span<const Triangle> triangles) {
  double size = 0;
  for (const Triangle& t : triangles) {
    for (std::size_t k = 0; k < 3; ++k) size = std::max(size, squared_length(p[t[(k + 1) % 3]] - p[t[k]]));
  }
  return std::sqrt(size);
}

}  // namespace

std::vector<std::pair<std::size_t, std::size_t>> crossings(std::span<const Point3> vertices,
                                                           std::span<const Triangle> triangles) {
  const double size = cell_size(vertices, triangles);
  std::map<Cell, std::vector<std::size_t>> cells;
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    Cell low{}, high{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto cell = [&](std::uint32_t v) {
        return static_cast<int>(std::floor(as_array(vertices[v])[axis] / size));
      };
      const auto [least, most] = std::minmax({cell(triangles[i][0]), cell(triangles[i][1]), cell(triangles[i][2])});
      low[axis] = least;
      high[axis] = most;
    }
    for (int x = low[0]; x <= high[0]; ++x) {
      for (int y = low[1]; y <= high[1]; ++y) {
        for (int z = low[2]; z <= high[2]; ++z) cells[{x, y, z}].push_back(i);
      }
    }
  }
  std::vector<std::pair<std::size_t, std::size_t>> found;
  for (const auto& [cell, members] : cells) {
    for (std::size_t i = 0; i < members.size(); ++i) {
      for (std::size_t j = i + 1; j < members.size(); ++j) {
        if (cross_or_fold(vertices, triangles[members[i]], triangles[members[j]])) {
          found.emplace_back(members[i], members[j]);
        }
      }
    }
  }
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

}  // namespace ccdt::testing
