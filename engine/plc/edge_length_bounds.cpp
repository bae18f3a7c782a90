#include "engine/plc/edge_length_bounds.h"

#include <cmath>
#include <cstdio>

#include "engine/base/box.h"
#include "engine/base/errors.h"

namespace ccdt::plc {
namespace {

/// Holes count as well, which does not matter for an order of magnitude.
double area_of(const InputPlc& input) {
  double twice = 0;
  const auto add = [&](const auto& polygon) {
    Point3 normal;
    for (std::size_t i = 2; i < polygon.size(); ++i) {
      const Point3& origin = input.vertices[polygon[0]];
      normal = normal + cross(input.vertices[polygon[i - 1]] - origin, input.vertices[polygon[i]] - origin);
    }
    twice += length(normal);
  };
  for (const auto& triangle : input.triangles) add(triangle);
  for (const PolygonFacet& facet : input.polygon_facets)
    for (const auto& polygon : facet.polygons) add(polygon);
  return twice / 2;
}

}  // namespace

void throw_too_many_vertices(double count, const std::string& file) {
  char text[32] = "far more than 2^32";
  if (count < 1e100) std::snprintf(text, sizeof text, "about %.2g", count);
  throw LimitError("the edge length is too short: the mesh would need " + std::string(text) + " vertices",
                   {.file = file}, "give a longer --edge-length or larger --sizes, in the units of the input");
}

double longest_edge(const InputPlc& input) {
  const Box box = bounding_box(input.vertices);
  return input.vertices.empty() ? 0 : length(box.high - box.low);
}

void check_edges_of_surface(const InputPlc& input, double edge_length) {
  // There are two triangles per vertex.
  const double area_per_vertex = std::sqrt(3) / 2 * edge_length * edge_length;
  const double count = area_of(input) / area_per_vertex;
  if (count > most_vertices) throw_too_many_vertices(count, input.name);
}

}  // namespace ccdt::plc
