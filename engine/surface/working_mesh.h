#pragma once

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/base/count_work.h"
#include "engine/base/point.h"
#include "engine/base/portable_math.h"
#include "engine/surface/feature_curves.h"
#include "engine/surface/original_surface.h"
#include "engine/surface/wanted_lengths.h"

namespace ccdt::surface {

/// The measure of a triangle's quality: its area over its squared edges, or its smallest angle.
enum class TriangleMeasure { area, angle };

/// The shape of a triangle, and how well it represents the original surface at its corners.
struct TriangleFit {
  double quality;    ///< 1 for the equilateral triangle, 0 for a degenerate one
  double agreement;  ///< the smallest cosine between its normal and the original surface's at its corners, except tips
};

/// The cosine of a triangle's smallest angle.
inline double largest_cosine(const std::array<Point3, 3>& p) {
  ++work_done.triangles_evaluated;
  std::array<double, 3> squares = {squared_length(p[1] - p[0]), squared_length(p[2] - p[1]),
                                   squared_length(p[0] - p[2])};
  std::sort(squares.begin(), squares.end());
  const double product = std::sqrt(squares[1] * squares[2]);
  return product > 0 ? std::clamp((squares[1] + squares[2] - squares[0]) / (2 * product), -1.0, 1.0) : 1;
}

/// In radians.
inline double smallest_angle(const std::array<Point3, 3>& p) {
  return portable::arc_cosine(largest_cosine(p));
}

inline TriangleFit fit_of(const std::array<Point3, 3>& p, const std::array<Point3, 3>& normals,
                          TriangleMeasure measure = TriangleMeasure::area) {
  if (measure == TriangleMeasure::area) ++work_done.triangles_evaluated;
  constexpr double two_root_three = 3.4641016151377544;
  const Point3 area = area_vector(p);
  const double size = length(area);
  const double squares = squared_length(p[1] - p[0]) + squared_length(p[2] - p[1]) + squared_length(p[0] - p[2]);
  if (size == 0) return {0, -1};
  double agreement = size;
  for (const Point3& normal : normals)
    if (normal != Point3{}) agreement = std::min(agreement, dot(area, normal));
  return {measure == TriangleMeasure::area ? two_root_three * size / squares : smallest_angle(p) / to_radians(60),
          agreement / size};
}

/// The worst of several triangles.
struct WorstFit {
  TriangleFit worst = {1, 1};

  void add(const TriangleFit& fit) {
    worst.quality = std::min(worst.quality, fit.quality);
    worst.agreement = std::min(worst.agreement, fit.agreement);
  }
};

/// Do triangles of fit `after` represent the original surface as well as those of fit `before`, or well enough?
inline bool may_stand_for(const TriangleFit& before, const TriangleFit& after) {
  constexpr double good_agreement = 0.65;  // 50 degrees: an equilateral triangle on a circle's hexagon has 40
  constexpr double least_agreement = 0.2;
  return after.agreement >= std::max(least_agreement, std::min(good_agreement, before.agreement));
}

/// May triangles of fit `after` replace those of fit `before`? They must be good, or not worse, and they must never be
/// turned away from the original surface.
inline bool may_replace(const TriangleFit& before, const TriangleFit& after, double good_quality) {
  return after.quality >= std::min(good_quality, before.quality) && may_stand_for(before, after);
}

/// Is the worst triangle really better after a change? With mere rounding gains, changes would go on forever.
inline bool is_better(const TriangleFit& before, const TriangleFit& after) {
  constexpr double least_gain = 0.005;
  return after.quality >= before.quality + least_gain && may_stand_for(before, after);
}

struct SurfaceTraits : OpenMesh::DefaultTraits {
  using Point = OpenMesh::Vec3d;
  VertexAttributes(OpenMesh::Attributes::Status);
  HalfedgeAttributes(OpenMesh::Attributes::Status | OpenMesh::Attributes::PrevHalfedge);
  EdgeAttributes(OpenMesh::Attributes::Status);
  FaceAttributes(OpenMesh::Attributes::Status);
};
using HalfedgeMesh = OpenMesh::TriMesh_ArrayKernelT<SurfaceTraits>;
using VertexHandle = HalfedgeMesh::VertexHandle;
using HalfedgeHandle = HalfedgeMesh::HalfedgeHandle;
using EdgeHandle = HalfedgeMesh::EdgeHandle;
using FaceHandle = HalfedgeMesh::FaceHandle;

/// The surface during remeshing.
///
/// All patches are in one halfedge mesh. Since it can hold only manifolds, patches are cut from each other along the
/// features. Each patch has its own copy of a vertex there, or several copies if it has several wedges at the vertex.
/// So an edge of the halfedge mesh is a boundary edge exactly if it lies on a feature. The copies are tied together by
/// *knots*: a knot is a vertex on a feature, or any other vertex that has several copies or must not move. Knots are
/// joined by links, the edges along the features, which may have any number of copies, or none if a segment is in no
/// facet.
struct WorkingMesh {
  /// The data of a vertex of the halfedge mesh.
  struct Vertex {
    std::uint32_t knot = none;
    std::uint32_t patch = none;
    std::uint32_t near = none;  ///< a triangle of the original surface near it
    Point3 normal;              ///< of the original surface, in its patch; of length one, or zero at a tip
    double wanted = 0;          ///< length of edges there
    bool is_frozen = false;     ///< a corner of a frozen face
  };

