#include <bit>

#include "engine/io/plc_formats.h"

namespace ccdt::io {

static_assert(std::endian::native == std::endian::little, "values are written as they are in memory");

void write_ply(const InputPlc& plc, OutputFile& out) {
  const std::vector<FacetLoop> facets = facets_in_order(plc);
  bool short_lists = true, markers = false;
  for (const FacetLoop& facet : facets) {
    short_lists = short_lists && facet.corners.size() <= 255;
    markers = markers || facet.marker != 0;
  }
  out << "ply\nformat binary_little_endian 1.0\ncomment ccdt\nelement vertex " << plc.vertices.size()
      << "\nproperty double x\nproperty double y\nproperty double z\nelement face " << facets.size()
      << "\nproperty list " << (short_lists ? "uchar" : "uint") << " uint vertex_indices\n"
      << (markers ? "property int marker\n" : "") << "end_header\n";
  for (const Point3& p : plc.vertices) out.raw(p.x).raw(p.y).raw(p.z);
  for (const FacetLoop& facet : facets) {
    if (short_lists)
      out.raw(static_cast<std::uint8_t>(facet.corners.size()));
    else
      out.raw(static_cast<std::uint32_t>(facet.corners.size()));
    for (const std::uint32_t v : facet.corners) out.raw(v);
    if (markers) out.raw(facet.marker);
  }
}

}  // namespace ccdt::io
