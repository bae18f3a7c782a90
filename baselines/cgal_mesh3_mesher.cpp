// Mesh_3 is by far the longest compilation of the project: nothing else belongs in this file.
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Mesh_complex_3_in_triangulation_3.h>
#include <CGAL/Mesh_criteria_3.h>
#include <CGAL/Mesh_triangulation_3.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polyhedral_complex_mesh_domain_3.h>
#include <CGAL/Random.h>
#include <CGAL/make_mesh_3.h>
#include <CGAL/version.h>

#include <chrono>
#include <map>
#include <unordered_map>
#include <utility>

#include "baselines/known_meshers.h"
#include "baselines/mesh_cleanup.h"
#include "baselines/mesher_input.h"
#include "engine/base/digits.h"
#include "engine/io/files.h"
#include "engine/plc/build_plc.h"

namespace ccdt::baselines {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Polyhedron = CGAL::Mesh_polyhedron_3<Kernel>::type;
using Domain = CGAL::Polyhedral_complex_mesh_domain_3<Kernel>;
using Triangulation = CGAL::Mesh_triangulation_3<Domain, CGAL::Default, CGAL::Sequential_tag>::type;
using Complex = CGAL::Mesh_complex_3_in_triangulation_3<Triangulation, Domain::Corner_index, Domain::Curve_index>;
using Criteria = CGAL::Mesh_criteria_3<Triangulation>;
namespace parameters = CGAL::parameters;

/// The bounds of the refinement. Sizes are circumradii; if the largest circumradius is the edge length, edges have
/// about that length on average.
struct Sizes {
  double feature_angle = 60;  ///< least angle between normals at a sharp edge, in degrees: the default of the library
  double edge, facet, facet_distance, cell;
  double facet_angle = 25, cell_radius_edge = 3;  ///< as in the manual of the library

  explicit Sizes(double edge_length)
      : edge(edge_length), facet(edge_length), facet_distance(edge_length / 10), cell(edge_length) {}
};

/// The triangles between two regions. All have the first region below and the second above; normals point upward.
struct Interface {
  std::vector<Kernel::Point_3> points;
  std::vector<std::array<std::size_t, 3>> triangles;
  std::unordered_map<std::uint32_t, std::size_t> index;

  std::size_t add(const plc::Plc& plc, VertexId v) {
    const auto [entry, is_new] = index.try_emplace(v.value, points.size());
    const Point3& p = plc.world[v];
    if (is_new) points.emplace_back(p.x, p.y, p.z);
    return entry->second;
  }
};

using SubdomainPair = std::pair<int, int>;  ///< subdomains below and above; 0 is outside

std::map<SubdomainPair, Interface> interfaces_of(const plc::Plc& plc) {
  const auto subdomain = [&](RegionId c) { return plc.regions[c].inside ? static_cast<int>(c.value) + 1 : 0; };
  std::map<SubdomainPair, Interface> interfaces;
  for (const plc::Facet& facet : plc.facets) {
    SubdomainPair sides{subdomain(facet.below), subdomain(facet.above)};
    if (sides.first == 0 && sides.second == 0) continue;  // in a hole
    const bool flip = sides.first < sides.second;
    if (flip) std::swap(sides.first, sides.second);
    Interface& interface = interfaces[sides];
    for (const auto& triangle : plc.triangles_of(facet)) {
      std::array<std::size_t, 3> corners{};
      for (std::size_t i = 0; i < 3; ++i) corners[i] = interface.add(plc, triangle[i]);
      if (flip) std::swap(corners[0], corners[1]);
      interface.triangles.push_back(corners);
    }
  }
  return interfaces;
}

Polyhedron polyhedron_of(Interface& interface) {
  namespace pmp = CGAL::Polygon_mesh_processing;
  // Splits vertices and edges where the interface is not a manifold.
  pmp::orient_polygon_soup(interface.points, interface.triangles);
  Polyhedron polyhedron;
  pmp::polygon_soup_to_polygon_mesh(interface.points, interface.triangles, polyhedron);
  return polyhedron;
}

/// Numbers the vertices of a triangulation in the order in which they are asked for.
class VertexNumbers {
 public:
  explicit VertexNumbers(TetMesh& mesh) : mesh_(mesh) {}

  std::uint32_t operator()(Triangulation::Vertex_handle v) {
    const auto [entry, is_new] = numbers_.try_emplace(&*v, static_cast<std::uint32_t>(mesh_.vertices.size()));
    const auto& p = v->point();
    if (is_new) mesh_.vertices.push_back({p.x(), p.y(), p.z()});
    return entry->second;
  }

