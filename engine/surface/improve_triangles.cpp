#include <algorithm>

#include "engine/surface/remesh_steps.h"

namespace ccdt::surface {
namespace {

constexpr double good_angle = 36;  // degrees
constexpr int most_sweeps = 30;

double smallest_angle_of(const WorkingMesh& m, FaceHandle f) {
  return smallest_angle(m.points(m.corners(m.mesh.halfedge_handle(f))));
}

// The worst first.
std::vector<FaceHandle> bad_triangles(const WorkingMesh& m) {
  std::vector<std::pair<double, int>> found;
  for (const FaceHandle f : m.mesh.faces()) {
    const double angle = smallest_angle_of(m, f);
    if (angle < to_radians(good_angle)) found.emplace_back(angle, f.idx());
  }
  std::sort(found.begin(), found.end());
  std::vector<FaceHandle> faces;
  faces.reserve(found.size());
  for (const auto& [angle, f] : found) faces.emplace_back(f);
  return faces;
}

// Its halfedges, along the longest edge first.
std::array<HalfedgeHandle, 3> halfedges_by_length(const WorkingMesh& m, FaceHandle f) {
  const HalfedgeHandle h = m.mesh.halfedge_handle(f);
  std::array<HalfedgeHandle, 3> halfedges = {h, m.mesh.next_halfedge_handle(h), m.mesh.prev_halfedge_handle(h)};
  const auto size = [&](HalfedgeHandle e) { return m.edge_length(m.ends(e)[0], m.ends(e)[1]); };
  std::stable_sort(halfedges.begin(), halfedges.end(),
                   [&](HalfedgeHandle e, HalfedgeHandle g) { return size(e) > size(g); });
  return halfedges;
}

bool improve_triangle(WorkingMesh& m, FaceHandle f) {
  const std::array<HalfedgeHandle, 3> halfedges = halfedges_by_length(m, f);
  for (const HalfedgeHandle h : halfedges)
    if (improve_by_flip(m, m.mesh.edge_handle(h))) return true;
  bool any = false;
  for (const VertexHandle v : m.corners(halfedges[0])) any = improve_by_move(m, v) || any;
  if (any) return true;
  for (auto h = halfedges.rbegin(); h != halfedges.rend(); ++h)
    if (improve_by_collapse(m, *h) || improve_by_collapse(m, m.mesh.opposite_halfedge_handle(*h))) return true;
  return false;
}

}  // namespace

void improve_worst_triangles(WorkingMesh& m) {
  bool any = true;
  for (int sweep = 0; any && sweep < most_sweeps; ++sweep) {
    any = false;
    for (const FaceHandle f : bad_triangles(m))
      if (!m.mesh.status(f).deleted() && !m.is_frozen(f)) any = improve_triangle(m, f) || any;
  }
}

}  // namespace ccdt::surface
