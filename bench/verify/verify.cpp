#include "bench/verify/verify.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "bench/verify/checks.h"
#include "bench/verify/embed_lines.h"
#include "bench/verify/slide.h"

// Why these checks are enough. Let d(x) be the number of tetrahedra around a point x; all are positively oriented, so d
// changes only across the boundary of the mesh. Every boundary face belongs to a part that stands for exactly one patch
// of input facets (same loops, flat, no face turned over: so it covers the patch once), and no patch has two such
// parts. Within the tolerance, d therefore changes only across input facets: by one across a facet found as boundary,
// up to the side where the tetrahedra are, else not at all. The facets' sides are labeled inside or outside from the
// input alone, and each facet must be found as the boundary of its inside side exactly when its sides differ. So d and
// the indicator of the domain change by the same across every facet; both are 0 at infinity; they are equal. The
// tetrahedra fill the domain and do not overlap. Facets within the domain are spanned by inner faces in the same sense;
// that no tetrahedron is reached from two regions shows once more that none is pierced.

namespace ccdt::verify {

using namespace verify;

namespace {

/// The engine rounds to 2^-33 of the next power of two above the box; and the coordinates in the file are rounded to
/// doubles.
double largest_rounding(const plc::InputPlc& input, const Tolerances& tolerances) {
  double largest = 0;
  for (const Point3& p : input.vertices) largest = std::max({largest, std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)});
  return std::ldexp(tolerances.box, -32) + std::numeric_limits<double>::epsilon() * largest;
}

bool wants_delaunay(const VerifyOptions& options, const mesh::TetMesh& mesh) {
  if (options.delaunay == VerifyOptions::Delaunay::claimed) return mesh.constrained_delaunay;
  return options.delaunay == VerifyOptions::Delaunay::yes;
}

void check_against_input(const plc::InputPlc& input, const mesh::TetMesh& mesh, const Topology& topology,
                         const VerifyOptions& options, const Progress& progress, Verification& result) {
  const Tolerances tolerances = find_tolerances(input, options.flatness);
  report(progress, "verify facets", 0, 0);
  Surface surface = find_surface(input, match_sites(input, mesh, topology, tolerances.place), tolerances);
  embed_lines(surface);
  Regions regions = find_regions(input, surface);
  if (options.boundary == VerifyOptions::Boundary::slide) let_vertices_slide(surface, regions);
  const std::vector<bool> features = find_features(surface);
  const Chains edges = find_chains(mesh, topology, surface, surface.edges);
  const Chains segments = find_chains(mesh, topology, surface, surface.segments);
  const FacetMatches matches = match_facets(mesh, topology, surface, edges, features);
  report(progress, "verify domain", 0, 0);
  const RegionsOfTetrahedra assigned = assign_regions(mesh, topology, regions, matches, tolerances.flat);
  resolve_unknown(assigned, regions);

  const RayShooter rays(surface);
  auto& checks = result.checks;
  checks.push_back(check_vertices(input, surface, regions, rays));
  checks.push_back(check_segments(surface, edges, segments, features, regions, rays));
  checks.push_back(check_facets(surface, matches, regions));
  checks.push_back(check_boundary(mesh, topology, matches));
  checks.push_back(check_domain(mesh, regions, assigned));
  checks.push_back(check_holes(input, regions, assigned));
  checks.push_back(check_regions(mesh, regions, assigned));
  result.mesh_volume = mesh_volume(mesh);
  result.input_volume = input_volume(surface, regions);
  checks.push_back(check_volume(surface, regions, result.mesh_volume, result.input_volume));
  if (options.delaunay == VerifyOptions::Delaunay::no) return;
  DelaunayChecks delaunay = check_delaunay(mesh, topology, matches.is_matched, largest_rounding(input, tolerances),
                                           wants_delaunay(options, mesh), progress);
  checks.push_back(std::move(delaunay.local));
  checks.push_back(std::move(delaunay.explained));
}

std::string line_of(const Check& check, std::size_t width) {
  const char* verdict = check.failed == 0 ? "ok" : check.required ? "FAILED" : "note";
  char counts[96];
  std::snprintf(counts, sizeof counts, "%12llu checked %10llu failed", static_cast<unsigned long long>(check.checked),
                static_cast<unsigned long long>(check.failed));
  std::string line(verdict);
  line.resize(8, ' ');
  line += check.name;
  line.resize(8 + width, ' ');
  return line + counts;
}

}  // namespace

Verification verify(const plc::InputPlc& input, const mesh::TetMesh& mesh, const VerifyOptions& options,
                    const Progress& progress) {
  Verification result;
  auto& checks = result.checks;
  checks.push_back(check_coordinates(mesh));
  checks.push_back(check_indices(mesh));
  if (!result.ok()) return result;  // nothing else can be asked of such a mesh
  checks.push_back(check_orientation(mesh, progress));
  report(progress, "verify faces", 0, 0);
  const Topology topology = find_topology(mesh);
  checks.push_back(check_shared_faces(mesh, topology));
  checks.push_back(check_distinct_vertices(mesh, topology));
  checks.push_back(check_used_vertices(mesh, topology));
  check_against_input(input, mesh, topology, options, progress, result);
  return result;
}

std::vector<std::string> describe(const Verification& verification) {
  std::size_t width = 0;
  for (const Check& check : verification.checks) width = std::max(width, check.name.size());
  std::vector<std::string> lines;
  for (const Check& check : verification.checks) {
    lines.push_back(line_of(check, width));
    for (const std::string& example : check.examples) lines.push_back("          " + example);
    if (check.failed > check.examples.size() && !check.examples.empty())
      lines.push_back("          and " + std::to_string(check.failed - check.examples.size()) + " more");
  }
  char volumes[128];
  std::snprintf(volumes, sizeof volumes, "volume of the mesh %.15g, of the input %.15g", verification.mesh_volume,
                verification.input_volume);
  lines.push_back(volumes);
  lines.push_back(verification.ok() ? "the mesh is right" : "the mesh is WRONG");
  return lines;
}

}  // namespace ccdt::verify