  struct Knot {
    Point3 position;
    bool is_fixed = false;             ///< must neither move nor be removed
    std::vector<std::uint32_t> links;  ///< two if it is not fixed
    std::vector<VertexHandle> copies;
    double wanted = 0;  ///< length of edges there
    bool is_alive = true;

    void replace_link(std::uint32_t link, std::uint32_t by) { *std::find(links.begin(), links.end(), link) = by; }
  };

  struct Link {
    std::array<std::uint32_t, 2> ends;  ///< knots
    std::uint32_t curve;
    std::array<double, 2> arc;  ///< where on the curve the ends are
    bool is_alive = true;

    int side_of(std::uint32_t knot) const { return ends[0] == knot ? 0 : 1; }
  };

  const OriginalSurface& original;
  const FeatureCurves& features;
  const ClosestPoint& closest;
  const sizes::SizeField& lengths;  ///< the given edge length, except where triangles have crossed
  const sizes::SizeField& shape;    ///< `lengths_of_shape`
  double deviation;                 ///< of edges and triangles from the original surface; infinite: any

  HalfedgeMesh mesh;
  std::vector<Vertex> vertices;      ///< by the index in the mesh
  std::vector<char> face_is_frozen;  ///< by the index in the mesh: keeps its shape
  std::vector<Knot> knots;
  std::vector<Link> links;

  Point3 point(VertexHandle v) const {
    const auto& p = mesh.point(v);
    return {p[0], p[1], p[2]};
  }
  void move(VertexHandle v, const Point3& p) { mesh.set_point(v, {p.x, p.y, p.z}); }
  Vertex& at(VertexHandle v) { return vertices[static_cast<std::size_t>(v.idx())]; }
  const Vertex& at(VertexHandle v) const { return vertices[static_cast<std::size_t>(v.idx())]; }
  bool is_frozen(const FaceHandle& f) const { return face_is_frozen[static_cast<std::size_t>(f.idx())] != 0; }
  bool is_flat(VertexHandle v) const { return original.patch_is_flat[at(v).patch] != 0; }
  bool is_tip(VertexHandle v) const { return at(v).normal == Point3{}; }

  std::array<VertexHandle, 2> ends(EdgeHandle e) const {
    return {mesh.to_vertex_handle(mesh.halfedge_handle(e, 0)), mesh.to_vertex_handle(mesh.halfedge_handle(e, 1))};
  }
  std::array<VertexHandle, 2> ends(HalfedgeHandle h) const {
    return {mesh.from_vertex_handle(h), mesh.to_vertex_handle(h)};
  }
  /// The triangle over a halfedge: its corners, from the start of the halfedge.
  std::array<VertexHandle, 3> corners(HalfedgeHandle h) const {
    return {mesh.from_vertex_handle(h), mesh.to_vertex_handle(h), mesh.to_vertex_handle(mesh.next_halfedge_handle(h))};
  }
  std::array<Point3, 3> points(const std::array<VertexHandle, 3>& v) const {
    return {point(v[0]), point(v[1]), point(v[2])};
  }

