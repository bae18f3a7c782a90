#include "engine/plc/edge_length_bounds.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "engine/base/box.h"
#include "engine/base/errors.h"

namespace ccdt::plc {
namespace {

/// The area of all polygons. Holes are included, which is fine for an order of magnitude.
///
/// \param unit  of length
double area_of(const InputPlc& input, double unit) {
  double twice = 0;
  const auto add = [&](const auto& polygon) {
    Point3 normal;
    for (std::size_t i = 2; i < polygon.size(); ++i) {
      const Point3& origin = input.vertices[polygon[0]];
      normal = normal + cross((1 / unit) * (input.vertices[polygon[i - 1]] - origin),
                              (1 / unit) * (input.vertices[polygon[i]] - origin));
    }
    twice += length(normal);
  };
  for (const auto& triangle : input.triangles) add(triangle);
  for (const PolygonFacet& facet : input.polygon_facets)
    for (const auto& polygon : facet.polygons) add(polygon);
  return twice / 2;
}

/// For messages: two digits, and no exponent.
std::string rounded_count(double count) {
  const double unit = std::pow(10, std::max(0.0, std::floor(std::log10(std::max(1.0, count))) - 1));
  char text[64];
  std::snprintf(text, sizeof text, "%.0f", unit * std::round(count / unit));
  return text;
}

}  // namespace

void throw_too_many_tetrahedra(double estimate) {
  throw LimitError("the mesh would have about " + rounded_count(estimate) + " tetrahedra, more than allowed", {},
                   "give longer edges, or allow more tetrahedra");
}

void throw_too_many_vertices(double count, const std::string& file) {
  char text[32] = "far more than 2^32";
  if (count < 1e100) std::snprintf(text, sizeof text, "about %.2g", count);
  throw LimitError("the edge length is too short: the mesh would need " + std::string(text) + " vertices",
                   {.file = file}, "give a longer --edge-length or larger --sizes, in the units of the input");
}

double longest_edge(const InputPlc& input) {
  if (input.vertices.empty()) return 0;
  const Box box = bounding_box(input.vertices);
  const Point3 diagonal = box.high - box.low;
  // Squares of the smallest and largest numbers underflow or overflow.
  int exponent = 0;
  std::frexp(std::max({diagonal.x, diagonal.y, diagonal.z}), &exponent);
  const auto scaled = [&](double x) { return std::ldexp(x, -exponent); };
  return std::ldexp(length({scaled(diagonal.x), scaled(diagonal.y), scaled(diagonal.z)}), exponent);
}

void check_edges_of_surface(const InputPlc& input, double edge_length, double most_triangles) {
  // There are two triangles per vertex.
  const double area_per_vertex = std::sqrt(3) / 2;
  const double count = area_of(input, edge_length) / area_per_vertex;
  if (!(count <= most_vertices)) throw_too_many_vertices(count, input.name);
  if (most_triangles > 0 && 2 * count > most_triangles)
    throw LimitError("the surface alone would have about " + rounded_count(2 * count) +
                         " triangles, more than the tetrahedra that are allowed",
                     {.file = input.name}, "give longer edges, or allow more tetrahedra");
}

}  // namespace ccdt::plc
