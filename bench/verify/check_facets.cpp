#include "bench/verify/checks.h"
#include "bench/verify/findings.h"

namespace ccdt::verify {

namespace {

bool any_inside(const Regions& regions, const std::vector<std::uint32_t>& which) {
  return std::any_of(which.begin(), which.end(), [&](std::uint32_t c) { return regions.inside[c] == Inside::yes; });
}

}  // namespace

Check check_vertices(const plc::InputPlc& input, const Surface& surface, const Regions& regions,
                     const RayShooter& rays) {
  Check check = make_check(surface.slides.empty() ? "input vertices" : "input vertices that may not slide");
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
    if (on_surface[site] ? !touched[site] : !any_inside(regions, regions_at(surface, regions, rays, p))) continue;
    fail(check, [&] { return "the mesh has no vertex " + std::to_string(i) + " of the input, " + text(p); });
  }
  return check;
}

Check check_segments(const Surface& surface, const Chains& edges, const Chains& segments,
                     const std::vector<bool>& features, const Regions& regions, const RayShooter& rays) {
  Check check = make_check("input segments");
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
    if (!any_inside(regions, regions_at(surface, regions, rays, middle))) continue;
    fail(check, [&] { return "no chain of mesh edges along the segment" + text(surface.sites.position, segment); });
  }
  return check;
}

Check check_facets(const Surface& surface, const FacetMatches& matches, const Regions& regions) {
  Check check = make_check("input facets");
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

Check check_boundary(const mesh::TetMesh& mesh, const Topology& topology, const FacetMatches& matches) {
  Check check = make_check("boundary faces on input facets");
  for (std::uint32_t f = 0; f < topology.faces.size(); ++f) check.checked += topology.on_boundary(f);
  for (const std::uint32_t f : matches.stray_faces) {
    fail(check,
         [&] { return "not of the input's surface is the boundary face" + text(mesh.vertices, topology.faces[f]); });
  }
  return check;
}

}  // namespace ccdt::verify
