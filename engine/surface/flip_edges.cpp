#include <algorithm>
#include <cmath>

#include "engine/surface/improve_triangles.h"
#include "engine/surface/remesh_steps.h"
#include "engine/surface/surface_limits.h"

namespace ccdt {
namespace {

constexpr std::uint32_t none = WorkingMesh::none;
constexpr double good_quality = 0.3;

// An edge ab between the triangles abc and bad, and the triangles cdb and dca that a flip would give.
struct Flip {
  VertexHandle a, b, c, d;
  WorstFit before, after;
};

Flip flip_at(const WorkingMesh& m, EdgeHandle e, Shape shape = Shape::area) {
  Flip f;
  const auto one = corners_of(m, m.mesh.halfedge_handle(e, 0)), other = corners_of(m, m.mesh.halfedge_handle(e, 1));
  f.a = one[0], f.b = one[1], f.c = one[2], f.d = other[2];
  f.before.add(fit_of(m, one, shape));
  f.before.add(fit_of(m, other, shape));
  f.after.add(fit_of(m, {f.c, f.d, f.b}, shape));
  f.after.add(fit_of(m, {f.d, f.c, f.a}, shape));
  return f;
}

bool may_be_looked_at(const WorkingMesh& m, EdgeHandle e) {
  if (m.mesh.status(e).deleted() || m.mesh.is_boundary(e)) return false;
  return !m.is_frozen(m.mesh.face_handle(m.mesh.halfedge_handle(e, 0))) &&
         !m.is_frozen(m.mesh.face_handle(m.mesh.halfedge_handle(e, 1)));
}

bool may_flip(const WorkingMesh& m, EdgeHandle e, const Flip& f) {
  if (!runs_along_surface(m, f.c, f.d) || !m.mesh.is_flip_ok(e)) return false;
  const std::uint32_t c = m.at(f.c).knot, d = m.at(f.d).knot;
  if (c != none && d != none && (c == d || are_joined(m, c, d))) return false;
  return is_near_surface(m, f.c, f.d) || !is_near_surface(m, f.a, f.b);
}

// How many neighbours a vertex on a feature should have: its wedge in equal parts near to 60 degrees.
int ideal_valence(const WorkingMesh& m, VertexHandle v) {
  if (!m.mesh.is_boundary(v)) return 6;
  double angle = 0;
  for (auto h = m.mesh.cvoh_iter(v); h.is_valid(); ++h) {
    if (m.mesh.is_boundary(*h)) continue;
    const auto [a, b, c] = corners_of(m, *h);
    angle += angle_at(m.point(a), m.point(b), m.point(c));
  }
  return std::max(1, static_cast<int>(std::lround(angle / radians(60)))) + 1;
}

int square(int i) {
  return i * i;
}

}  // namespace

void flip_edges_for_valence(WorkingMesh& m) {
  std::vector<int> excess(m.vertices.size(), 0);
  for (const VertexHandle v : m.mesh.vertices())
    excess[static_cast<std::size_t>(v.idx())] = static_cast<int>(m.mesh.valence(v)) - ideal_valence(m, v);
  const auto excess_of = [&](VertexHandle v) -> int& { return excess[static_cast<std::size_t>(v.idx())]; };
  for (std::size_t i = 0; i < m.mesh.n_edges(); ++i) {
    const EdgeHandle e(static_cast<int>(i));
    if (!may_be_looked_at(m, e)) continue;
    const auto one = corners_of(m, m.mesh.halfedge_handle(e, 0));
    const VertexHandle d = corners_of(m, m.mesh.halfedge_handle(e, 1))[2];
    int &ea = excess_of(one[0]), &eb = excess_of(one[1]), &ec = excess_of(one[2]), &ed = excess_of(d);
    const int before = square(ea) + square(eb) + square(ec) + square(ed);
    const int after = square(ea - 1) + square(eb - 1) + square(ec + 1) + square(ed + 1);
    if (after >= before) continue;
    const Flip f = flip_at(m, e);
    if (!may_replace(f.before.worst, f.after.worst, good_quality) || !may_flip(m, e, f)) continue;
    m.mesh.flip(e);
    --ea, --eb, ++ec, ++ed;
  }
}

void flip_edges_for_quality(WorkingMesh& m) {
  constexpr double least_gain = 1.001;  // rounding must not flip edges back and forth
  constexpr int most_sweeps = 5;
  bool any = true;
  for (int sweep = 0; any && sweep < most_sweeps; ++sweep) {
    any = false;
    for (std::size_t i = 0; i < m.mesh.n_edges(); ++i) {
      const EdgeHandle e(static_cast<int>(i));
      if (!may_be_looked_at(m, e)) continue;
      const Flip f = flip_at(m, e);
      if (f.after.worst.quality < least_gain * f.before.worst.quality) continue;
      if (!may_replace(f.before.worst, f.after.worst, good_quality) || !may_flip(m, e, f)) continue;
      m.mesh.flip(e);
      any = true;
    }
  }
}

bool improve_by_flip(WorkingMesh& m, EdgeHandle e) {
  if (!may_be_looked_at(m, e)) return false;
  const Flip f = flip_at(m, e, Shape::angle);
  if (!is_better(f.before.worst, f.after.worst) || !may_flip(m, e, f)) return false;
  m.mesh.flip(e);
  return true;
}

}  // namespace ccdt
