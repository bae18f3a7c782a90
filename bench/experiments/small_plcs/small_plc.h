#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <random>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/plc/input.h"

/// Exact geometry of a few points with small whole coordinates, and of plain piecewise linear complexes of these. It
/// shares nothing with the engine, so that one can be checked against the other.
namespace ccdt::small_plcs {

/// A point or a vector. No determinant overflows as long as coordinates are at most `largest_coordinate` in magnitude.
struct Point {
  std::int64_t x = 0, y = 0, z = 0;
  friend bool operator==(const Point&, const Point&) = default;
};
inline constexpr std::int64_t largest_coordinate = 1000;

inline Point operator+(const Point& a, const Point& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
inline Point operator-(const Point& a, const Point& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
inline Point operator*(std::int64_t s, const Point& a) {
  return {s * a.x, s * a.y, s * a.z};
}
inline std::int64_t dot(const Point& a, const Point& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline Point cross(const Point& a, const Point& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline std::int64_t determinant(const Point& a, const Point& b, const Point& c) {
  return dot(cross(a, b), c);
}

/// Six times the signed volume of abcd: positive when abc is seen counterclockwise from d.
std::int64_t six_volumes(const Point& a, const Point& b, const Point& c, const Point& d);

/// Its sign.
int orientation(const Point& a, const Point& b, const Point& c, const Point& d);

/// +1 when e is strictly inside the circumsphere of abcd, 0 on it, -1 outside, however abcd is oriented.
/// \pre abcd are not coplanar
int side_of_sphere(const Point& a, const Point& b, const Point& c, const Point& d, const Point& e);

/// Does the segment pq go through the triangle abc in one point that is inside both? False if any four of the five
/// points are coplanar.
bool pierces(const Point& p, const Point& q, const Point& a, const Point& b, const Point& c);

/// Do the inside of a tetrahedron and the relative inside of another simplex (a tetrahedron, triangle or segment) have
/// a point in common? Tests all planes that could separate them: those along a face of one, or along an edge of each.
bool insides_meet(const std::array<Point, 4>& tetrahedron, std::span<const Point> simplex);

using Vertex = std::uint32_t;
using Edge = std::array<Vertex, 2>;      ///< in increasing order
using Triangle = std::array<Vertex, 3>;  ///< in increasing order where it is a face of tetrahedra
using Polygon = std::vector<Vertex>;     ///< the corners of a facet in order, three or four

/// A piecewise linear complex of a few vertices.
///
/// Invariants (`is_valid`, `is_generic`): the boundary is closed and bounds one body without a void; facets and
/// segments are in the domain and meet only in common corners and edges; of the corners of a facet of four, no three
/// are collinear and at most one is reflex.
struct SmallPlc {
  std::vector<Point> vertices;
  std::vector<Polygon> boundary;       ///< counterclockwise seen from outside
  std::vector<Polygon> interior = {};  ///< facets with the domain on both sides
  std::vector<Edge> segments = {};     ///< that are not edges of facets
};

/// Is the value one of these?
template <class Values>
bool has(const Values& values, const typename Values::value_type& value) {
  return std::ranges::find(values, value) != values.end();
}

Edge edge_of(Vertex a, Vertex b);
Triangle triangle_of(Vertex a, Vertex b, Vertex c);

/// The normal, with twice the area as length. Seen from its tip, the corners are counterclockwise.
Point area_vector(const SmallPlc& plc, const Polygon& polygon);

/// A facet cut into triangles along a diagonal that is within it, in the order of its corners.
std::vector<Triangle> triangles_of(const SmallPlc& plc, const Polygon& polygon);

/// Is the triangle of three corners of a facet within it, if none of the other corners is in the triangle?
bool is_within(const SmallPlc& plc, const Polygon& polygon, const Triangle& triangle);

/// The facets of the boundary and the interior facets.
std::vector<Polygon> all_facets(const SmallPlc& plc);
/// The edges of all facets and the segments, each once, sorted.
std::vector<Edge> all_segments(const SmallPlc& plc);

std::int64_t six_volumes(const SmallPlc& plc);

/// Is the center of the vertices of a simplex inside the domain, and not on its boundary?
bool is_inside(const SmallPlc& plc, const std::vector<Vertex>& simplex);

/// Are no four vertices in a plane (except corners of a facet), and no five on a sphere?
bool is_generic(const SmallPlc& plc, bool may_be_cospherical = false);

/// Is the boundary one surface, do no edges pierce facets or cut them in two, is the volume positive, and are interior
/// facets and segments inside?
bool is_valid(const SmallPlc& plc);

plc::InputPlc as_input(const SmallPlc& plc);

/// The whole PLC on one line, so that a person can rebuild it.
std::string in_words(const SmallPlc& plc);

/// Numbers that are the same on every machine. (The distributions of the standard library are not.)
class Random {
 public:
  /// \param choices  are used first, so that whoever changes one of them changes one choice; they must outlive this
  explicit Random(std::uint64_t seed, std::span<const std::uint8_t> choices = {}) : engine_(seed), choices_(choices) {}
  /// 0 to `count` - 1.
  std::uint64_t below(std::uint64_t count) { return next(count > 256 ? 2 : 1) % count; }
  /// Both ends included.
  std::int64_t between(std::int64_t low, std::int64_t high) {
    return low + static_cast<std::int64_t>(below(static_cast<std::uint64_t>(high - low + 1)));
  }

 private:
  std::uint64_t next(std::size_t bytes) {
    if (choices_.size() < bytes) return engine_();
    std::uint64_t number = 0;
    for (const std::uint8_t byte : choices_.first(bytes)) number = 256 * number + byte;
    choices_ = choices_.subspan(bytes);
    return number;
  }

  std::mt19937_64 engine_;
  std::span<const std::uint8_t> choices_;
};

/// A way to make random PLCs.
struct Family {
  std::string_view name;
  std::string_view what;      ///< one sentence
  bool is_cospherical;        ///< all vertices are on one sphere, so the theorem does not apply
  SmallPlc (*make)(Random&);  ///< may make one that is not valid or generic
};
std::span<const Family> families();

/// The next PLC of a family that is valid and, unless the family is not meant to be, generic.
SmallPlc next_plc(const Family& family, Random& random);

Point random_point(Random& random);

/// The convex hull, as boundary. \pre no four vertices are coplanar
std::vector<Polygon> convex_hull(const std::vector<Point>& vertices);

}  // namespace ccdt::small_plcs
