#include "bench/experiments/small_plcs/integer_geometry.h"

#include <algorithm>

namespace ccdt::small {
namespace {

int sign(std::int64_t value) {
  return (value > 0) - (value < 0);
}

/// Is one simplex on one side of a plane across this direction, and the other on the other?
bool separates(const Point& direction, std::span<const Point> one, std::span<const Point> other) {
  if (direction == Point{}) return false;
  const auto less = [&](const Point& p, const Point& q) { return dot(direction, p) < dot(direction, q); };
  const auto [low_one, high_one] = std::ranges::minmax_element(one, less);
  const auto [low_other, high_other] = std::ranges::minmax_element(other, less);
  return dot(direction, *high_one) <= dot(direction, *low_other) ||
         dot(direction, *high_other) <= dot(direction, *low_one);
}

std::vector<Point> edge_directions(std::span<const Point> simplex) {
  std::vector<Point> directions;
  for (std::size_t i = 0; i < simplex.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) directions.push_back(simplex[i] - simplex[j]);
  return directions;
}

std::vector<Point> face_normals(std::span<const Point> simplex) {
  std::vector<Point> normals;
  for (std::size_t i = 0; i < simplex.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      for (std::size_t k = 0; k < j; ++k) normals.push_back(cross(simplex[j] - simplex[i], simplex[k] - simplex[i]));
  return normals;
}

}  // namespace

std::int64_t six_volumes(const Point& a, const Point& b, const Point& c, const Point& d) {
  return determinant(b - a, c - a, d - a);
}

int orientation(const Point& a, const Point& b, const Point& c, const Point& d) {
  return sign(six_volumes(a, b, c, d));
}

int side_of_sphere(const Point& a, const Point& b, const Point& c, const Point& d, const Point& e) {
  // The five points lifted to the paraboloid, seen from e (Guibas and Stolfi 1985).
  const Point p = a - e, q = b - e, r = c - e, s = d - e;
  const std::int64_t lifted = dot(p, p) * determinant(q, r, s) - dot(q, q) * determinant(p, r, s) +
                              dot(r, r) * determinant(p, q, s) - dot(s, s) * determinant(p, q, r);
  return sign(lifted) * orientation(a, b, c, d);
}

bool pierces(const Point& p, const Point& q, const Point& a, const Point& b, const Point& c) {
  if (orientation(a, b, c, p) * orientation(a, b, c, q) >= 0) return false;
  const int turn = orientation(p, q, a, b);
  return turn != 0 && turn == orientation(p, q, b, c) && turn == orientation(p, q, c, a);
}

bool insides_meet(const std::array<Point, 4>& tetrahedron, std::span<const Point> simplex) {
  const auto is_separating = [&](const Point& direction) { return separates(direction, tetrahedron, simplex); };
  if (std::ranges::any_of(face_normals(tetrahedron), is_separating)) return false;
  if (std::ranges::any_of(face_normals(simplex), is_separating)) return false;
  const std::vector<Point> directions = edge_directions(simplex);
  for (const Point& edge : edge_directions(tetrahedron))
    for (const Point& other : directions)
      if (is_separating(cross(edge, other))) return false;
  return true;
}

}  // namespace ccdt::small
