#include "bench/tests/grid_mesh.h"

#include <cmath>
#include <utility>

namespace ccdt {

namespace {

using Corner = std::array<int, 3>;

class GridMesh {
 public:
  GridMesh(const std::array<int, 3>& size, const CubeRegion& region, const Transform& transform)
      : size_(size), region_(region), transform_(transform) {}

  MeshedInput make(bool turned_diagonals) {
    for (int i = 0; i < size_[0]; ++i)
      for (int j = 0; j < size_[1]; ++j)
        for (int k = 0; k < size_[2]; ++k)
          if (region_(i, j, k) != outside) add_cube({i, j, k});
    for (std::size_t axis = 0; axis < 3; ++axis)
      for (int i = 0; i <= size_[0]; ++i)
        for (int j = 0; j <= size_[1]; ++j)
          for (int k = 0; k <= size_[2]; ++k) add_square({i, j, k}, axis, turned_diagonals);
    result_.input.vertices = result_.mesh.vertices;
    return result_;
  }

 private:
  int region(const Corner& c) const {
    for (std::size_t i = 0; i < 3; ++i)
      if (c[i] < 0 || c[i] >= size_[i]) return outside;
    return region_(c[0], c[1], c[2]);
  }

  std::uint32_t vertex(const Corner& c) {
    const auto [found, is_new] = vertices_.emplace(c, static_cast<std::uint32_t>(vertices_.size()));
    if (is_new)
      result_.mesh.vertices.push_back(
          transform_({static_cast<double>(c[0]), static_cast<double>(c[1]), static_cast<double>(c[2])}));
    return found->second;
  }

  void add_cube(const Corner& low) {
    constexpr std::array<std::array<std::size_t, 3>, 6> orders = {
        {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}}};
    for (std::size_t i = 0; i < orders.size(); ++i) {
      std::array<std::uint32_t, 4> tet;
      Corner c = low;
      tet[0] = vertex(c);
      for (std::size_t k = 0; k < 3; ++k) {
        ++c[orders[i][k]];
        tet[k + 1] = vertex(c);
      }
      if (i >= 3) std::swap(tet[1], tet[2]);
      result_.mesh.tetrahedra.push_back(tet);
      result_.mesh.regions.push_back(region(low));
    }
  }

  /// The square at the low side of a cube across an axis.
  void add_square(const Corner& low, std::size_t axis, bool turned) {
    Corner before = low;
    --before[axis];
    if (region(low) == region(before)) return;
    Corner b = low, c = low, d = low;
    ++b[(axis + 1) % 3];
    ++d[(axis + 2) % 3];
    ++c[(axis + 1) % 3];
    ++c[(axis + 2) % 3];
    const std::array<std::uint32_t, 4> q = {vertex(low), vertex(b), vertex(c), vertex(d)};
    auto& triangles = result_.input.triangles;
    if (turned) {
      triangles.push_back({q[0], q[1], q[3]});
      triangles.push_back({q[1], q[2], q[3]});
    } else {
      triangles.push_back({q[0], q[1], q[2]});
      triangles.push_back({q[0], q[2], q[3]});
    }
  }

  std::array<int, 3> size_;
  const CubeRegion& region_;
  const Transform& transform_;
  std::map<Corner, std::uint32_t> vertices_;
  MeshedInput result_;
};

}  // namespace

MeshedInput make_grid_mesh(const std::array<int, 3>& size, const CubeRegion& region, bool turned_diagonals,
                           const Transform& transform) {
  return GridMesh(size, region, transform).make(turned_diagonals);
}

Point3 rotated(const Point3& p) {
  const double a = 0.7, b = 1.1;
  const Point3 q = {std::cos(a) * p.x - std::sin(a) * p.y, std::sin(a) * p.x + std::cos(a) * p.y, p.z};
  return {q.x, std::cos(b) * q.y - std::sin(b) * q.z + 0.1, std::sin(b) * q.y + std::cos(b) * q.z};
}

}  // namespace ccdt
