#include "bench/verify/verify.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <ranges>
#include <utility>

#include "bench/verify/check_delaunay.h"
#include "bench/verify/check_domain.h"
#include "bench/verify/check_within.h"
#include "bench/verify/coordinates.h"
#include "bench/verify/crossings.h"
#include "bench/verify/distinct_vertices.h"
#include "bench/verify/edit_surface.h"
#include "bench/verify/exact.h"
#include "bench/verify/findings.h"
#include "bench/verify/listed_edges.h"
#include "bench/verify/listed_faces.h"
#include "bench/verify/periodic_sides.h"
#include "engine/base/parallel.h"
#include "engine/base/shared_progress.h"
#include "engine/plc/gather_parts.h"

// Why these checks are enough. Let d(x) be the number of tetrahedra around a point x; all are positively oriented, so d
// changes only across the boundary of the mesh. Every boundary face belongs to a part that stands for exactly one patch
// of input facets (same loops, flat, no face turned over: so it covers the patch once), and no patch has two such
// parts. Within the tolerance, d therefore changes only across input facets: by one across a facet found as a boundary,
// toward the side of the tetrahedra, and otherwise not at all. The facets' sides are labeled inside or outside from the
// input alone, and each facet must be found as the boundary of its inside side exactly when its sides differ. So d and
// the indicator of the domain change by the same across every facet; both are 0 at infinity; they are equal. The
// tetrahedra fill the domain and do not overlap. Facets within the domain are spanned by inner faces in the same sense;
// that no tetrahedron is reached from two regions shows once more that none is pierced.

namespace ccdt::verify {

namespace {

// The tetrahedra by themselves.

void check_array(Check& check, const char* what, std::size_t size, std::size_t wanted) {
  ++check.checked;
  if (size == wanted || size == 0) return;
  fail(check, [&] { return std::to_string(size) + " " + what + " for " + std::to_string(wanted) + " elements"; });
}

template <class Elements>
void check_elements(Check& check, const char* what, const Elements& elements, std::size_t vertices) {
  const auto is_right = [&](std::size_t i) {
    const auto& element = elements[i];
    int wrong = 0;
    for (std::size_t k = 0; k < element.size(); ++k) {
      wrong |= int{element[k] >= vertices};
      for (std::size_t j = 0; j < k; ++j) wrong |= int{element[j] == element[k]};
    }
    return wrong == 0;
  };
  check_each(check, elements.size(), is_right, [&](std::size_t i) {
    std::string s = std::string(what) + " " + std::to_string(i) + " has the vertices";
    for (const std::uint32_t v : elements[i]) s += " " + std::to_string(v);
    return s + " of " + std::to_string(vertices);
  });
}

/// Coordinates are finite.
Check check_coordinates(const mesh::TetMesh& mesh) {
  Check check{.name = "finite coordinates"};
  const auto is_finite = [&](std::size_t v) {
    const Point3& p = mesh.vertices[v];
    return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
  };
  check_each(check, mesh.vertices.size(), is_finite,
             [&](std::size_t v) { return "vertex " + std::to_string(v) + " is at " + text(mesh.vertices[v]); });
  return check;
}

/// Every tetrahedron has four different vertices that exist, and attribute arrays have one entry per element.
Check check_indices(const mesh::TetMesh& mesh) {
  Check check{.name = "valid elements"};
  if (mesh.tetrahedra.empty()) fail(check, [] { return std::string("the mesh has no tetrahedra"); });
  check_elements(check, "tetrahedron", mesh.tetrahedra, mesh.vertices.size());
  check_elements(check, "face", mesh.faces, mesh.vertices.size());
  check_elements(check, "edge", mesh.edges, mesh.vertices.size());
  check_array(check, "regions", mesh.regions.size(), mesh.tetrahedra.size());
  check_array(check, "face markers", mesh.face_markers.size(), mesh.faces.size());
  check_array(check, "edge markers", mesh.edge_markers.size(), mesh.edges.size());
  return check;
}

/// Every tetrahedron is positively oriented, exactly.
Check check_orientation(const mesh::TetMesh& mesh, const Progress& progress) {
  Check check{.name = "positive orientation"};
  SharedProgress shared(progress, "verify orientation", 0, mesh.tetrahedra.size());
  const auto is_positive = [&](std::size_t t) {
    if (t % chunk_length == 0) shared.add(std::min(chunk_length, mesh.tetrahedra.size() - t));
    const auto& [a, b, c, d] = mesh.tetrahedra[t];
    return orientation(mesh.vertices[a], mesh.vertices[b], mesh.vertices[c], mesh.vertices[d]) > 0;
  };
  check_each(check, mesh.tetrahedra.size(), is_positive, [&](std::size_t t) {
    return "tetrahedron " + std::to_string(t) + ":" + text(mesh.vertices, mesh.tetrahedra[t]);
  });
  return check;
}

/// Every vertex is used by a tetrahedron (not required).
Check check_used_vertices(const Topology& topology) {
  Check check{.name = "vertices in use", .required = false};
  check_each(
      check, topology.mesh.vertices.size(), [&](std::size_t v) { return topology.used(static_cast<std::uint32_t>(v)); },
      [&](std::size_t v) {
        return "no tetrahedron uses the vertex " + std::to_string(v) + " at " + text(topology.mesh.vertices[v]);
      });
  return check;
}

/// Every face belongs to one tetrahedron, or to two on opposite sides.
Check check_shared_faces(const Topology& topology) {
  Check check{.name = "faces of one or two tetrahedra", .checked = topology.face_count()};
  for (const std::uint32_t f : topology.bad_faces) {
    fail(check, [&] {
      return "more than two tetrahedra, or two on one side, at the face" +
             text(topology.mesh.vertices, vertices_of_face(topology, f));
    });
  }
  return check;
}

// The facets of the input in the mesh.

/// A `RayShooter` that is made when it is first needed: for most meshes it never is.
class RaysIfNeeded {
 public:
  explicit RaysIfNeeded(const Surface& surface) : surface_(surface) {}

