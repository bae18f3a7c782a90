#include "engine/io/plc_formats.h"
#include "engine/io/tetgen_parts.h"

namespace ccdt::io {

namespace {

void write_head(const InputPlc& plc, OutputFile& out) {
  if (plc.inside == InputPlc::Inside::even_odd) out << even_odd_claim << '\n';
  write_tetgen_nodes(plc.vertices, out);
  out << plc.facet_count() + plc.segments.size() << " 1\n";
}

void write_corners(std::span<const std::uint32_t> corners, OutputFile& out) {
  out << corners.size();
  for (const std::uint32_t v : corners) out << ' ' << v + 1;
}

void write_point(std::size_t number, const Point3& p, OutputFile& out) {
  out << number << ' ' << p.x << ' ' << p.y << ' ' << p.z;
}

int segment_marker(const InputPlc& plc, std::size_t i) {
  return plc.segment_markers.empty() ? 0 : plc.segment_markers[i];
}

void write_seeds(const InputPlc& plc, OutputFile& out) {
  out << plc.holes.size() << '\n';
  for (std::size_t i = 0; i < plc.holes.size(); ++i) {
    write_point(i + 1, plc.holes[i], out);
    out << '\n';
  }
  out << plc.regions.size() << '\n';
  for (std::size_t i = 0; i < plc.regions.size(); ++i) {
    const InputPlc::RegionSeed& region = plc.regions[i];
    write_point(i + 1, region.seed, out);
    out << ' ' << region.attribute << ' ';
    if (region.max_volume > 0)
      out << region.max_volume;
    else
      out << -1;
    out << '\n';
  }
}

void write_poly_facet(const FacetLoop& facet, OutputFile& out) {
  if (!facet.polygon) {
    out << "1 0 " << facet.marker << '\n';
    write_corners(facet.corners, out);
    out << '\n';
    return;
  }
  out << facet.polygon->polygons.size() << ' ' << facet.polygon->holes.size() << ' ' << facet.marker << '\n';
  for (const auto& polygon : facet.polygon->polygons) {
    write_corners(polygon, out);
    out << '\n';
  }
  for (std::size_t i = 0; i < facet.polygon->holes.size(); ++i) {
    write_point(i + 1, facet.polygon->holes[i], out);
    out << '\n';
  }
}

}  // namespace

void write_poly(const InputPlc& plc, OutputFile& out) {
  write_head(plc, out);
  for (const FacetLoop& facet : facets_in_order(plc)) write_poly_facet(facet, out);
  for (std::size_t i = 0; i < plc.segments.size(); ++i) {
    out << "1 0 " << segment_marker(plc, i) << '\n';
    write_corners(plc.segments[i], out);
    out << '\n';
  }
  write_seeds(plc, out);
}

void write_smesh(const InputPlc& plc, OutputFile& out) {
  write_head(plc, out);
  for (const FacetLoop& facet : facets_in_order(plc)) {
    write_corners(facet.corners, out);
    out << ' ' << facet.marker << '\n';
  }
  for (std::size_t i = 0; i < plc.segments.size(); ++i) {
    write_corners(plc.segments[i], out);
    out << ' ' << segment_marker(plc, i) << '\n';
  }
  write_seeds(plc, out);
}

}  // namespace ccdt::io
