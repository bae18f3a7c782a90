#include "engine/front/visibility.h"

#include "engine/geometry/filters.h"
#include "engine/geometry/predicates.h"

namespace ccdt::front {
namespace {

/// Do filters prove that the line from p to the centroid of abc does not meet the inside of t? The line passes nearly
/// all candidates at a distance, so coplanar points need no exact signs.
bool surely_passes_by(const Corners& t, const Point3& p, const Point3& a, const Point3& b, const Point3& c) {
  int turns_seen = 0;  // a bit for each sign
  const auto add = [&](Sign turn) { turns_seen |= turn == Sign::plus ? 1 : turn == Sign::minus ? 2 : 0; };
  add(orient3d_centroid_filter(p, *t[0], *t[1], a, b, c));
  add(orient3d_centroid_filter(p, *t[1], *t[2], a, b, c));
  if (turns_seen == 3) return true;
  add(orient3d_centroid_filter(p, *t[2], *t[0], a, b, c));
  if (turns_seen == 3) return true;
  const Sign side_of_p = orient3d_filter(*t[0], *t[1], *t[2], p);
  return side_of_p == Sign::zero ||
         (side_of_p != Sign::unknown && side_of_p == orient3d_centroid_filter(*t[0], *t[1], *t[2], a, b, c));
}

/// The sides of the plane of s that the corners of t are on.
std::array<int, 3> sides_of(const Corners& s, const Corners& t) {
  std::array<int, 3> sides;
  for (int i = 0; i < 3; ++i) sides[i] = orient3d(*s[0], *s[1], *s[2], *t[i]);
  return sides;
}

/// Does an edge of t pass through the inside of s?
bool edge_passes_through(const Corners& s, const Corners& t, const std::array<int, 3>& sides) {
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3;
    if (sides[i] * sides[j] >= 0) continue;
    const int turn = orient3d(*t[i], *t[j], *s[0], *s[1]);
    if (turn != 0 && orient3d(*t[i], *t[j], *s[1], *s[2]) == turn && orient3d(*t[i], *t[j], *s[2], *s[0]) == turn)
      return true;
  }
  return false;
}

bool are_on_both_sides(const std::array<int, 3>& sides) {
  return (sides[0] > 0 || sides[1] > 0 || sides[2] > 0) && (sides[0] < 0 || sides[1] < 0 || sides[2] < 0);
}

}  // namespace

bool hides(const Corners& t, const Point3& p, const Point3& a, const Point3& b, const Point3& c) {
  if (surely_passes_by(t, p, a, b, c)) return false;
  const int side_of_p = orient3d(*t[0], *t[1], *t[2], p);
  if (side_of_p == 0) return false;
  const int side_of_face = orient3d_centroid(*t[0], *t[1], *t[2], a, b, c);
  if (side_of_face != -side_of_p) return false;
  // The line of sight passes the three edges on the same side.
  const int turn = orient3d_centroid(p, *t[0], *t[1], a, b, c);
  return turn != 0 && orient3d_centroid(p, *t[1], *t[2], a, b, c) == turn &&
         orient3d_centroid(p, *t[2], *t[0], a, b, c) == turn;
}

bool cross_each_other(const Corners& s, const Corners& t) {
  const std::array<int, 3> sides_of_t = sides_of(s, t);
  if (!are_on_both_sides(sides_of_t)) return false;
  if (edge_passes_through(s, t, sides_of_t)) return true;
  const std::array<int, 3> sides_of_s = sides_of(t, s);
  return are_on_both_sides(sides_of_s) && edge_passes_through(t, s, sides_of_s);
}

}  // namespace ccdt::front