  double edge_length(VertexHandle a, VertexHandle b) const { return length(point(b) - point(a)); }
  double wanted_length(VertexHandle a, VertexHandle b) const { return 0.5 * (at(a).wanted + at(b).wanted); }
  double wanted_length(std::uint32_t knot, std::uint32_t other) const {
    return 0.5 * (knots[knot].wanted + knots[other].wanted);
  }
  double link_length(const Link& l) const { return length(knots[l.ends[1]].position - knots[l.ends[0]].position); }
};

/// \param frozen  by triangle of the original surface: must it stay as it is?
WorkingMesh make_working_mesh(const OriginalSurface& original, const FeatureCurves& features,
                              const ClosestPoint& closest, const sizes::SizeField& lengths,
                              const sizes::SizeField& shape, double deviation, const std::vector<char>& frozen);

/// A new vertex of the halfedge mesh in a patch: at the given foot, or a copy of a knot, at its position.
VertexHandle add_vertex(WorkingMesh& m, std::uint32_t patch, const Foot& foot, double wanted);
VertexHandle add_copy(WorkingMesh& m, std::uint32_t patch, std::uint32_t knot, std::uint32_t near);

/// The link between two knots; `none` if there is none.
std::uint32_t link_between(const WorkingMesh& m, std::uint32_t knot, std::uint32_t other);

/// Is there an edge between any copies of two knots, or a link?
bool are_joined(const WorkingMesh& m, std::uint32_t knot, std::uint32_t other);

/// The edges of the halfedge mesh that lie on a link.
std::vector<EdgeHandle> copies_of_link(const WorkingMesh& m, std::uint32_t link);

/// A knot that is not fixed, between its neighbors along its curve.
struct KnotOnCurve {
  std::array<std::uint32_t, 2> links;
  std::array<int, 2> sides;             ///< which end of each link it is
  std::array<std::uint32_t, 2> others;  ///< the knots at the other ends
  std::array<double, 2> arcs;           ///< of these
  std::uint32_t curve;
};

KnotOnCurve on_curve(const WorkingMesh& m, std::uint32_t knot);

/// Judging by the normals at its ends, could an edge between two vertices of a patch lie within the bound? An arc with
/// half-angle a has a sagitta of tan(a/2)/2 times its chord, and its ends turn by a away from the chord.
bool runs_along_surface(const WorkingMesh& m, VertexHandle a, VertexHandle b);

/// Is the middle of an edge between two vertices of a patch, or between one and a possible position of another, within
/// the bound?
bool is_near_surface(const WorkingMesh& m, VertexHandle a, const Point3& q, double most = most_deviation);
inline bool is_near_surface(const WorkingMesh& m, VertexHandle a, VertexHandle b) {
  return is_near_surface(m, a, m.point(b));
}

inline TriangleFit fit_of(const WorkingMesh& m, const std::array<VertexHandle, 3>& v,
                          TriangleMeasure measure = TriangleMeasure::area) {
  return fit_of(m.points(v), {m.at(v[0]).normal, m.at(v[1]).normal, m.at(v[2]).normal}, measure);
}

/// The surface as a PLC: with the name, holes and regions of the input, and with markers if it has any.
plc::InputPlc to_plc(const WorkingMesh& m, const plc::InputPlc& input);

/// \name The steps of isotropic remeshing (Botsch and Kobbelt 2004), each over the whole surface.
/// An operation is skipped if it would turn a triangle away from the original surface, make a triangle worse than a
/// limit, or merge two edges.
/// @{

/// Gives every vertex and knot the wanted edge length (`lengths` and `shape`), but less around much shorter edges that
/// could not be collapsed because the surface is too narrow or too strongly curved there: longer edges beside these
/// would turn the triangles into needles. Short edges at features cost a limited number of triangles.
///
/// \param is_remeshed  false for the original mesh: its short edges and narrow strips do not count yet
void find_wanted_lengths(WorkingMesh& m, bool is_remeshed);

/// Splits edges longer than 4/3 of the wanted length, until there are none; new vertices lie on the original surface.
void split_long_edges(WorkingMesh& m);

/// Collapses edges shorter than 4/5 of the wanted length, unless this makes an edge longer than 4/3 of it.
void collapse_short_edges(WorkingMesh& m);

/// Flips edges so that vertices approach their ideal number of neighbors: six, or fewer on a feature, depending on the
/// angle there.
void flip_edges_for_valence(WorkingMesh& m);

/// Flips edges if that improves the worse of the two triangles.
void flip_edges_for_quality(WorkingMesh& m);

/// Moves vertices toward the center of their neighborhood, along the original surface or along their feature.
void relax_vertices(WorkingMesh& m);
/// @}

/// \name Changes around bad triangles: each is made only if it increases the smallest angle of all affected triangles.
/// \return whether it was made
/// @{
bool improve_by_flip(WorkingMesh& m, EdgeHandle e);
bool improve_by_collapse(WorkingMesh& m, HalfedgeHandle h);  ///< collapses the start of the halfedge to its end
bool improve_by_move(WorkingMesh& m, VertexHandle v);        ///< along the surface, or along the feature it is on
/// @}

}  // namespace ccdt::surface
