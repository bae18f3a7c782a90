#include "engine/io/plc_formats.h"

namespace ccdt::io {

void write_obj(const InputPlc& plc, OutputFile& out) {
  for (const Point3& p : plc.vertices) out << "v " << p.x << ' ' << p.y << ' ' << p.z << '\n';
  int group = 0;
  for (const FacetLoop& facet : facets_in_order(plc)) {
    if (facet.marker != group) {
      group = facet.marker;
      out << "g " << group << '\n';
    }
    out << 'f';
    for (const std::uint32_t v : facet.corners) out << ' ' << v + 1;
    out << '\n';
  }
}

}  // namespace ccdt::io
