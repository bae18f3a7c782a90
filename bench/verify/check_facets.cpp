#include "bench/verify/check_facets.h"

#include <algorithm>

#include "bench/verify/findings.h"

namespace ccdt::verification {

namespace {

bool any_inside(const Regions& regions, const std::vector<std::uint32_t>& which) {
  return std::any_of(which.begin(), which.end(), [&](std::uint32_t c) { return regions.inside[c] == Inside::yes; });
}

std::string text_of_edge(const Surface& surface, const std::array<std::uint32_t, 2>& edge) {
  return text(surface.at(edge[0])) + " " + text(surface.at(edge[1]));
}

}  // namespace

Check check_vertices(const InputPlc& input, const Surface& surface, const Regions& regions, const RayShooter& rays) {
  Check check = make_check(surface.slides.empty() ? "input vertices" : "input vertices that may not slide");
  std::vector<bool> touched(surface.sites.position.size(), false), on_surface(touched);
  for (std::uint32_t i = 0; i < surface.directed.size(); ++i) {
    const std::uint32_t site = surface.directed[i][0];
    on_surface[site] = true;
    if (regions.touches_inside(surface.piece_of[i])) touched[site] = true;
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
    bool touches = false;
    for (std::uint32_t i = surface.use_begin[e]; i < surface.use_begin[e + 1]; ++i)
      touches = touches || regions.touches_inside(surface.piece_of[surface.uses[i]]);
    check.checked += touches;
    if (!touches || !edges.missing(e)) continue;
    fail(check, [&] { return "no chain of mesh edges along the edge " + text_of_edge(surface, surface.edges[e]); });
  }
  for (std::size_t s = 0; s < surface.segments.size(); ++s) {
    ++check.checked;
    if (!segments.missing(s)) continue;
    const auto& [a, b] = surface.segments[s];
    const Point3 middle = 0.5 * (surface.at(a) + surface.at(b));
    if (!any_inside(regions, regions_at(surface, regions, rays, middle))) continue;
    fail(check, [&] { return "no chain of mesh edges along the segment " + text_of_edge(surface, {a, b}); });
  }
  return check;
}

Check check_facets(const Surface& surface, const Covers& covers, const Regions& regions) {
  Check check = make_check("input facets");
  for (std::uint32_t p = 0; p < surface.pieces(); ++p) {
    const bool above = regions.inside[regions.of_side[2 * p]] == Inside::yes;
    const bool below = regions.inside[regions.of_side[2 * p + 1]] == Inside::yes;
    if (!above && !below) continue;
    ++check.checked;
    const Found wanted = above && below ? Found::interior : above ? Found::boundary_of_above : Found::boundary_of_below;
    if (covers.found[p] == wanted) continue;
    fail(check, [&] {
      std::string s = "facet " + std::to_string(surface.number[p]) + " with the vertices";
      for (std::uint32_t i = surface.piece_begin[p];
           i < std::min(surface.piece_begin[p] + 4, surface.piece_begin[p + 1]); ++i)
        s += " " + text(surface.at(surface.directed[i][0]));
      if (covers.found[p] == Found::nothing)
        return s + " is not in the mesh" + (covers.problem[p].empty() ? "" : ": " + covers.problem[p]);
      if (wanted == Found::interior) return s + " should have tetrahedra on both sides";
      return s + (covers.found[p] == Found::interior ? " has tetrahedra on both sides"
                                                     : " has its tetrahedra on the wrong side");
    });
  }
  return check;
}

Check check_boundary(const TetMesh& mesh, const Topology& topology, const Covers& covers) {
  Check check = make_check("boundary faces on input facets");
  for (std::uint32_t f = 0; f < topology.faces.size(); ++f) check.checked += topology.on_boundary(f);
  for (const std::uint32_t f : covers.stray_faces) {
    fail(check, [&] {
      std::string s = "not of the input's surface is the boundary face";
      for (const std::uint32_t v : topology.faces[f]) s += " " + text(mesh.vertices[v]);
      return s;
    });
  }
  return check;
}

}  // namespace ccdt::verification
