#include "bench/experiments/bravais/lattice_cells.h"

#include <algorithm>
#include <optional>
#include <set>
#include <span>
#include <tuple>
#include <utility>

namespace ccdt::bravais {
namespace {

using small_plcs::determinant;

constexpr std::array<Point, 3> unit_vectors = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};

/// A basis and its negative sum.
using Superbase = std::array<Point, 4>;

bool is_before(const Point& a, const Point& b) {
  return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
}

bool comes_before(const Polytope& a, const Polytope& b) {
  return std::ranges::lexicographical_compare(a, b, is_before);
}

/// Two of the vectors that enclose an acute angle.
std::optional<std::pair<std::size_t, std::size_t>> acute_pair(const Gram& gram, const Superbase& vectors) {
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = i + 1; j < 4; ++j)
      if (product(gram, vectors[i], vectors[j]) > 0) return std::pair(i, j);
  return {};
}

/// Selling's reduction. Each step makes the sum of the squared lengths smaller, so it ends.
Superbase obtuse_superbase(const Gram& gram) {
  const auto& [a, b, c] = unit_vectors;
  Superbase vectors = {a, b, c, Point{} - a - b - c};
  while (const auto pair = acute_pair(gram, vectors)) {
    const Point turned = vectors[pair->first];
    for (std::size_t k = 0; k < 4; ++k)
      if (k != pair->first && k != pair->second) vectors[k] = vectors[k] + turned;
    vectors[pair->first] = Point{} - turned;
  }
  return vectors;
}

/// The sphere through the origin and three lattice points that are not in a plane with it.
class SphereAtOrigin {
 public:
  SphereAtOrigin(const Gram& gram, const Point& a, const Point& b, const Point& c)
      : gram_(gram), corners_{a, b, c}, volume_(determinant(a, b, c)) {
    for (std::size_t i = 0; i < 3; ++i) squared_[i] = squared_length(gram, corners_[i]);
  }

  /// Less than 0 for a point in the sphere, 0 on it, greater than 0 outside. Inner products with the center are linear
  /// and known for the corners, so Cramer's rule gives |e|^2 - 2 e.center, times the determinant of the corners.
  std::int64_t side_of(const Point& e) const {
    const auto& [a, b, c] = corners_;
    const std::int64_t power = volume_ * squared_length(gram_, e) - determinant(e, b, c) * squared_[0] -
                               determinant(a, e, c) * squared_[1] - determinant(a, b, e) * squared_[2];
    return volume_ > 0 ? power : -power;
  }

 private:
  const Gram& gram_;
  std::array<Point, 3> corners_;
  std::array<std::int64_t, 3> squared_ = {};
  std::int64_t volume_;
};

/// The origin and the points on the sphere, as a polytope; empty if there is a point in it.
Polytope polytope_on(const SphereAtOrigin& sphere, std::span<const Point> neighbors) {
  Polytope vertices = {{}};
  for (const Point& e : neighbors) {
    const std::int64_t side = sphere.side_of(e);
    if (side < 0) return {};
    if (side == 0) vertices.push_back(e);
  }
  std::ranges::sort(vertices, is_before);
  const Point first = vertices.front();
  for (Point& vertex : vertices) vertex = vertex - first;
  return vertices;
}

/// The points of a polytope in the plane of three of them; empty if there are points on both sides.
std::vector<Point> facet_through(const Polytope& polytope, const Point& a, const Point& b, const Point& c) {
  std::vector<Point> facet;
  int side = 0;
  for (const Point& point : polytope) {
    const int other = small_plcs::orientation(a, b, c, point);
    if (other == 0) facet.push_back(point);
    if (other * side < 0) return {};
    if (other != 0) side = other;
  }
  return facet;
}

}  // namespace

std::int64_t product(const Gram& gram, const Point& u, const Point& v) {
  return u.x * (gram.aa * v.x + gram.ab * v.y + gram.ac * v.z) + u.y * (gram.ab * v.x + gram.bb * v.y + gram.bc * v.z) +
         u.z * (gram.ac * v.x + gram.bc * v.y + gram.cc * v.z);
}

std::int64_t squared_volume(const Gram& gram) {
  return determinant({gram.aa, gram.ab, gram.ac}, {gram.ab, gram.bb, gram.bc}, {gram.ac, gram.bc, gram.cc});
}

