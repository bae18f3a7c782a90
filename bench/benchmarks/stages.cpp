#include "bench/benchmarks/stages.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <utility>

#include "engine/facets/facet_mesh.h"
#include "engine/front/advance_front.h"
#include "engine/front/find_delaunay_faces.h"
#include "engine/io/plc_files.h"
#include "engine/label/label_cells.h"
#include "engine/mesh/assemble_mesh.h"
#include "engine/plc/build_plc.h"
#include "engine/protection/make_room.h"
#include "models/flatten.h"
#include "models/solids.h"

namespace ccdt::benchmarks {
namespace {

/// The edge lengths, in millimeters, that give the models their `model_sizes`.
constexpr std::array<std::array<double, model_sizes.size()>, model_names.size()> edge_lengths = {
    {{3.85, 3.05, 2.4, 1.87, 1.47}, {3.0, 2.3, 1.82, 1.4, 1.11}, {2.95, 2.29, 1.8, 1.43, 1.13}}};

/// Of z, in flattened models.
constexpr double flattening = 0.3;

double edge_length_of(const std::string& model, std::int64_t size) {
  const auto name = static_cast<std::size_t>(std::ranges::find(model_names, model) - model_names.begin());
  const auto place = static_cast<std::size_t>(std::ranges::find(model_sizes, size) - model_sizes.begin());
  return edge_lengths.at(name).at(place);
}

/// How far apart the interior points are.
struct Density {
  double edge_length;  ///< units of the input; 0: that of the surface
  double grading;
};

LatticeInput lattice_input(const plc::Plc& plc, const protection::ProtectedDelaunay& surface,
                           const facets::FacetMesh& facets, const Density& density) {
  LatticeInput input;
  input.vertices = points_of(surface.delaunay);
  for (std::size_t i = 0; i < facets.triangles.size(); ++i) {
    const plc::Facet& facet = plc.facets[facets.facet[i]];
    input.triangles.push_back({facets.triangles[i], plc.regions[facet.above].inside, plc.regions[facet.below].inside});
  }
  input.subsegments = surface.chains.pieces();
  input.options.edge_length = density.edge_length / plc.grid.unit;
  input.options.grading = density.grading;
  return input;
}

Stages make_stages(const plc::InputPlc& input, const Density& density) {
  Stages s;
  s.plc = plc::build_plc(input);
  s.input_delaunay = delaunay::build_delaunay(s.plc.vertices);
  protection::ProtectedDelaunay surface =
      protection::protect_edges(s.plc, protection::unprotected(s.plc, s.input_delaunay), protection::Protection::shell);
  s.facets = facets::triangulate_facets(s.plc, surface.chains, surface.delaunay);
  s.lattice = lattice_input(s.plc, surface, s.facets, density);
  lattice::LatticePoints points = lattice::place_lattice_points(
      {s.lattice.vertices, s.lattice.triangles, s.lattice.subsegments}, s.lattice.options);
  keep_only(
      make_room(points.points, s.plc, protection::Protection::shell, surface, protection::Avoided::smallest_spheres),
      points);
  s.first_interior = surface.delaunay.vertices.size();
  s.chains = std::move(surface.chains);
  s.facets = facets::triangulate_facets(s.plc, s.chains, surface.delaunay);  // edges may have been split
  s.delaunay = std::move(surface.delaunay);
  insert_points(s.delaunay, points.points, points.later_rounds);
  s.codes = front::find_delaunay_faces(s.facets.triangles, s.delaunay);
  if (facets::follow_interior_vertices(s.plc, s.chains, s.delaunay, s.codes, s.facets))
    s.codes = front::find_delaunay_faces(s.facets.triangles, s.delaunay);
  s.front = front::advance_front({s.plc, s.facets, s.codes, s.delaunay});
  const RawVector<RegionId> regions = label::label_cells(s.plc, s.delaunay, s.front.open, s.codes);
  s.tetrahedra = sorted(
      mesh::collect_tetrahedra(s.plc, s.front, regions, s.delaunay.cells, s.delaunay.vertices.size()).mesh.tetrahedra);
  return s;
}

using Cache = std::map<std::pair<std::string, std::int64_t>, std::unique_ptr<const Stages>>;

}  // namespace

const Stages& stages_of_model(const std::string& model, bool flattened, std::int64_t size) {
  static Cache made[2];
  auto& stages = made[flattened][{model, size}];
  if (!stages) {
    double edge_length = edge_length_of(model, size);
    plc::InputPlc plc = models::make_solid(model, edge_length);
    if (flattened) {
      models::flatten(plc, flattening);
      edge_length *= std::cbrt(flattening);  // as many vertices in less space
    }
    stages = std::make_unique<const Stages>(make_stages(plc, {edge_length, 0}));
  }
  return *stages;
}

const Stages& stages_of_file(const std::filesystem::path& file) {
  static Cache made;
  auto& stages = made[{file.string(), 0}];
  if (!stages)
    stages = std::make_unique<const Stages>(make_stages(io::read_plc(file), {0, lattice::LatticeOptions().grading}));
  return *stages;
}

Tetrahedra sorted(Tetrahedra tetrahedra) {
  for (auto& t : tetrahedra) std::ranges::sort(t);
  std::ranges::sort(tetrahedra);
  return tetrahedra;
}

Tetrahedra finite_cells(const delaunay::Delaunay& delaunay) {
  Tetrahedra cells;
  for (std::uint32_t c = 0; c < delaunay.cells.size(); ++c)
    if (delaunay.is_finite(c)) cells.push_back(delaunay.cells[c].vertices);
  return cells;
}

double volume_of(const Tetrahedra& tetrahedra, const std::vector<Point3>& points) {
  double six_volumes = 0;
  for (const auto& [a, b, c, d] : tetrahedra) {
    const Point3& origin = points[a];
    six_volumes += dot(points[d] - origin, cross(points[b] - origin, points[c] - origin));
  }
  return six_volumes / 6;
}

}  // namespace ccdt::benchmarks
