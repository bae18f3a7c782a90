#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <stdexcept>
#include <string>

#include "bench/experiments/small_plcs/trial.h"

namespace ccdt::small_plcs {
namespace {

constexpr std::int64_t largest_random = 100;  ///< coordinates are 0 to this

/// The triangle, turned so that the vertex is on its inner side.
Polygon seen_from_outside(const std::vector<Point>& vertices, const Triangle& t, Vertex inside) {
  const auto& [a, b, c] = t;
  if (orientation(vertices[a], vertices[b], vertices[c], vertices[inside]) < 0) return {a, b, c};
  return {a, c, b};
}

/// Tries once to glue one tetrahedron.
void glue_one(Random& random, const Polygon& face, SmallPlc& plc, std::vector<Tetrahedron>& tetrahedra) {
  const bool is_new = random.below(4) != 0;
  const std::size_t count = plc.vertices.size();
  if (is_new) plc.vertices.push_back(random_point(random));
  const auto apex = static_cast<Vertex>(is_new ? count : random.below(count));
  Tetrahedron t = {face[0], face[1], face[2], apex};
  std::ranges::sort(t);
  const bool fits =
      orientation(plc.vertices[face[0]], plc.vertices[face[1]], plc.vertices[face[2]], plc.vertices[apex]) > 0 &&
      std::ranges::none_of(tetrahedra, [&](const Tetrahedron& other) {
        return insides_meet(points_of(plc.vertices, t), points_of(plc.vertices, other));
      });
  if (fits)
    tetrahedra.push_back(t);
  else
    plc.vertices.resize(count);
}

/// A vertex below a triangle: a mean of its corners and another vertex, with random weights.
Point point_below(Random& random, const SmallPlc& plc, const Polygon& triangle) {
  const Vertex other = static_cast<Vertex>(random.below(plc.vertices.size()));
  Point sum;
  std::int64_t weights = 0;
  for (const Vertex v : {triangle[0], triangle[1], triangle[2], other}) {
    const std::int64_t weight = random.between(1, 20);
    sum = sum + weight * plc.vertices[v];
    weights += weight;
  }
  return {sum.x / weights, sum.y / weights, sum.z / weights};
}

bool is_facet(const SmallPlc& plc, const Triangle& triangle) {
  return std::ranges::any_of(all_facets(plc), [&](const Polygon& facet) {
    return facet.size() == 3 && triangle_of(facet[0], facet[1], facet[2]) == triangle;
  });
}

/// The faces of only one of the tetrahedra, counterclockwise from outside.
std::vector<Polygon> boundary_of(const std::vector<Point>& vertices, const std::vector<Tetrahedron>& tetrahedra) {
  std::map<Triangle, std::vector<Vertex>> apexes;
  for (const Tetrahedron& t : tetrahedra)
    for (unsigned i = 0; i < 4; ++i) apexes[face_opposite(t, i)].push_back(t[i]);
  std::vector<Polygon> boundary;
  for (const auto& [face, of] : apexes)
    if (of.size() == 1) boundary.push_back(seen_from_outside(vertices, face, of[0]));
  return boundary;
}

/// Glues tetrahedra to tetrahedra until there are this many vertices. Nothing is glued to faces of the `closed`
/// corners. Most of the new tetrahedra bring a vertex of their own.
void glue_tetrahedra(Random& random, std::size_t vertices, const Polygon& closed, SmallPlc& plc,
                     std::vector<Tetrahedron>& tetrahedra) {
  constexpr int most_tries = 1000;
  for (int i = 0; i < most_tries && plc.vertices.size() < vertices; ++i) {
    const std::vector<Polygon> faces = boundary_of(plc.vertices, tetrahedra);
    const Polygon& face = faces[random.below(faces.size())];
    if (!std::ranges::all_of(face, [&](Vertex v) { return has(closed, v); })) glue_one(random, face, plc, tetrahedra);
  }
}

/// Pushes triangles of the boundary in: each becomes three that meet in a new vertex.
void push_in_triangles(Random& random, std::uint64_t count, SmallPlc& plc) {
  for (std::uint64_t i = 0; i < count; ++i) {
    const SmallPlc before = plc;
    const auto face = static_cast<std::ptrdiff_t>(random.below(plc.boundary.size()));
    const Polygon t = plc.boundary[static_cast<std::size_t>(face)];
    const auto dent = static_cast<Vertex>(plc.vertices.size());
    plc.vertices.push_back(point_below(random, plc, t));
    plc.boundary.erase(plc.boundary.begin() + face);
    for (unsigned k = 0; k < 3; ++k) plc.boundary.push_back({t[k], t[(k + 1) % 3], dent});
    // No edge pierces the faces of the piece to cut off. If it contains no vertex either, the domain fills it.
    const auto at = [&](Vertex v) { return plc.vertices[v]; };
    const std::int64_t cut = six_volumes(at(t[0]), at(t[1]), at(t[2]), at(dent));
    bool is_dent = cut < 0 && is_valid(plc);
    for (Vertex v = 0; v < dent && is_dent; ++v) {
      if (v == t[0] || v == t[1] || v == t[2]) continue;
      const bool is_beyond = orientation(at(t[0]), at(t[1]), at(t[2]), at(v)) > 0 ||
                             orientation(at(t[0]), at(t[1]), at(dent), at(v)) < 0 ||
                             orientation(at(t[1]), at(t[2]), at(dent), at(v)) < 0 ||
                             orientation(at(t[2]), at(t[0]), at(dent), at(v)) < 0;
      is_dent = is_beyond;
    }
    if (!is_dent) plc = before;
  }
}

/// Tries `count` times to add a facet within the domain.
void add_triangles(Random& random, std::uint64_t count, SmallPlc& plc) {
  for (std::uint64_t i = 0; i < count; ++i) {
    const std::uint64_t n = plc.vertices.size();
    const auto a = static_cast<Vertex>(random.below(n)), b = static_cast<Vertex>(random.below(n)),
               c = static_cast<Vertex>(random.below(n));
    if (a == b || b == c || a == c || is_facet(plc, triangle_of(a, b, c))) continue;
    plc.interior.push_back({a, b, c});
    if (!is_valid(plc)) plc.interior.pop_back();
  }
}

/// The same with segments.
void add_segments(Random& random, std::uint64_t count, SmallPlc& plc) {
  for (std::uint64_t i = 0; i < count; ++i) {
    const std::uint64_t n = plc.vertices.size();
    const auto a = static_cast<Vertex>(random.below(n)), b = static_cast<Vertex>(random.below(n));
    if (a == b || has(all_segments(plc), edge_of(a, b))) continue;
    plc.segments.push_back(edge_of(a, b));
    if (!is_valid(plc)) plc.segments.pop_back();
  }
}

std::vector<Point> random_points(Random& random, std::int64_t least, std::int64_t most) {
  std::vector<Point> points(static_cast<std::size_t>(random.between(least, most)));
  for (Point& p : points) p = random_point(random);
  return points;
}

/// A convex polyhedron in general position; some of the vertices may be loose inside it.
SmallPlc random_hull(Random& random, std::int64_t least, std::int64_t most) {
  SmallPlc plc;
  do plc.vertices = random_points(random, least, most);
  while (!is_generic(plc));
  plc.boundary = convex_hull(plc.vertices);
  return plc;
}

SmallPlc glued(Random& random) {
  SmallPlc plc{random_points(random, 4, 4), {}};
  std::vector<Tetrahedron> tetrahedra = {{0, 1, 2, 3}};
  glue_tetrahedra(random, static_cast<std::size_t>(random.between(4, 9)), {}, plc, tetrahedra);
  plc.boundary = boundary_of(plc.vertices, tetrahedra);
  return plc;
}

/// A prism over a triangle whose top is turned and whose sides are bent along a diagonal; then shaken.
SmallPlc twisted_prism(Random& random) {
  constexpr double radius = 50, largest_turn = 60;
  const double turn = static_cast<double>(random.between(-10, 10)) / 10 * largest_turn;
  const std::int64_t height = random.between(20, 120);
  SmallPlc plc;
  for (int top = 0; top < 2; ++top)
    for (int i = 0; i < 3; ++i) {
      const double angle = (120 * i + top * turn) * std::numbers::pi / 180;
      plc.vertices.push_back(
          {std::lround(radius * std::cos(angle)), std::lround(radius * std::sin(angle)), top * height});
    }
  for (Point& p : plc.vertices) p = p + Point{random.between(-6, 6), random.between(-6, 6), random.between(-6, 6)};
  plc.boundary = {{0, 2, 1}, {3, 4, 5}};
  for (Vertex i = 0; i < 3; ++i) {
    const Vertex j = (i + 1) % 3;
    plc.boundary.push_back({i, j, 3 + j});
    plc.boundary.push_back({i, 3 + j, 3 + i});
  }
  return plc;
}

SmallPlc dented(Random& random) {
  SmallPlc plc = random_hull(random, 4, 7);
  push_in_triangles(random, 1 + random.below(4), plc);
  return plc;
}

SmallPlc with_segments(Random& random) {
  SmallPlc plc = random_hull(random, 5, 9);
  add_segments(random, 2 + random.below(9), plc);
  return plc;
}

SmallPlc with_facets(Random& random) {
  SmallPlc plc = random_hull(random, 5, 8);
  add_triangles(random, 1 + random.below(8), plc);
  return plc;
}

SmallPlc mixed(Random& random) {
  SmallPlc plc = random_hull(random, 4, 7);
  push_in_triangles(random, 1 + random.below(3), plc);
  add_triangles(random, random.below(8), plc);
  add_segments(random, random.below(12), plc);
  return plc;
}

/// Four points of the plane z = 0 in an order in which they bound a quadrilateral, counterclockwise from above.
Polygon quadrilateral(const std::vector<Point>& p) {
  const auto side = [&](Vertex a, Vertex b, Vertex c) {
    const std::int64_t turn = (p[b].x - p[a].x) * (p[c].y - p[a].y) - (p[b].y - p[a].y) * (p[c].x - p[a].x);
    return turn > 0 ? 1 : turn < 0 ? -1 : 0;
  };
  const auto cross_each_other = [&](Vertex a, Vertex b, Vertex c, Vertex d) {
    return side(a, b, c) * side(a, b, d) < 0 && side(c, d, a) * side(c, d, b) < 0;
  };
  for (Polygon q : {Polygon{0, 1, 2, 3}, Polygon{0, 2, 1, 3}, Polygon{0, 1, 3, 2}}) {
    if (cross_each_other(q[0], q[1], q[2], q[3]) || cross_each_other(q[1], q[2], q[3], q[0])) continue;
    if (area_vector({p, {}}, q).z < 0) std::ranges::reverse(q);
    return q;
  }
  return {0, 1, 2, 3};
}

/// A pyramid over a quadrilateral, convex or not, perhaps another one below it, and tetrahedra glued to both.
SmallPlc quadrilateral_facet(Random& random) {
  SmallPlc plc{random_points(random, 4, 4), {}};
  for (Point& p : plc.vertices) p.z = 0;
  const Polygon base = quadrilateral(plc.vertices);
  const bool is_double = random.below(2) == 0;
  std::vector<Tetrahedron> tetrahedra;
  for (int apex = 0; apex < (is_double ? 2 : 1); ++apex) {
    Point p = random_point(random);
    p.z = (apex == 0 ? 1 : -1) * (p.z + 1);
    for (const auto& [a, b, c] : triangles_of(plc, base)) {
      Tetrahedron t = {a, b, c, static_cast<Vertex>(4 + apex)};
      std::ranges::sort(t);
      tetrahedra.push_back(t);
    }
    plc.vertices.push_back(p);
  }
  glue_tetrahedra(random, static_cast<std::size_t>(random.between(5, 8)), base, plc, tetrahedra);
  plc.boundary = boundary_of(plc.vertices, tetrahedra);
  std::erase_if(plc.boundary,
                [](const Polygon& face) { return std::ranges::all_of(face, [](Vertex v) { return v < 4; }); });
  if (is_double)
    plc.interior.push_back(base);
  else
    plc.boundary.emplace_back(base.rbegin(), base.rend());
  // Tilts the plane of the base.
  const std::int64_t along_x = random.between(-1, 1), along_y = random.between(-1, 1);
  for (Point& p : plc.vertices) p.z += along_x * p.x + along_y * p.y;
  return plc;
}

/// All points with whole coordinates on a sphere that has many.
const std::vector<Point>& sphere_points() {
  constexpr std::int64_t squared_radius = 1105, radius = 33;
  static const std::vector<Point> points = [] {
    std::vector<Point> found;
    for (std::int64_t x = -radius; x <= radius; ++x)
      for (std::int64_t y = -radius; y <= radius; ++y)
        for (std::int64_t z = -radius; z <= radius; ++z)
          if (x * x + y * y + z * z == squared_radius) found.push_back({x, y, z});
    return found;
  }();
  return points;
}

SmallPlc cospherical(Random& random) {
  SmallPlc plc;
  plc.vertices.resize(static_cast<std::size_t>(random.between(5, 7)));
  do
    for (Point& p : plc.vertices) p = sphere_points()[random.below(sphere_points().size())];
  while (!is_generic(plc, true));
  plc.boundary = convex_hull(plc.vertices);
  add_triangles(random, random.below(8), plc);
  add_segments(random, random.below(4), plc);
  return plc;
}

constexpr std::array all_families = {
    Family{"glued tetrahedra", "Random tetrahedra glued together face to face.", false, glued},
    Family{"twisted prisms", "Prisms over a triangle, twisted like Schoenhardt's polyhedron, and shaken.", false,
           twisted_prism},
    Family{"dented hulls", "Convex hulls with one to three triangles pushed in.", false, dented},
    Family{"segments", "Convex hulls with segments that dangle inside.", false, with_segments},
    Family{"facets inside", "Convex hulls with triangles inside.", false, with_facets},
    Family{"mixed", "Dented hulls with triangles and segments inside.", false, mixed},
    Family{"quadrilaterals", "Pyramids over a quadrilateral, one or two, with tetrahedra glued to them.", false,
           quadrilateral_facet},
    Family{"cospherical", "Convex hulls of points of one sphere, with triangles and segments inside.", true,
           cospherical},
};

}  // namespace

std::span<const Family> families() {
  return all_families;
}

SmallPlc next_plc(const Family& family, Random& random) {
  constexpr int most_tries = 100000;
  for (int i = 0; i < most_tries; ++i) {
    SmallPlc plc = family.make(random);
    if (is_generic(plc, family.is_cospherical) && is_valid(plc)) return plc;
  }
  throw std::logic_error("no valid PLC of the family " + std::string(family.name));
}

Point random_point(Random& random) {
  const std::int64_t x = random.between(0, largest_random), y = random.between(0, largest_random),
                     z = random.between(0, largest_random);
  return {x, y, z};
}

std::vector<Polygon> convex_hull(const std::vector<Point>& vertices) {
  std::vector<Polygon> hull;
  const auto n = static_cast<Vertex>(vertices.size());
  for (Vertex a = 0; a < n; ++a)
    for (Vertex b = a + 1; b < n; ++b)
      for (Vertex c = b + 1; c < n; ++c) {
        int above = 0, below = 0;
        Vertex other = 0;
        for (Vertex v = 0; v < n; ++v) {
          const int side = orientation(vertices[a], vertices[b], vertices[c], vertices[v]);
          above += side > 0;
          below += side < 0;
          if (side != 0) other = v;
        }
        if (above == 0 || below == 0) hull.push_back(seen_from_outside(vertices, {a, b, c}, other));
      }
  return hull;
}

}  // namespace ccdt::small_plcs