  const RayShooter& get() {
    if (!rays_) rays_.emplace(surface_);
    return *rays_;
  }

 private:
  const Surface& surface_;
  std::optional<RayShooter> rays_;
};

/// Is a point in or on the domain? No, if it is on the boundary only within the tolerance: a mesher that uses exact or
/// rounded coordinates may find it outside.
bool is_in_domain(const Surface& surface, const Regions& regions, RaysIfNeeded& rays_if_needed, const Point3& p) {
  const RayShooter& rays = rays_if_needed.get();
  if (rays.is_on_piece_across_axis(p, [&](std::uint32_t piece) { return regions.touches_inside(piece); })) return true;
  const auto is_inside = [&](std::uint32_t region) { return regions.inside[region] == Inside::yes; };
  const auto is_within = [&](std::uint32_t piece) {
    return is_inside(regions.of_side[2 * piece]) && is_inside(regions.of_side[2 * piece + 1]);
  };
  const std::vector<std::uint32_t> around = regions_at(surface, regions, rays, p);
  return !around.empty() && std::ranges::all_of(around, is_inside) &&
         std::ranges::all_of(rays.pieces_near(p), is_within);
}

constexpr const char* segments_check = "input segments";

/// Every input vertex in or on the domain is a vertex of the mesh, unless it may slide.
Check check_vertices(const plc::InputPlc& input, const Surface& surface, const Regions& regions, RaysIfNeeded& rays) {
  Check check{.name = surface.slides.empty() ? "input vertices" : "input vertices that may not slide"};
  std::vector<bool> touched(surface.sites.position.size(), false), on_surface(touched);
  for (std::uint32_t p = 0; p < surface.pieces(); ++p)
    for (const auto& [site, next] : surface.edges_of(p)) {
      on_surface[site] = true;
      if (regions.touches_inside(p)) touched[site] = true;
    }
  for (std::size_t i = 0; i < input.vertices.size(); ++i) {
    const std::uint32_t site = surface.sites.of_input[i];
    if (!surface.slides.empty() && surface.slides[site]) continue;
    ++check.checked;
    if (surface.sites.in_mesh(site)) continue;
    const Point3& p = input.vertices[i];
    if (on_surface[site] ? !touched[site] : !is_in_domain(surface, regions, rays, p)) continue;
    fail(check, [&] { return "the mesh has no vertex " + std::to_string(i) + " of the input, " + text(p); });
  }
  return check;
}

/// Every segment and every feature edge in or on the domain is a chain of mesh edges.
Check check_segments(const Surface& surface, const SurfaceEdges& lines, const Regions& regions, RaysIfNeeded& rays) {
  const auto& [features, edges, segments] = lines;
  Check check{.name = segments_check};
  for (std::uint32_t e = 0; e < surface.edges.size(); ++e) {
    if (!features[e]) continue;
    const auto touches_inside = [&](std::uint32_t use) { return regions.touches_inside(surface.piece_of[use]); };
    if (!std::ranges::any_of(surface.uses.of(e), touches_inside)) continue;
    ++check.checked;
    if (!edges.missing(e)) continue;
    fail(check,
         [&] { return "no chain of mesh edges along the edge" + text(surface.sites.position, surface.edges[e]); });
  }
  for (std::size_t s = 0; s < surface.segments.size(); ++s) {
    ++check.checked;
    if (!segments.missing(s)) continue;
    const Edge& segment = surface.segments[s];
    const Point3 middle = 0.5 * (surface.at(segment[0]) + surface.at(segment[1]));
    if (!is_in_domain(surface, regions, rays, middle)) continue;
    fail(check, [&] { return "no chain of mesh edges along the segment" + text(surface.sites.position, segment); });
  }
  return check;
}

/// Every facet that touches the domain exists in the mesh: as a boundary if one side is inside, otherwise as inner
/// faces.
Check check_facets(const Surface& surface, const FacetMatches& matches, const Regions& regions) {
  Check check{.name = "input facets"};
  for (std::uint32_t p = 0; p < surface.pieces(); ++p) {
    const bool above = regions.inside[regions.of_side[2 * p]] == Inside::yes;
    const bool below = regions.inside[regions.of_side[2 * p + 1]] == Inside::yes;
    if (!above && !below) continue;
    ++check.checked;
    const FoundAs wanted = above && below ? FoundAs::interior
                           : above        ? FoundAs::boundary_of_above
                                          : FoundAs::boundary_of_below;
    if (matches.found[p] == wanted) continue;
    fail(check, [&] {
      std::string s = "facet " + std::to_string(surface.number[p]) + " with the vertices";
      for (const auto& [site, next] : surface.edges_of(p) | std::views::take(4)) s += " " + text(surface.at(site));
      if (matches.found[p] == FoundAs::nothing)
        return s + " is not in the mesh" + (matches.problem[p].empty() ? "" : ": " + matches.problem[p]);
      if (wanted == FoundAs::interior) return s + " should have tetrahedra on both sides";
      return s + (matches.found[p] == FoundAs::interior ? " has tetrahedra on both sides"
                                                        : " has its tetrahedra on the wrong side");
    });
  }
  return check;
}

/// Every boundary face of the mesh lies on an input facet.
Check check_boundary(const Topology& topology, const FacetMatches& matches) {
  Check check{.name = "boundary faces on input facets", .checked = topology.boundary_faces.size()};
  for (const std::uint32_t f : matches.stray_faces) {
    fail(check, [&] {
      return "boundary face" + text(topology.mesh.vertices, vertices_of_face(topology, f)) +
             " lies on no facet of the input";
    });
  }
  return check;
}

/// The engine rounds to 2^-33 of the next power of two above the box; and the coordinates in the file are rounded to
/// doubles.
double largest_rounding(const plc::InputPlc& input, const Tolerances& tolerances) {
  return std::ldexp(tolerances.box, -32) + std::numeric_limits<double>::epsilon() * largest_coordinate(input.vertices);
}

bool wants_delaunay(const VerifyOptions& options, const mesh::TetMesh& mesh) {
  if (options.delaunay == VerifyOptions::Delaunay::claimed) return mesh.constrained_delaunay;
  return options.delaunay == VerifyOptions::Delaunay::yes;
}

/// Splits the segments that are not complete in the mesh, since the domain may contain only a part of one. (A complete
/// one stays whole: if it passes a vertex of the input within the tolerance, its parts are not in the mesh.)
void split_incomplete_segments(const Topology& topology, Surface& surface) {
  const Chains chains = find_chains(topology, surface, surface.segments);
  std::vector<bool> incomplete;
  for (std::size_t s = 0; s < surface.segments.size(); ++s) incomplete.push_back(chains.missing(s));
  split_segments(incomplete, surface);
}

void check_against_input(const plc::InputPlc& input, const Topology& topology, const Tolerances& tolerances,
                         const VerifyOptions& options, const Progress& progress, Verification& result) {
  report(progress, "verify facets", 0, 0);
  Surface surface = find_surface(input, match_sites(input, topology, tolerances), tolerances);
  split_incomplete_segments(topology, surface);
  embed_lines(surface);
  const bool may_slide = options.boundary == VerifyOptions::Boundary::slide;
  Regions regions;
  if (may_slide) {
    regions = find_regions(input, surface);
    let_vertices_slide(surface, regions);
  }
  SurfaceEdges lines;
  FacetMatches matches;
  const auto match = [&] {
    lines.features = find_features(surface);
    lines.edges = find_chains(topology, surface, surface.edges);
    lines.segments = find_chains(topology, surface, surface.segments);
    matches = match_facets(topology, surface, lines.edges, lines.features);
  };
  parallel_both(match, [&] {
    if (!may_slide) regions = find_regions(input, surface);
  });
  report(progress, "verify domain", 0, 0);
  auto& checks = result.checks;
  const auto compare_domain = [&] {
    const RegionsOfTetrahedra assigned = assign_regions(topology, regions, matches, tolerances.flat);
    resolve_unknown(assigned, regions);
    RaysIfNeeded rays(surface);
    checks.push_back(check_vertices(input, surface, regions, rays));
    checks.push_back(check_segments(surface, lines, regions, rays));
    checks.push_back(check_facets(surface, matches, regions));
    checks.push_back(check_boundary(topology, matches));
    const bool lists_all = options.lists == VerifyOptions::Lists::all;
    checks.push_back(check_listed_facets(topology, matches, lists_all));
    checks.push_back(check_face_markers(topology, surface, matches));
    checks.push_back(check_listed_edges(input, topology, surface, lines, lists_all));
    checks.push_back(check_edge_markers(input, topology, surface));
    check_domain(input, topology.mesh, surface, regions, assigned, result);
  };
  if (options.delaunay == VerifyOptions::Delaunay::no) return compare_domain();
  std::array<Check, 2> delaunay;
  const auto compare_spheres = [&] {
    delaunay = check_delaunay(topology, matches.is_matched, largest_rounding(input, tolerances),
                              wants_delaunay(options, topology.mesh), progress);
  };
  parallel_both(compare_spheres, compare_domain);
  checks.insert(checks.end(), delaunay.begin(), delaunay.end());
}

/// Do all checks pass, up to the one whose name starts with this?
bool holds_up_to(const char* name, const Verification& result) {
  for (const Check& check : result.checks) {
    if (check.required && check.failed > 0) return false;
    if (check.name.starts_with(name)) return true;
  }
  return false;
}

/// If the mesh is not right at the given tolerances, smaller ones are tried as well. Facets that are right at one
/// tolerance are right at all greater ones. But where facets are as narrow as the tolerance, they match the mesh in
/// more than one way. Where parts are as close together as rounding moves coordinates, the mesh is compared with the
/// rounded input: there, new vertices are exactly in place, and the engine leaves out just the facets without area.
///
/// \param result  gets the checks; if the mesh is never right, those at the given tolerances
void check_at_tolerances(const plc::InputPlc& input, const Topology& topology, const VerifyOptions& options,
                         const Progress& progress, Verification& result) {
  const Verification before = result;
  const Tolerances given = find_tolerances(input, options.flatness);
  check_against_input(input, topology, given, options, progress, result);
  if (result.ok() || options.flatness <= 1e-11) return;
  const bool lines_hold = holds_up_to(segments_check, result);
  const auto try_parts = [&](const plc::InputPlc& its_input, const Topology& its_topology,
                             std::initializer_list<double> parts, const auto& tolerances) {
    for (const double part : parts) {
      if (result.ok()) return;
      Verification closer = before;
      check_against_input(its_input, its_topology, tolerances(given, part), options, progress, closer);
      if (closer.ok()) result = std::move(closer);
    }
  };
  const InputAndMesh rounded = put_on_grid(input, topology.mesh);
  if (check_orientation(rounded.mesh, progress).failed == 0)
    try_parts(rounded.input, find_topology(rounded.mesh), {1, 0.1, 0.01, 0.001, 0}, exact_contacts);
  if (lines_hold) try_parts(input, topology, {0.1, 0.01, 0.001}, narrowed);
}

/// The boundary of the mesh as an input.
plc::InputPlc boundary_of(const Topology& topology) {
  plc::InputPlc boundary;
  std::vector<std::uint32_t> number(topology.mesh.vertices.size(), none);
  for (const std::uint32_t f : topology.boundary_faces) {
    Face face = outward(topology.mesh, topology.half_faces[f][0]);
    for (std::uint32_t& v : face) {
      if (number[v] == none) {
        number[v] = static_cast<std::uint32_t>(boundary.vertices.size());
        boundary.vertices.push_back(topology.mesh.vertices[v]);
      }
      v = number[v];
    }
    boundary.triangles.push_back(face);
  }
  return boundary;
}

/// The boundary of the mesh does not cross itself. Facets that are flat only within the tolerance may do so by less
/// than the tolerance, and the mesh is still right.
Check check_crossings(const plc::InputPlc& boundary, bool required) {
  Check check{.name = "boundary without crossings", .checked = boundary.triangles.size(), .required = required};
  for (const auto& [one, other] : find_crossings(boundary)) {
    fail(check, [&, a = one, b = other] {
      return "the face" + text(boundary.vertices, boundary.triangles[a]) + " meets the face" +
             text(boundary.vertices, boundary.triangles[b]);
    });
  }
  return check;
}

/// Those that need the facets inside, of which the boundary knows nothing.
constexpr const char* checks_of_inner_parts[] = {regions_check, listed_facets_check, listed_edges_check};

/// The boundary of the mesh encloses its tetrahedra, and each point once. The argument is the same as above, with the
/// boundary as the input.
/// \pre  the boundary does not cross itself
Check check_enclosed(const plc::InputPlc& boundary, const Topology& topology, const Progress& progress) {
  Verification by_itself;
  check_against_input(boundary, topology, find_tolerances(boundary, 0), {.delaunay = VerifyOptions::Delaunay::no},
                      progress, by_itself);
  Check enclosed{.name = "boundary that encloses the tetrahedra once", .checked = boundary.triangles.size()};
  for (const Check& check : by_itself.checks) {
    if (!check.required || std::ranges::find(checks_of_inner_parts, check.name) != std::end(checks_of_inner_parts))
      continue;
    enclosed.failed += check.failed;
    enclosed.examples.insert(enclosed.examples.end(), check.examples.begin(), check.examples.end());
  }
  return enclosed;
}

void check_own_surface(const plc::InputPlc& input, const Topology& topology, const VerifyOptions& options,
                       const Progress& progress, Verification& result) {
  if (!result.ok()) return;  // the boundary of inverted tetrahedra, or of more than two at a face, encloses nothing
  const plc::InputPlc boundary = boundary_of(topology);
  result.checks.push_back(check_crossings(boundary, true));
  if (result.checks.back().failed == 0) result.checks.push_back(check_enclosed(boundary, topology, progress));
  result.mesh_volume = mesh_volume(topology.mesh);
  const Tolerances tolerances = find_tolerances(input, options.flatness);
  Surface surface = find_surface(input, match_sites(input, topology, tolerances), tolerances);
  embed_lines(surface);
  const Regions regions = find_regions(input, surface);
  result.input_volume = input_volume(surface, regions);
  if (options.within && result.ok()) check_within(input, topology, boundary, surface, regions, *options.within, result);
}

Verification verify_as_it_is(const plc::InputPlc& input, const mesh::TetMesh& mesh, const VerifyOptions& options,
                             const Progress& progress) {
  Verification result;
  auto& checks = result.checks;
  checks.push_back(check_coordinates(mesh));
  checks.push_back(check_indices(mesh));
  if (!result.ok()) return result;  // no other check makes sense for such a mesh
  checks.push_back(check_orientation(mesh, progress));
  report(progress, "verify faces", 0, 0);
  const Topology topology = find_topology(mesh);
  checks.push_back(check_shared_faces(topology));
  checks.push_back(check_distinct_vertices(topology));
  checks.push_back(check_used_vertices(topology));
  checks.push_back(check_listed_faces(topology));
  if (options.periodic != plc::Periodicity::none) {
    const double rounding = largest_rounding(input, find_tolerances(input, options.flatness));
    checks.push_back(check_periodic_sides(topology, options.periodic, 2 * rounding));
  }
  if (options.surface == VerifyOptions::Surface::own)
    check_own_surface(input, topology, options, progress, result);
  else
    check_at_tolerances(input, topology, options, progress, result);
  if (options.surface == VerifyOptions::Surface::same && result.ok())
    checks.push_back(check_crossings(boundary_of(topology), false));
  return result;
}

/// Products of lengths between 2^-60 and 2^60 neither overflow nor vanish.
constexpr int usual_exponent = 60;

}  // namespace

Verification verify(const plc::InputPlc& input, const mesh::TetMesh& mesh, const VerifyOptions& options,
                    const Progress& progress) {
  plc::check_extent(input);
  const double extent = largest_extent(input.vertices);
  const int exponent = extent > 0 ? std::ilogb(extent) : 0;
  if (std::abs(exponent) <= usual_exponent) return verify_as_it_is(input, mesh, options, progress);
  const auto scaled = scale_by(std::ldexp(1, -exponent), input, mesh);  // which changes no digit
  VerifyOptions scaled_options = options;
  if (options.within) scaled_options.within = std::ldexp(*options.within, -exponent);
  Verification result = verify_as_it_is(scaled.input, scaled.mesh, scaled_options, progress);
  result.mesh_volume = std::ldexp(result.mesh_volume, 3 * exponent);
  result.input_volume = std::ldexp(result.input_volume, 3 * exponent);
  if (result.distances)
    for (double* length : {&result.distances->limit, &result.distances->to_input, &result.distances->from_input})
      *length = std::ldexp(*length, exponent);
  return result;
}

}  // namespace ccdt::verify
