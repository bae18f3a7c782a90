#include "engine/lattice/place_lattice_points.h"

#include <cmath>

#include "engine/base/errors.h"
#include "engine/lattice/clear_surface.h"
#include "engine/lattice/size_field.h"

namespace ccdt::lattice {

namespace {

constexpr std::string_view stage = "lattice";
constexpr double most_vertices = 4294967295.0;  ///< ids of 32 bits, of which one means none

[[noreturn]] void throw_too_many_points() {
  throw LimitError("the edge length asks for more than 2^32 - 1 vertices", {},
                   "ask for a greater edge length, or greater sizes; they are in the units of the input");
}

/// By the divergence theorem.
double volume_inside(const DomainSurface& surface) {
  if (surface.triangles.empty()) return 0;
  const Point3 origin = surface.vertices[surface.triangles[0].vertices[0]];
  double volume = 0;
  for (std::uint32_t t = 0; t < surface.triangles.size(); ++t) {
    const auto& triangle = surface.triangles[t];
    const auto [a, b, c] = surface.corners(t);
    const double six_volumes = dot(cross(a - origin, b - origin), c - origin);
    volume += six_volumes / 6 * (int{triangle.inside_below} - int{triangle.inside_above});
  }
  return volume;
}

/// Before memory is asked for. The lattice is nowhere coarser than the greatest target.
void check_number(const DomainSurface& surface, const SizeField& size) {
  const double points = std::sqrt(2.0) * volume_inside(surface) / std::pow(size.largest(), 3);
  if (points > most_vertices) throw_too_many_points();
}

}  // namespace

std::vector<Point3> place_lattice_points(const DomainSurface& surface, const LatticeOptions& options,
                                         const Progress& progress) {
  if (options.kind == Lattice::none || surface.triangles.empty()) return {};
  constexpr std::uint64_t steps = 4;
  report(progress, stage, 0, steps);
  const SizeField size(surface, options.edge_length, options.grading, options.background);
  check_number(surface, size);
  const Octree tree = build_octree(surface, size, options.kind);
  report(progress, stage, 1, steps);
  const std::vector<Site> sites = list_sites(tree, options.kind);
  report(progress, stage, 2, steps);
  const std::vector<bool> stays = find_clear_sites(tree, surface, sites, options);
  report(progress, stage, 3, steps);

  std::vector<Point3> points;
  for (std::size_t i = 0; i < sites.size(); ++i) {
    if (!stays[i]) continue;
    const auto coordinates = coordinates_of(sites[i]);
    const OctreeNode& leaf = tree.leaf_at(coordinates);
    if (leaf.place == NodePlace::outside) continue;
    const Point3 p = tree.point(coordinates);
    if (leaf.place == NodePlace::inside || is_inside(tree, surface, p, leaf)) points.push_back(p);
  }
  if (static_cast<double>(surface.vertices.size() + points.size()) > most_vertices) throw_too_many_points();
  report(progress, stage, steps, steps);
  return points;
}

}  // namespace ccdt::lattice
