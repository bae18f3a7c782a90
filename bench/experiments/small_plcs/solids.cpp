#include "bench/experiments/small_plcs/solids.h"

#include <algorithm>
#include <map>

namespace ccdt::small {
namespace {

constexpr std::int64_t box = 100;  ///< coordinates are 0 to this

std::array<Point, 4> points_of(const std::vector<Point>& vertices, const Tetrahedron& t) {
  return {vertices[t[0]], vertices[t[1]], vertices[t[2]], vertices[t[3]]};
}

/// The triangle, turned so that the vertex is on its inner side.
Polygon seen_from_outside(const std::vector<Point>& vertices, const Triangle& t, Vertex inside) {
  const auto& [a, b, c] = t;
  if (orientation(vertices[a], vertices[b], vertices[c], vertices[inside]) < 0) return {a, b, c};
  return {a, c, b};
}

bool is_face_of(const Polygon& closed, const Polygon& face) {
  return std::ranges::all_of(face, [&](Vertex v) { return std::ranges::find(closed, v) != closed.end(); });
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

}  // namespace

Point random_point(Random& random) {
  const std::int64_t x = random.between(0, box), y = random.between(0, box), z = random.between(0, box);
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

std::vector<Polygon> boundary_of(const std::vector<Point>& vertices, const std::vector<Tetrahedron>& tetrahedra) {
  std::map<Triangle, std::vector<Vertex>> apexes;
  for (const Tetrahedron& t : tetrahedra)
    for (unsigned i = 0; i < 4; ++i)
      apexes[triangle_of(t[(i + 1) % 4], t[(i + 2) % 4], t[(i + 3) % 4])].push_back(t[i]);
  std::vector<Polygon> boundary;
  for (const auto& [face, of] : apexes)
    if (of.size() == 1) boundary.push_back(seen_from_outside(vertices, face, of[0]));
  return boundary;
}

void glue_tetrahedra(Random& random, std::size_t vertices, const Polygon& closed, SmallPlc& plc,
                     std::vector<Tetrahedron>& tetrahedra) {
  constexpr int most_tries = 1000;
  for (int i = 0; i < most_tries && plc.vertices.size() < vertices; ++i) {
    const std::vector<Polygon> faces = boundary_of(plc.vertices, tetrahedra);
    const Polygon& face = faces[random.below(faces.size())];
    if (!is_face_of(closed, face)) glue_one(random, face, plc, tetrahedra);
  }
}

void push_in_triangles(Random& random, std::uint64_t count, SmallPlc& plc) {
  for (std::uint64_t i = 0; i < count; ++i) {
    const SmallPlc before = plc;
    const auto face = static_cast<std::ptrdiff_t>(random.below(plc.boundary.size()));
    const Polygon t = plc.boundary[static_cast<std::size_t>(face)];
    const auto dent = static_cast<Vertex>(plc.vertices.size());
    plc.vertices.push_back(point_below(random, plc, t));
    plc.boundary.erase(plc.boundary.begin() + face);
    for (unsigned k = 0; k < 3; ++k) plc.boundary.push_back({t[k], t[(k + 1) % 3], dent});
    // No edge pierces what bounds the piece that is cut off; if no vertex is in it either, it is all of the domain.
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

void add_segments(Random& random, std::uint64_t count, SmallPlc& plc) {
  for (std::uint64_t i = 0; i < count; ++i) {
    const std::uint64_t n = plc.vertices.size();
    const auto a = static_cast<Vertex>(random.below(n)), b = static_cast<Vertex>(random.below(n));
    const std::vector<Edge> segments = all_segments(plc);
    if (a == b || std::ranges::find(segments, edge_of(a, b)) != segments.end()) continue;
    plc.segments.push_back(edge_of(a, b));
    if (!is_valid(plc)) plc.segments.pop_back();
  }
}

}  // namespace ccdt::small
