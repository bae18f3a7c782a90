#include "engine/io/plc_formats.h"

namespace ccdt::io {

void write_off(const InputPlc& plc, OutputFile& out) {
  out << "OFF\n" << plc.vertices.size() << ' ' << plc.facet_count() << " 0\n";
  for (const Point3& p : plc.vertices) out << p.x << ' ' << p.y << ' ' << p.z << '\n';
  for (const FacetLoop& facet : facets_in_order(plc)) {
    out << facet.corners.size();
    for (const std::uint32_t v : facet.corners) out << ' ' << v;
    out << '\n';
  }
}

}  // namespace ccdt::io
