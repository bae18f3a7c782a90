#pragma once

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <array>
#include <cstdint>
#include <vector>

#include "engine/surface/closest_point.h"
#include "engine/surface/curve_lengths.h"
#include "engine/surface/edge_lengths.h"
#include "engine/surface/feature_curves.h"
#include "engine/surface/original_surface.h"

namespace ccdt {

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

/// The surface while it is being remeshed.
///
/// All patches are in one halfedge mesh, which can only hold manifolds: they are cut from each other along the
/// features, and every patch (every wedge, where one patch is there several times) has a copy of its own of the
/// vertices there. So an edge of the halfedge mesh is a boundary edge exactly if it lies on a feature. The copies are
/// tied together by *knots*: a knot is a vertex on a feature, or any other vertex that has several copies or must not
/// move. Knots are joined by links, the edges along the features, which may have any number of copies: also none, when
/// a segment is in no facet.
struct WorkingMesh {
  static constexpr std::uint32_t none = 0xFFFFFFFFu;

  /// What is known of a vertex of the halfedge mesh.
  struct Vertex {
    std::uint32_t knot = none;
    std::uint32_t patch = none;
    std::uint32_t near = none;  ///< a triangle of the original surface near to it
    Point3 normal;              ///< of the original surface, in its patch; of length one
    double wanted = 0;          ///< length of edges there
    bool is_frozen = false;     ///< a corner of a frozen face
  };

  struct Knot {
    Point3 position;
    bool is_fixed = false;             ///< must neither move nor go
    std::vector<std::uint32_t> links;  ///< two if it is not fixed
    std::vector<VertexHandle> copies;
    double wanted = 0;  ///< length of edges there
    bool is_alive = true;
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
  const EdgeLengths& lengths;
  const CurveLengths& curve_lengths;

  HalfedgeMesh mesh;
  std::vector<Vertex> vertices;      ///< by the index of the mesh's
  std::vector<char> face_is_frozen;  ///< by the index of the mesh's: keeps its shape
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
  double edge_length(VertexHandle a, VertexHandle b) const { return length(point(b) - point(a)); }
  double wanted_length(VertexHandle a, VertexHandle b) const { return 0.5 * (at(a).wanted + at(b).wanted); }
  double wanted_length(std::uint32_t knot, std::uint32_t other) const {
    return 0.5 * (knots[knot].wanted + knots[other].wanted);
  }
};

/// \param frozen  by triangle of the original surface: must stay as it is
WorkingMesh make_working_mesh(const OriginalSurface& original, const FeatureCurves& features,
                              const ClosestPoint& closest, const EdgeLengths& lengths,
                              const CurveLengths& curve_lengths, const std::vector<char>& frozen);

/// A new vertex of the halfedge mesh in a patch, at the foot of the given point or, on a knot, at its position.
VertexHandle add_vertex(WorkingMesh& m, std::uint32_t patch, const Foot& foot, double wanted);
VertexHandle add_copy(WorkingMesh& m, std::uint32_t patch, std::uint32_t knot, std::uint32_t near);

/// Is there an edge between any copies of two knots, or a link?
bool are_joined(const WorkingMesh& m, std::uint32_t knot, std::uint32_t other);

/// The edges of the halfedge mesh that lie on a link.
std::vector<EdgeHandle> copies_of_link(const WorkingMesh& m, std::uint32_t link);

/// The surface as a PLC: with the name, holes and regions of the input, and with markers where it has some.
InputPlc to_plc(const WorkingMesh& m, const InputPlc& input);

}  // namespace ccdt
