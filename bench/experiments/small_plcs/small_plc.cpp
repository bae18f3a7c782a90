#include "bench/experiments/small_plcs/small_plc.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <set>
#include <sstream>

namespace ccdt::small_plcs {
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

bool is_within_a_facet(const SmallPlc& plc, const std::vector<Vertex>& four) {
  return std::ranges::any_of(all_facets(plc), [&](const Polygon& facet) {
    return std::ranges::all_of(four, [&](Vertex v) { return has(facet, v); });
  });
}

enum class Meeting { apart, touching, crossing, starting_on };

/// How a ray from a point, given by its far end, meets a triangle.
Meeting meet(const Point& from, const Point& end, const Point& p, const Point& q, const Point& r) {
  const auto [least, most] =
      std::minmax({orientation(from, end, p, q), orientation(from, end, q, r), orientation(from, end, r, p)});
  if (least < 0 && most > 0) return Meeting::apart;
  if (least == 0 || most == 0) return Meeting::touching;
  if (orientation(p, q, r, from) == 0) return Meeting::starting_on;
  return pierces(from, end, p, q, r) ? Meeting::crossing : Meeting::apart;
}

/// Does a ray from a point, in units of 1 / `scale`, cross the boundary an odd number of times? Not if the point is on
/// the boundary.
bool is_inside_scaled(const SmallPlc& plc, const Point& point, std::int64_t scale) {
  constexpr int most_rays = 100;
  for (std::int64_t i = 0; i < most_rays; ++i) {
    // So long that it ends outside; turned until it meets no edge.
    const Point end = point + Point{20011, 3001 + 173 * i, 1009 + 311 * i};
    std::map<Meeting, int> count;
    for (const Polygon& facet : plc.boundary)
      for (const auto& [a, b, c] : triangles_of(plc, facet))
        ++count[meet(point, end, scale * plc.vertices[a], scale * plc.vertices[b], scale * plc.vertices[c])];
    if (count[Meeting::touching] == 0) return count[Meeting::starting_on] == 0 && count[Meeting::crossing] % 2 == 1;
  }
  return false;  // on an edge of the boundary
}

/// Does the segment run across a facet of four corners, within its plane?
bool is_diagonal(const Polygon& facet, const Edge& edge) {
  return facet.size() == 4 && ((edge == edge_of(facet[0], facet[2])) || (edge == edge_of(facet[1], facet[3])));
}

/// Does the boundary have two facets at each edge, and do edges connect all facets? Then it bounds one body without a
/// void.
bool is_one_surface(const std::vector<Polygon>& boundary) {
  std::map<Edge, std::vector<std::size_t>> at_edge;
  for (std::size_t f = 0; f < boundary.size(); ++f)
    for (std::size_t i = 0; i < boundary[f].size(); ++i)
      at_edge[edge_of(boundary[f][i], boundary[f][(i + 1) % boundary[f].size()])].push_back(f);
  if (std::ranges::any_of(at_edge, [](const auto& entry) { return entry.second.size() != 2; })) return false;
  std::set<std::size_t> reached = {0};
  for (std::size_t before = 0; before < reached.size();) {
    before = reached.size();
    for (const auto& [edge, facets] : at_edge)
      if (reached.contains(facets[0]) || reached.contains(facets[1])) reached.insert(facets.begin(), facets.end());
  }
  return reached.size() == boundary.size();
}

/// " (0 1 2) (0 2 3)", of facets or segments.
template <class Parts>
std::string list_in_words(const Parts& parts) {
  std::ostringstream text;
  for (const auto& part : parts) {
    text << " (";
    for (std::size_t i = 0; i < part.size(); ++i) text << (i == 0 ? "" : " ") << part[i];
    text << ")";
  }
  return text.str();
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

Edge edge_of(Vertex a, Vertex b) {
  return {std::min(a, b), std::max(a, b)};
}

Triangle triangle_of(Vertex a, Vertex b, Vertex c) {
  Triangle triangle = {a, b, c};
  std::ranges::sort(triangle);
  return triangle;
}

Point area_vector(const SmallPlc& plc, const Polygon& polygon) {
  const Point& first = plc.vertices[polygon[0]];
  Point area;
  for (std::size_t i = 2; i < polygon.size(); ++i)
    area = area + cross(plc.vertices[polygon[i - 1]] - first, plc.vertices[polygon[i]] - first);
  return area;
}

std::vector<Triangle> triangles_of(const SmallPlc& plc, const Polygon& p) {
  if (p.size() == 3) return {{p[0], p[1], p[2]}};
  const Point area = area_vector(plc, p);
  const bool first_diagonal =
      dot(area_vector(plc, {p[0], p[1], p[2]}), area) > 0 && dot(area_vector(plc, {p[0], p[2], p[3]}), area) > 0;
  if (first_diagonal) return {{p[0], p[1], p[2]}, {p[0], p[2], p[3]}};
  return {{p[1], p[2], p[3]}, {p[1], p[3], p[0]}};
}

bool is_within(const SmallPlc& plc, const Polygon& polygon, const Triangle& triangle) {
  Polygon in_order;
  std::ranges::copy_if(polygon, std::back_inserter(in_order), [&](Vertex v) { return has(triangle, v); });
  // At a reflex corner three in order turn the other way.
  return in_order.size() == 3 && dot(area_vector(plc, in_order), area_vector(plc, polygon)) > 0;
}

std::vector<Polygon> all_facets(const SmallPlc& plc) {
  std::vector<Polygon> facets = plc.boundary;
  facets.insert(facets.end(), plc.interior.begin(), plc.interior.end());
  return facets;
}

std::vector<Edge> all_segments(const SmallPlc& plc) {
  std::set<Edge> edges(plc.segments.begin(), plc.segments.end());
  for (const Polygon& facet : all_facets(plc))
    for (std::size_t i = 0; i < facet.size(); ++i) edges.insert(edge_of(facet[i], facet[(i + 1) % facet.size()]));
  return {edges.begin(), edges.end()};
}

std::int64_t six_volumes(const SmallPlc& plc) {
  std::int64_t sum = 0;
  for (const Polygon& facet : plc.boundary) sum += dot(area_vector(plc, facet), plc.vertices[facet[0]]);
  return sum;
}

bool is_inside(const SmallPlc& plc, const std::vector<Vertex>& simplex) {
  Point sum;
  for (const Vertex v : simplex) sum = sum + plc.vertices[v];
  return is_inside_scaled(plc, sum, static_cast<std::int64_t>(simplex.size()));
}

bool is_generic(const SmallPlc& plc, bool may_be_cospherical) {
  const auto& v = plc.vertices;
  const auto n = static_cast<Vertex>(v.size());
  for (Vertex a = 0; a < n; ++a)
    for (Vertex b = 0; b < a; ++b)
      for (Vertex c = 0; c < b; ++c)
        for (Vertex d = 0; d < c; ++d) {
          if (orientation(v[a], v[b], v[c], v[d]) == 0) {
            if (!is_within_a_facet(plc, {a, b, c, d})) return false;
            // Not on a circle either: with any other vertex that would be five on a sphere.
            for (Vertex e = 0; e < n; ++e)
              if (orientation(v[a], v[b], v[c], v[e]) != 0 && side_of_sphere(v[a], v[b], v[c], v[e], v[d]) == 0)
                return false;
            continue;
          }
          for (Vertex e = 0; e < d && !may_be_cospherical; ++e)
            if (side_of_sphere(v[a], v[b], v[c], v[d], v[e]) == 0) return false;
        }
  return true;
}

bool is_valid(const SmallPlc& plc) {
  if (!is_one_surface(plc.boundary)) return false;
  const auto& v = plc.vertices;
  const std::vector<Edge> segments = all_segments(plc);
  for (const Polygon& facet : all_facets(plc)) {
    if (std::ranges::any_of(segments, [&](const Edge& edge) { return is_diagonal(facet, edge); })) return false;
    for (const auto& [a, b, c] : triangles_of(plc, facet))
      for (const auto& [p, q] : segments)
        if (pierces(v[p], v[q], v[a], v[b], v[c])) return false;
  }
  const auto is_in = [&](const auto& simplex) {
    return is_inside(plc, std::vector<Vertex>(simplex.begin(), simplex.end()));
  };
  if (six_volumes(plc) <= 0 || !std::ranges::all_of(plc.segments, is_in)) return false;
  return std::ranges::all_of(plc.interior, [&](const Polygon& f) { return is_in(triangles_of(plc, f).front()); });
}

plc::InputPlc as_input(const SmallPlc& plc) {
  plc::InputPlc input;
  input.name = "small PLC";
  input.inside = plc::InputPlc::Inside::seeds;
  for (const Point& p : plc.vertices)
    input.vertices.push_back({static_cast<double>(p.x), static_cast<double>(p.y), static_cast<double>(p.z)});
  for (const Polygon& facet : all_facets(plc)) {
    plc::PolygonFacet polygon;
    polygon.polygons = {facet};
    polygon.number = static_cast<std::uint32_t>(input.polygon_facets.size());
    input.polygon_facets.push_back(polygon);
  }
  input.segments = plc.segments;
  return input;
}

std::string in_words(const SmallPlc& plc) {
  std::ostringstream text;
  text << "vertices";
  for (const Point& p : plc.vertices) text << " (" << p.x << " " << p.y << " " << p.z << ")";
  text << "; boundary" << list_in_words(plc.boundary);
  if (!plc.interior.empty()) text << "; facets inside" << list_in_words(plc.interior);
  if (!plc.segments.empty()) text << "; segments" << list_in_words(plc.segments);
  return text.str();
}

}  // namespace ccdt::small_plcs