 private:
  TetMesh& mesh_;
  std::unordered_map<const void*, std::uint32_t> numbers_;
};

TetMesh read_back(const Complex& complex, const plc::Plc& plc) {
  TetMesh mesh;
  VertexNumbers number(mesh);
  for (auto cell = complex.cells_in_complex_begin(); cell != complex.cells_in_complex_end(); ++cell) {
    mesh.tetrahedra.push_back(
        {number(cell->vertex(0)), number(cell->vertex(1)), number(cell->vertex(2)), number(cell->vertex(3))});
    mesh.regions.push_back(plc.regions[static_cast<std::size_t>(complex.subdomain_index(cell) - 1)].attribute);
  }
  for (auto facet = complex.facets_in_complex_begin(); facet != complex.facets_in_complex_end(); ++facet) {
    std::array<std::uint32_t, 3> corners{};
    for (int i = 0; i < 3; ++i)
      corners[static_cast<std::size_t>(i)] = number(facet->first->vertex((facet->second + 1 + i) % 4));
    mesh.faces.push_back(corners);
  }
  for (auto edge = complex.edges_in_complex_begin(); edge != complex.edges_in_complex_end(); ++edge)
    mesh.edges.push_back({number(edge->first->vertex(edge->second)), number(edge->first->vertex(edge->third))});
  mesh.face_markers.assign(mesh.faces.size(), 0);
  mesh.edge_markers.assign(mesh.edges.size(), 0);
  orient_positively(mesh);
  return mesh;
}

bool is_improved(const MeshOptions& options) {
  return improvement_of(options) != Improvement::none;
}

constexpr unsigned random_seed = 0;  ///< of the first points on the surface

MesherSettings settings_of_mesh3(const InputPlc& input, const MeshOptions& options) {
  const Sizes sizes(target_edge_length(input, options));
  const char* improved = is_improved(options) ? "on" : "off";
  return {{"domain", "Polyhedral_complex_mesh_domain_3"},
          {"feature_angle", digits(sizes.feature_angle)},
          {"edge_size", digits(sizes.edge)},
          {"facet_angle", digits(sizes.facet_angle)},
          {"facet_size", digits(sizes.facet)},
          {"facet_distance", digits(sizes.facet_distance)},
          {"cell_radius_edge_ratio", digits(sizes.cell_radius_edge)},
          {"cell_size", digits(sizes.cell)},
          {"random_seed", std::to_string(random_seed)},
          {"lloyd", "off"},
          {"odt", "off"},
          {"perturb", improved},
          {"exude", improved}};
}

Complex refine(const std::map<SubdomainPair, Interface>& interfaces, const Sizes& sizes, bool improve) {
  std::vector<Polyhedron> polyhedra;
  std::vector<SubdomainPair> sides;
  for (auto [key, interface] : interfaces) {
    polyhedra.push_back(polyhedron_of(interface));
    sides.push_back(key);
  }
  Domain domain(polyhedra.begin(), polyhedra.end(), sides.begin(), sides.end());
  domain.detect_features(sizes.feature_angle);
  const Criteria criteria(parameters::edge_size = sizes.edge, parameters::facet_angle = sizes.facet_angle,
                          parameters::facet_size = sizes.facet, parameters::facet_distance = sizes.facet_distance,
                          parameters::cell_radius_edge_ratio = sizes.cell_radius_edge,
                          parameters::cell_size = sizes.cell);
  // Perturbation and exudation improve the finished mesh, so they are on if our engine's improvement is on.
  return CGAL::make_mesh_3<Complex>(domain, criteria, improve ? parameters::perturb() : parameters::no_perturb(),
                                    improve ? parameters::exude() : parameters::no_exude());
}

MesherRun run_cgal_mesh3(const InputPlc& input, const MeshOptions& options, const Progress& progress) {
  const plc::Plc plc = plc::build_plc(input, {.flatness = options.flatness});
  const auto interfaces = interfaces_of(plc);
  const Sizes sizes(target_edge_length(input, options));
  MesherRun run;
  run.settings = settings_of_mesh3(input, options);
  run.notes = {"the surface is remeshed: it approximates the triangles of the input and does not keep them"};
  report(progress, "mesh_3", 0, 0);
  CGAL::get_default_random() =
      CGAL::Random(random_seed);  // otherwise its seed is the time, and every mesh is different
  const auto begin = std::chrono::steady_clock::now();
  const Complex complex = refine(interfaces, sizes, is_improved(options));
  run.result.costs.mesh_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();

  run.result.mesh = read_back(complex, plc);
  if (run.result.mesh.tetrahedra.empty())
    throw MeshError("Mesh_3 made no tetrahedra at this edge length", io::place_in(input.name),
                    "choose a smaller --edge-length");
  run.result.counts = count_elements(input, run.result.mesh);
  return run;
}

}  // namespace

Mesher cgal_mesh3_mesher() {
  return {.name = "cgal-mesh3",
          .version = CGAL_VERSION_STR,
          .what = "CGAL Mesh_3: Delaunay refinement that approximates the surface",
          .license = "GPL-3.0-or-later",
          .run = run_cgal_mesh3,
          .settings = settings_of_mesh3,
          .keeps_surface = false,
          .options = {{.name = "edge-length"}, {.name = "flatness"}, {.name = "improve", .only_none = true}}};
}

}  // namespace ccdt::baselines