bool is_positive_definite(const Gram& gram) {
  return gram.aa > 0 && gram.aa * gram.bb > gram.ab * gram.ab && squared_volume(gram) > 0;
}

Gram of_vectors(const Gram& gram, const std::array<Point, 3>& vectors) {
  const auto& [u, v, w] = vectors;
  return {squared_length(gram, u), squared_length(gram, v), squared_length(gram, w),
          product(gram, u, v),     product(gram, u, w),     product(gram, v, w)};
}

Gram reduced(const Gram& gram) {
  const Superbase vectors = obtuse_superbase(gram);
  return of_vectors(gram, {vectors[0], vectors[1], vectors[2]});
}

std::array<std::int64_t, 6> selling_parameters(const Gram& gram) {
  const Superbase v = obtuse_superbase(gram);
  std::array<std::int64_t, 6> parameters{};
  std::size_t next = 0;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = i + 1; j < 4; ++j) parameters[next++] = -product(gram, v[i], v[j]);
  return parameters;
}

std::vector<Point> neighbors_of_origin(const Gram& gram) {
  // In coordinates of the four vectors, those of a shortest vector differ by at most 1 where two vectors are not
  // orthogonal. These pairs connect all four, by paths of three at most.
  constexpr std::int64_t most = 3;
  std::array<std::vector<Point>, 8> shortest;
  for (std::int64_t x = -most; x <= most; ++x)
    for (std::int64_t y = -most; y <= most; ++y)
      for (std::int64_t z = -most; z <= most; ++z) {
        std::vector<Point>& known = shortest[static_cast<std::size_t>((x & 1) + 2 * (y & 1) + 4 * (z & 1))];
        const Point v = {x, y, z};
        const std::int64_t excess = known.empty() ? -1 : squared_length(gram, v) - squared_length(gram, known.front());
        if (excess < 0) known.clear();
        if (excess <= 0) known.push_back(v);
      }
  std::vector<Point> all;
  for (std::size_t i = 1; i < shortest.size(); ++i) all.insert(all.end(), shortest[i].begin(), shortest[i].end());
  return all;
}

LatticeCells delaunay_polytopes(const Gram& gram) {
  LatticeCells lattice{reduced(gram)};
  const std::vector<Point> neighbors = neighbors_of_origin(lattice.gram);
  std::set<Polytope, decltype(&comes_before)> found(comes_before);
  for (std::size_t i = 0; i < neighbors.size(); ++i)
    for (std::size_t j = i + 1; j < neighbors.size(); ++j)
      for (std::size_t k = j + 1; k < neighbors.size(); ++k) {
        if (determinant(neighbors[i], neighbors[j], neighbors[k]) == 0) continue;
        Polytope polytope = polytope_on({lattice.gram, neighbors[i], neighbors[j], neighbors[k]}, neighbors);
        if (!polytope.empty()) found.insert(std::move(polytope));
      }
  lattice.polytopes.assign(found.begin(), found.end());
  return lattice;
}

std::int64_t six_volumes(const Polytope& polytope) {
  const Point& apex = polytope.front();
  std::set<std::vector<Point>, decltype(&comes_before)> facets(comes_before);
  for (std::size_t i = 1; i < polytope.size(); ++i)
    for (std::size_t j = i + 1; j < polytope.size(); ++j)
      for (std::size_t k = j + 1; k < polytope.size(); ++k)
        if (determinant(polytope[i] - apex, polytope[j] - apex, polytope[k] - apex) != 0)
          facets.insert(facet_through(polytope, polytope[i], polytope[j], polytope[k]));
  std::int64_t twice = 0;  // the triangles of all corners of a quadrilateral cover it twice
  for (const std::vector<Point>& facet : facets)
    for (std::size_t i = 0; i < facet.size(); ++i)
      for (std::size_t j = i + 1; j < facet.size(); ++j)
        for (std::size_t k = j + 1; k < facet.size(); ++k)
          twice +=
              (facet.size() == 3 ? 2 : 1) * std::abs(determinant(facet[i] - apex, facet[j] - apex, facet[k] - apex));
  return twice / 2;
}

}  // namespace ccdt::bravais
