#include "engine/mesh/assemble_mesh.h"

#include <algorithm>
#include <cmath>

#include "engine/mesh/peel_flat_tetrahedra.h"

namespace ccdt {
namespace {

double determinant(const Point3& a, const Point3& b, const Point3& c) {
  return dot(a, cross(b, c));
}

/// Six times the volume that the facets enclose, by the divergence theorem.
double volume_within(const Plc& plc, const FacetMesh& facets, const Delaunay& d) {
  double volume = 0;
  for (std::size_t i = 0; i < facets.triangles.size(); ++i) {
    const Facet& facet = plc.facets[facets.facet[i]];
    const int outward = (plc.regions[facet.below].inside ? 1 : 0) - (plc.regions[facet.above].inside ? 1 : 0);
    const auto& t = facets.triangles[i];
    if (outward != 0) volume += outward * determinant(d.point(t[0]), d.point(t[1]), d.point(t[2]));
  }
  return volume;
}

/// \return the facet of each face
std::vector<std::uint32_t> add_faces_and_edges(const Plc& plc, const SegmentChains& chains, const FacetMesh& facets,
                                               TetMesh& mesh) {
  std::vector<std::uint32_t> facet_of_face;
  for (std::size_t i = 0; i < facets.triangles.size(); ++i) {
    const Facet& facet = plc.facets[facets.facet[i]];
    if (!plc.regions[facet.above].inside && !plc.regions[facet.below].inside) continue;
    const auto& t = facets.triangles[i];
    mesh.faces.push_back({t[0], t[1], t[2]});
    mesh.face_markers.push_back(facet.marker);
    facet_of_face.push_back(facets.facet[i]);
  }
  for (std::size_t s = 0; s < chains.size(); ++s) {
    for (std::size_t i = 0; i + 1 < chains[s].size(); ++i) {
      mesh.edges.push_back({chains[s][i].vertex, chains[s][i + 1].vertex});
      mesh.edge_markers.push_back(plc.segments[s].marker);
    }
  }
  return facet_of_face;
}

}  // namespace

std::optional<MeshError> check_volume(const Plc& plc, const FacetMesh& facets, const Delaunay& d, const TetMesh& mesh) {
  double filled = 0;
  for (const auto& t : mesh.tetrahedra) {
    const Point3& a = d.point(t[0]);
    filled += determinant(d.point(t[1]) - a, d.point(t[2]) - a, d.point(t[3]) - a);
  }
  const double wanted = volume_within(plc, facets, d);
  if (std::fabs(filled - wanted) <= 1e-7 * std::fabs(wanted)) return {};
  Place place;
  place.file = plc.name;
  return MeshError("the tetrahedra do not fill the domain", place,
                   "some facets are almost but not quite flat: try another --flatness");
}

TetMesh collect_tetrahedra(const Plc& plc, const FrontResult& front, const std::vector<RegionId>& region_of_cell,
                           const Delaunay& delaunay) {
  TetMesh mesh;
  const auto outside = std::ranges::count(region_of_cell, RegionId());
  const std::size_t size = front.tetrahedra.size() + region_of_cell.size() - static_cast<std::size_t>(outside);
  mesh.tetrahedra.reserve(size);
  mesh.regions.reserve(size);
  mesh.tetrahedra = front.tetrahedra;
  for (const RegionId region : front.regions) mesh.regions.push_back(plc.regions[region].attribute);
  for (std::uint32_t c = 0; c < delaunay.cells.size(); ++c) {
    if (region_of_cell[c].is_none()) continue;
    mesh.tetrahedra.push_back(delaunay.cells[c].vertices);
    mesh.regions.push_back(plc.regions[region_of_cell[c]].attribute);
  }
  return mesh;
}

std::vector<std::uint32_t> finish_mesh(const Plc& plc, const SegmentChains& chains, FacetMesh facets, TetMesh& mesh) {
  peel_flat_tetrahedra(plc, chains, facets, mesh);
  mesh.constrained_delaunay = true;
  return add_faces_and_edges(plc, chains, facets, mesh);
}

}  // namespace ccdt
