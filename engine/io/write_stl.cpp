#include <cfloat>
#include <cmath>

#include "engine/base/errors.h"
#include "engine/io/plc_formats.h"

namespace ccdt::io {

namespace {

void write_vector(const Point3& p, OutputFile& out) {
  out.raw(static_cast<float>(p.x)).raw(static_cast<float>(p.y)).raw(static_cast<float>(p.z));
}

Point3 unit_normal(const Point3& a, const Point3& b, const Point3& c) {
  const Point3 normal = cross(b - a, c - a);
  const double length = std::sqrt(squared_length(normal));
  return length > 0 && std::isfinite(length) ? (1 / length) * normal : Point3{};
}

void check_range(const InputPlc& plc) {
  for (const Point3& p : plc.vertices)
    if (std::fabs(p.x) > FLT_MAX || std::fabs(p.y) > FLT_MAX || std::fabs(p.z) > FLT_MAX) {
      Place place;
      place.points = {as_array(p)};
      throw OutputError("STL holds numbers of single precision; a coordinate is too large", std::move(place),
                        "write a .off, .ply or .poly file instead");
    }
}

}  // namespace

void write_stl(const InputPlc& plc, OutputFile& out) {
  check_range(plc);
  std::string header = "binary STL by ccdt";  // must not begin with `solid`
  header.resize(80, ' ');
  const std::vector<FacetLoop> facets = facets_in_order(plc);
  out << header;
  out.raw(static_cast<std::uint32_t>(facets.size()));
  for (const FacetLoop& facet : facets) {
    const Point3 &a = plc.vertices[facet.corners[0]], &b = plc.vertices[facet.corners[1]],
                 &c = plc.vertices[facet.corners[2]];
    write_vector(unit_normal(a, b, c), out);
    for (const Point3* corner : {&a, &b, &c}) write_vector(*corner, out);
    out.raw(std::uint16_t{0});
  }
}

}  // namespace ccdt::io
