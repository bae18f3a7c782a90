#include "bench/experiments/bravais/triangulations.h"

#include <algorithm>
#include <cstdlib>
#include <numeric>

namespace ccdt::bravais {

std::int64_t six_volumes_of(const Cell& cell) {
  return std::abs(small_plcs::six_volumes(cell[0], cell[1], cell[2], cell[3]));
}

namespace {

using Corners = std::array<std::uint32_t, 4>;  ///< numbers of vertices, in increasing order
using FaceCorners = std::array<std::uint32_t, 3>;

Cell cell_of(const Polytope& polytope, const Corners& c) {
  return {polytope[c[0]], polytope[c[1]], polytope[c[2]], polytope[c[3]]};
}

/// The tetrahedra of the polytope's vertices that are not flat.
std::vector<Corners> tetrahedra_of(const Polytope& polytope) {
  std::vector<Corners> all;
  const auto n = static_cast<std::uint32_t>(polytope.size());
  for (std::uint32_t i = 0; i < n; ++i)
    for (std::uint32_t j = i + 1; j < n; ++j)
      for (std::uint32_t k = j + 1; k < n; ++k)
        for (std::uint32_t l = k + 1; l < n; ++l)
          if (six_volumes_of(cell_of(polytope, {i, j, k, l})) != 0) all.push_back({i, j, k, l});
  return all;
}

/// Is the whole polytope on one side of the face?
bool is_on_boundary(const Polytope& polytope, const FaceCorners& f) {
  int low = 0, high = 0;
  for (const Point& point : polytope) {
    const int side = small_plcs::orientation(polytope[f[0]], polytope[f[1]], polytope[f[2]], point);
    low = std::min(low, side);
    high = std::max(high, side);
  }
  return low == 0 || high == 0;
}

/// A search through the sets of tetrahedra whose insides do not meet.
class TriangulationSearch {
 public:
  explicit TriangulationSearch(const Polytope& polytope) : polytope_(polytope), corners_(tetrahedra_of(polytope)) {
    for (const Corners& c : corners_) cells_.push_back(cell_of(polytope, c));
    apart_.resize(cells_.size(), std::vector<bool>(cells_.size()));
    for (std::size_t i = 0; i < cells_.size(); ++i)
      for (std::size_t j = i + 1; j < cells_.size(); ++j)
        apart_[i][j] = !small_plcs::insides_meet(cells_[i], cells_[j]);
  }

  std::vector<Triangulation> all() {
    std::vector<std::size_t> every(cells_.size());
    std::iota(every.begin(), every.end(), std::size_t{0});
    extend(every, six_volumes(polytope_));
    return found_;
  }

 private:
  /// \param allowed  the tetrahedra after the last chosen one that meet none of the chosen
  /// \param left     six times the volume that is not filled yet
  void extend(const std::vector<std::size_t>& allowed, std::int64_t left) {
    if (left == 0 && is_face_to_face()) {
      Triangulation& triangulation = found_.emplace_back();
      for (const std::size_t i : chosen_) triangulation.push_back(cells_[i]);
    }
    for (std::size_t a = 0; a < allowed.size() && left > 0; ++a) {
      std::vector<std::size_t> next;
      for (std::size_t b = a + 1; b < allowed.size(); ++b)
        if (apart_[allowed[a]][allowed[b]]) next.push_back(allowed[b]);
      chosen_.push_back(allowed[a]);
      extend(next, left - six_volumes_of(cells_[allowed[a]]));
      chosen_.pop_back();
    }
  }

  /// Is each face that only one of the chosen tetrahedra has on the boundary?
  bool is_face_to_face() const {
    std::map<FaceCorners, int> owners;
    for (const std::size_t i : chosen_) {
      const auto& [a, b, c, d] = corners_[i];
      for (const FaceCorners& face : {FaceCorners{a, b, c}, {a, b, d}, {a, c, d}, {b, c, d}}) ++owners[face];
    }
    return std::ranges::all_of(
        owners, [&](const auto& owned) { return owned.second == 2 || is_on_boundary(polytope_, owned.first); });
  }

  const Polytope& polytope_;
  std::vector<Corners> corners_;
  std::vector<Cell> cells_;
  std::vector<std::vector<bool>> apart_;  ///< for the first number less than the second
  std::vector<std::size_t> chosen_;
  std::vector<Triangulation> found_;
};

}  // namespace

std::vector<Triangulation> all_triangulations(const Polytope& polytope) {
  return TriangulationSearch(polytope).all();
}

bool KnownTriangulations::Less::operator()(const Polytope& a, const Polytope& b) const {
  return std::ranges::lexicographical_compare(a, b, [](const Point& p, const Point& q) {
    return std::array{p.x, p.y, p.z} < std::array{q.x, q.y, q.z};
  });
}

const std::vector<Triangulation>& KnownTriangulations::of(const Polytope& polytope) {
  const auto found = known_.find(polytope);
  return found != known_.end() ? found->second : known_.emplace(polytope, all_triangulations(polytope)).first->second;
}

}  // namespace ccdt::bravais
