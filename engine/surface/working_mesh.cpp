#include "engine/surface/working_mesh.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "engine/base/errors.h"

namespace ccdt::surface {
namespace {

// Adds the knots. Returns the knot of each point; `none` for points inside one patch that may move.
std::vector<std::uint32_t> add_knots(WorkingMesh& m) {
  const OriginalSurface& original = m.original;
  std::vector<char> has_feature(original.points.size(), 0);
  for (const FeatureEdge& f : original.features) has_feature[f.ends[0]] = has_feature[f.ends[1]] = 1;
  std::vector<std::uint32_t> knot_of(original.points.size(), none);
  for (std::uint32_t p = 0; p < original.points.size(); ++p) {
    if (!has_feature[p] && !m.features.is_corner[p]) continue;
    knot_of[p] = static_cast<std::uint32_t>(m.knots.size());
    const Point3& position = original.points[p];
    m.knots.push_back({position, m.features.is_corner[p] != 0, {}, {}, m.lengths.at(position)});
  }
  return knot_of;
}

void add_links(WorkingMesh& m, const std::vector<std::uint32_t>& knot_of) {
  for (std::uint32_t f = 0; f < m.original.features.size(); ++f) {
    const auto [a, b] = m.original.features[f].ends;
    const CurvePiece& piece = m.features.piece_of[f];
    for (const std::uint32_t p : {a, b})
      m.knots[knot_of[p]].links.push_back(static_cast<std::uint32_t>(m.links.size()));
    m.links.push_back({{knot_of[a], knot_of[b]}, piece.curve, piece.arc});
  }
}

void add_vertices(WorkingMesh& m, const std::vector<std::uint32_t>& knot_of) {
  for (std::uint32_t w = 0; w < m.original.wedge_points.size(); ++w) {
    const std::uint32_t p = m.original.wedge_points[w];
    const Point3& position = m.original.points[p];
    const VertexHandle v(m.mesh.add_vertex({position.x, position.y, position.z}).idx());
    m.vertices.push_back(
        {knot_of[p], m.original.wedge_patches[w], none, m.original.wedge_normals[w], m.lengths.at(position)});
    if (knot_of[p] != none) m.knots[knot_of[p]].copies.push_back(v);
  }
}

void add_faces(WorkingMesh& m, const std::vector<char>& frozen) {
  for (std::uint32_t t = 0; t < m.original.triangles.size(); ++t) {
    std::array<VertexHandle, 3> corners;
    for (int k = 0; k < 3; ++k) {
      corners[k] = VertexHandle(static_cast<int>(m.original.wedges[t][k]));
      m.at(corners[k]).near = t;
      if (frozen[t]) m.at(corners[k]).is_frozen = true;
    }
    if (m.mesh.add_face(corners[0], corners[1], corners[2]).is_valid()) continue;
    Place place;
    for (const std::uint32_t p : m.original.triangles[t]) place.points.push_back(as_array(m.original.points[p]));
    throw MeshError("the surface cannot be remeshed: it is not a manifold at this facet", place,
                    "mesh the surface as it is");
  }
  m.face_is_frozen = frozen;
}

}  // namespace

WorkingMesh make_working_mesh(const OriginalSurface& original, const FeatureCurves& features,
                              const ClosestPoint& closest, const sizes::SizeField& lengths,
                              const sizes::SizeField& shape, double deviation, const std::vector<char>& frozen) {
  WorkingMesh m{original, features, closest, lengths, shape, deviation, {}, {}, {}, {}, {}};
  const std::vector<std::uint32_t> knot_of = add_knots(m);
  add_links(m, knot_of);
  add_vertices(m, knot_of);
  add_faces(m, frozen);
  return m;
}

VertexHandle add_vertex(WorkingMesh& m, std::uint32_t patch, const Foot& foot, double wanted) {
  const VertexHandle v(m.mesh.add_vertex({foot.point.x, foot.point.y, foot.point.z}).idx());
  m.vertices.push_back({none, patch, foot.triangle, m.closest.normal_at(foot), wanted});
  return v;
}

VertexHandle add_copy(WorkingMesh& m, std::uint32_t patch, std::uint32_t knot, std::uint32_t near) {
  const Point3& position = m.knots[knot].position;
  const VertexHandle v = add_vertex(m, patch, m.closest.on_patch(patch, position, near), m.knots[knot].wanted);
  m.move(v, position);
  m.at(v).knot = knot;
  m.knots[knot].copies.push_back(v);
  return v;
}

std::uint32_t link_between(const WorkingMesh& m, std::uint32_t knot, std::uint32_t other) {
  for (const std::uint32_t l : m.knots[knot].links)
    if (m.links[l].ends[0] == other || m.links[l].ends[1] == other) return l;
  return none;
}

bool are_joined(const WorkingMesh& m, std::uint32_t knot, std::uint32_t other) {
  if (link_between(m, knot, other) != none) return true;
  for (const VertexHandle copy : m.knots[knot].copies)
    for (auto n = m.mesh.cvv_iter(copy); n.is_valid(); ++n)
      if (m.at(*n).knot == other) return true;
  return false;
}

std::vector<EdgeHandle> copies_of_link(const WorkingMesh& m, std::uint32_t link) {
  std::vector<EdgeHandle> edges;
  const auto [a, b] = m.links[link].ends;
  for (const VertexHandle copy : m.knots[a].copies)
    for (auto h = m.mesh.cvoh_iter(copy); h.is_valid(); ++h) {
      const EdgeHandle e(m.mesh.edge_handle(*h).idx());
      if (m.at(m.mesh.to_vertex_handle(*h)).knot == b && m.mesh.is_boundary(e)) edges.push_back(e);
    }
  return edges;
}

KnotOnCurve on_curve(const WorkingMesh& m, std::uint32_t knot) {
  KnotOnCurve at = {};
  for (std::size_t i = 0; i < 2; ++i) {
    at.links[i] = m.knots[knot].links[i];
    const WorkingMesh::Link& link = m.links[at.links[i]];
    at.sides[i] = link.side_of(knot);
    at.others[i] = link.ends[1 - at.sides[i]];
    at.arcs[i] = link.arc[1 - at.sides[i]];
    at.curve = link.curve;
  }
  return at;
}

bool runs_along_surface(const WorkingMesh& m, VertexHandle a, VertexHandle b) {
  constexpr double most_sine = 0.55;  // of 2 atan(2 most_deviation)
  const Point3 along = m.point(b) - m.point(a);
  const double limit = most_sine * length(along);
  return std::fabs(dot(along, m.at(a).normal)) <= limit && std::fabs(dot(along, m.at(b).normal)) <= limit;
}

bool is_near_surface(const WorkingMesh& m, VertexHandle a, const Point3& q, double most) {
  if (m.is_flat(a)) return true;
  const Point3 p = m.point(a);
  const double within = std::min(m.deviation, most * std::max(length(q - p), m.at(a).wanted));
  return m.closest.is_within(within, m.at(a).patch, 0.5 * (p + q), m.at(a).near);
}

plc::InputPlc to_plc(const WorkingMesh& m, const plc::InputPlc& input) {
  plc::InputPlc plc;
  plc.name = input.name;
  plc.inside = input.inside;
  plc.holes = input.holes;
  plc.regions = input.regions;
  plc.warped = input.warped;
  plc.marker_names = input.marker_names;
  std::vector<std::uint32_t> of_knot(m.knots.size(), none), of_vertex(m.vertices.size(), none);
  const auto add = [&](const Point3& p) {
    plc.vertices.push_back(p);
    return static_cast<std::uint32_t>(plc.vertices.size() - 1);
  };
  for (std::uint32_t k = 0; k < m.knots.size(); ++k)
    if (m.knots[k].is_alive) of_knot[k] = add(m.knots[k].position);
  const auto number = [&](VertexHandle v) {
    if (m.at(v).knot != none) return of_knot[m.at(v).knot];
    std::uint32_t& n = of_vertex[static_cast<std::size_t>(v.idx())];
    if (n == none) n = add(m.point(v));
    return n;
  };
  // In the order of the patches, since regions are numbered in the order of triangles.
  std::vector<std::pair<std::uint32_t, std::array<std::uint32_t, 3>>> triangles;
  for (const FaceHandle f : m.mesh.faces()) {
    const auto [a, b, c] = m.corners(m.mesh.halfedge_handle(f));
    triangles.push_back({m.at(a).patch, {number(a), number(b), number(c)}});
  }
  std::ranges::stable_sort(triangles, {}, [](const auto& t) { return t.first; });
  for (const auto& [patch, corners] : triangles) {
    plc.triangles.push_back(corners);
    plc.triangle_markers.push_back(m.original.patch_markers[patch]);
  }
  for (const WorkingMesh::Link& link : m.links) {
    if (!link.is_alive || !m.features.curves[link.curve].is_segment) continue;
    plc.segments.push_back({of_knot[link.ends[0]], of_knot[link.ends[1]]});
    plc.segment_markers.push_back(m.features.curves[link.curve].marker);
  }
  return plc;
}

}  // namespace ccdt::surface
