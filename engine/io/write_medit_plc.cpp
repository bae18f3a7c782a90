#include "engine/io/medit_parts.h"
#include "engine/io/plc_formats.h"

namespace ccdt::io {

void write_medit_plc(const InputPlc& plc, OutputFile& out) {
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<std::array<std::uint32_t, 4>> quadrilaterals;
  std::vector<int> triangle_references, quadrilateral_references;
  for (const FacetLoop& facet : facets_in_order(plc)) {
    const auto& c = facet.corners;
    if (c.size() == 3) {
      triangles.push_back({c[0], c[1], c[2]});
      triangle_references.push_back(facet.marker);
    } else {
      quadrilaterals.push_back({c[0], c[1], c[2], c[3]});
      quadrilateral_references.push_back(facet.marker);
    }
  }
  write_medit_head(plc.inside == InputPlc::Inside::even_odd ? even_odd_claim : "", plc.vertices, out);
  write_medit_elements<2>("Edges", plc.segments, plc.segment_markers, out);
  write_medit_elements<3>("Triangles", triangles, triangle_references, out);
  write_medit_elements<4>("Quadrilaterals", quadrilaterals, quadrilateral_references, out);
  out << "\nEnd\n";
}

}  // namespace ccdt::io
