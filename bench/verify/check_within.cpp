#include "bench/verify/check_within.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>
#include <utility>

#include "bench/verify/edit_surface.h"
#include "bench/verify/findings.h"
#include "bench/verify/piece_tree.h"
#include "engine/base/digits.h"
#include "engine/base/union_find.h"
#include "engine/geometry/surface_distance.h"
#include "engine/plc/facet_triangles.h"

namespace ccdt::verify {
namespace {

/// Is a face of the mesh on its boundary, between two regions, or listed?
bool is_facet(const Topology& topology, std::uint32_t face) {
  if (topology.on_boundary(face) || topology.listed[face]) return true;
  const auto& [one, other] = topology.half_faces[face];
  const auto& regions = topology.mesh.regions;
  return !regions.empty() && regions[one / 4] != regions[other / 4];
}

std::vector<TrianglePoints> facets_of_mesh(const Topology& topology) {
  std::vector<TrianglePoints> triangles;
  for (std::uint32_t f = 0; f < topology.face_count(); ++f) {
    if (!is_facet(topology, f)) continue;
    const auto& [a, b, c] = vertices_of_face(topology, f);
    triangles.push_back({topology.mesh.vertices[a], topology.mesh.vertices[b], topology.mesh.vertices[c]});
  }
  return triangles;
}

/// The triangles of the input's facets that bound the domain or are within it. A facet may be so only in parts.
std::vector<TrianglePoints> facets_of_input(const plc::InputPlc& input, const Surface& surface,
                                            const Regions& regions) {
  std::unordered_map<std::uint32_t, std::vector<std::uint32_t>> pieces;  // of each facet
  for (std::uint32_t p = 0; p < surface.pieces(); ++p) pieces[surface.number[p]].push_back(p);
  plc::FacetTriangles all = plc::facet_triangles(input);
  std::vector<TrianglePoints> triangles;
  for (std::size_t i = 0; i < all.corners.size(); ++i) {
    const auto found = pieces.find(all.numbers[i]);
    if (found == pieces.end()) continue;
    const Point3 center = (1.0 / 3) * (all.corners[i][0] + all.corners[i][1] + all.corners[i][2]);
    const bool is_whole = found->second.size() == 1;
    if (std::ranges::any_of(found->second, [&](std::uint32_t p) {
          return regions.touches_inside(p) && (is_whole || locate_on_piece(surface, p, center) != PointOnPiece::off);
        }))
      triangles.push_back(all.corners[i]);
  }
  return triangles;
}

/// The parts into which faces divide the tetrahedra: a tetrahedron of each.
template <class Divides>
std::vector<std::uint32_t> parts_of_mesh(const Topology& topology, const Divides& divides) {
  UnionFind parts(topology.mesh.tetrahedra.size());
  for (std::uint32_t f = 0; f < topology.face_count(); ++f)
    if (const auto& [one, other] = topology.half_faces[f]; other != none && !divides(f)) parts.join(one / 4, other / 4);
  std::vector<std::uint32_t> first;
  for (std::uint32_t t = 0; t < topology.mesh.tetrahedra.size(); ++t)
    if (parts.find(t) == t) first.push_back(t);
  return first;
}

/// How many spaces the surface leaves outside of the domain, if the domain has so many parts.
std::size_t spaces_outside(const plc::InputPlc& input, const Surface& surface, std::size_t parts) {
  return find_regions(input, surface).count() - parts;
}

std::size_t spaces_outside_of_mesh(const plc::InputPlc& boundary, const Topology& topology) {
  const Tolerances tolerances = find_tolerances(boundary, 0);
  Surface surface = find_surface(boundary, match_sites(boundary, topology, tolerances), tolerances);
  embed_lines(surface);
  const auto parts = parts_of_mesh(topology, [](std::uint32_t) { return false; });
  return spaces_outside(boundary, surface, parts.size());
}

/// The surface without the pieces that do not touch the domain.
Surface bounding(const Surface& surface, const Regions& regions) {
  Pieces kept;
  for (std::uint32_t p = 0; p < surface.pieces(); ++p)
    if (regions.touches_inside(p)) kept.add(surface.edges_of(p), surface.marker[p], surface.number[p]);
  Surface result = surface;
  set_pieces(std::move(kept), result);
  return result;
}

/// " around (x, y, z) (x, y, z) ..." for the first few.
std::string places(const std::vector<Point3>& points) {
  std::string words = " around";
  for (std::size_t i = 0; i < std::min(points.size(), kept_failures); ++i) words += " " + text(points[i]);
  return words;
}

/// The mesh has as many parts as the domain of the input.
Check check_parts(const Surface& surface, const Regions& regions, const Topology& topology,
                  const std::vector<std::uint32_t>& parts) {
  std::vector<Point3> of_input, of_mesh;
  std::vector<char> seen(regions.count(), 0);
  for (std::uint32_t side = 0; side < regions.of_side.size(); ++side) {
    const std::uint32_t region = regions.of_side[side];
    if (regions.inside[region] == Inside::yes && std::exchange(seen[region], 1) == 0)
      of_input.push_back(surface.origin(side / 2));
  }
  for (const std::uint32_t t : parts) of_mesh.push_back(topology.mesh.vertices[topology.mesh.tetrahedra[t][0]]);
  Check check{.name = "parts of the domain", .checked = of_input.size()};
  if (of_mesh.size() == of_input.size()) return check;
  fail(check, [&] {
    return "the input has " + std::to_string(of_input.size()) + places(of_input) + "; the mesh has " +
           std::to_string(of_mesh.size()) + places(of_mesh);
  });
  return check;
}

/// Outside of both, there are as many spaces: that which reaches infinity, and the holes.
Check check_spaces(std::size_t of_input, std::size_t of_mesh) {
  Check check{.name = "spaces outside", .checked = of_input};
  if (of_input != of_mesh)
    fail(check, [&] {
      return "outside of the input there are " + std::to_string(of_input) + ", outside of the mesh " +
             std::to_string(of_mesh);
    });
  return check;
}

/// The faces between two regions are listed, if the mesh lists faces.
Check check_faces_between_regions(const Topology& topology) {
  Check check{.name = "faces between regions"};
  if (topology.mesh.faces.empty()) return check;
  for (std::uint32_t f = 0; f < topology.face_count(); ++f) {
    if (topology.on_boundary(f) || !is_facet(topology, f)) continue;
    ++check.checked;
    if (!topology.listed[f])
      fail(check, [&] {
        return "the face" + text(topology.mesh.vertices, vertices_of_face(topology, f)) +
               " is between two regions, but not listed";
      });
  }
  return check;
}

/// No point of one surface is farther from the other than the limit.
///
/// \param distance  gets the bound
Check check_distance(std::string name, const std::vector<TrianglePoints>& from, const std::vector<TrianglePoints>& to,
                     double limit, double& distance) {
  Check check{.name = std::move(name), .checked = 1};
  if (from.empty() || to.empty()) {
    if (from.size() != to.size()) fail(check, [] { return std::string("one of the two has no facets"); });
    return check;
  }
  const NearestTriangle nearest(to);
  FarthestPoint farthest = farthest_point(from, nearest, {.absolute = 1e-3 * limit});
  if (farthest.bound > limit && farthest.reached <= limit)  // too near to the limit for a bound
    farthest = farthest_point(from, nearest, {.relative = 1.0001, .absolute = limit});
  distance = farthest.bound;
  if (farthest.bound > limit)
    fail(check, [&] {
      return "the point " + text(farthest.at) + " is " + digits(farthest.reached) + " away, more than " + digits(limit);
    });
  return check;
}

double area_of_boundary(const plc::InputPlc& boundary) {
  double area = 0;
  for (const auto& [a, b, c] : boundary.triangles)
    area += 0.5 * length(ccdt::area_vector({boundary.vertices[a], boundary.vertices[b], boundary.vertices[c]}));
  return area;
}

double area_of_boundary(const Surface& surface, const Regions& regions) {
  double area = 0;
  for (std::uint32_t p = 0; p < surface.pieces(); ++p)
    if (regions.of_side[2 * p] != regions.of_side[2 * p + 1] && regions.touches_inside(p))
      area += length(surface.area_vector[p]);
  return area;
}

/// The volumes differ at most by a layer of this thickness on the boundary.
Check check_volumes(double thickness, double area, const Verification& result) {
  Check check{.name = "volume", .checked = 1};
  const double difference = std::fabs(result.mesh_volume - result.input_volume);
  if (difference > thickness * area + 1e-9 * std::fabs(result.input_volume))
    fail(check,
         [&] { return "the volumes differ by " + digits(difference) + ", more than " + digits(thickness * area); });
  return check;
}

}  // namespace

void check_within(const plc::InputPlc& input, const Topology& topology, const plc::InputPlc& boundary,
                  const Surface& surface, const Regions& regions, double limit, Verification& result) {
  const auto parts = parts_of_mesh(topology, [&](std::uint32_t f) { return is_facet(topology, f); });
  const auto inside = static_cast<std::size_t>(std::ranges::count(regions.inside, Inside::yes));
  result.checks.push_back(check_faces_between_regions(topology));
  result.checks.push_back(check_parts(surface, regions, topology, parts));
  result.checks.push_back(check_spaces(spaces_outside(input, bounding(surface, regions), inside),
                                       spaces_outside_of_mesh(boundary, topology)));
  const std::vector<TrianglePoints> of_mesh = facets_of_mesh(topology),
                                    of_input = facets_of_input(input, surface, regions);
  Distances distances{.limit = limit};
  result.checks.push_back(
      check_distance("distance of the mesh from the input", of_mesh, of_input, limit, distances.to_input));
  result.checks.push_back(
      check_distance("distance of the input from the mesh", of_input, of_mesh, limit, distances.from_input));
  result.distances = distances;
  const double area = std::max(area_of_boundary(boundary), area_of_boundary(surface, regions));
  result.checks.push_back(check_volumes(limit, area, result));
}

}  // namespace ccdt::verify
