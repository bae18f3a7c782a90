#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "engine/base/index.h"
#include "engine/base/point.h"
#include "engine/planar/triangulation.h"
#include "engine/plc/plane_steps.h"
#include "engine/plc/plc.h"

namespace ccdt::refine {

/// Exact planar predicates within a facet (a model of `planar::Predicates`). A facet that is flat only within the
/// tolerance is flattened: its vertices are seen along the axis that its normal is nearest to, stretched to their true
/// distances and rounded, which gives points that are exactly in one plane.
class FacetPlane {
 public:
  /// \param points  of all vertices, also of those to come; must outlive this
  FacetPlane(const plc::Facet& facet, const std::vector<Point3>& points);

  int orient(VertexId a, VertexId b, VertexId c) const;
  int incircle(VertexId a, VertexId b, VertexId c, VertexId d) const;

 private:
  Point3 at(VertexId v) const;
  Point3 flattened(const Point3& p) const;

  const std::vector<Point3>& points_;
  bool exactly_flat_;
  Point3 normal_, apex_;
  int axis_;                                   ///< that the normal is nearest to
  double first_ = 1, shear_ = 0, second_ = 1;  ///< how the other two coordinates are stretched
};

/// Where a walk towards a point ended: in a triangle that has it, or at an edge that it may not cross.
struct WalkEnd {
  std::uint32_t triangle = planar::none;  ///< none: the walk gave up
  std::optional<planar::Side> wall;
};

/// The constrained Delaunay triangulation of a facet, which takes vertices in.
class FacetTriangulation {
 public:
  /// \param segments  edges of the facet's triangles
  FacetTriangulation(const plc::Facet& facet, const std::vector<planar::Edge>& segments,
                     const std::vector<Point3>& points);

  const planar::Triangulation& triangulation() const { return t_; }
  const FacetPlane& plane() const { return plane_; }

  /// The point nearest to this one that is exactly in the facet and has integer coordinates; nothing if it is further
  /// away than that.
  std::optional<Point3> snap(const Point3& p, double furthest) const;

  /// Walks from a triangle towards a vertex that is not part of the triangulation yet.
  WalkEnd walk(std::uint32_t from, VertexId to) const;

  /// A triangle that has a vertex which is not part of the triangulation yet.
  std::uint32_t find(VertexId v) const { return planar::locate(t_, v, plane_); }

  /// Takes a vertex in that is in this triangle or on an edge of it. False, and nothing has changed, if it is at a
  /// corner or on an edge that is constrained.
  bool insert(VertexId v, std::uint32_t triangle);

  /// Takes a vertex in that is on the edge ab.
  bool split(VertexId a, VertexId b, VertexId v) { return planar::split_edge(t_, a, b, v, plane_); }

 private:
  /// The triangle of the facet as it was, over or under which the point is, and the steps in its plane.
  struct Patch {
    std::array<Point3, 3> corners;
    plc::PlaneSteps steps;
  };

  FacetPlane plane_;
  planar::Triangulation t_;
  std::vector<Patch> patches_;  ///< of an exactly flat facet: one for all
};

}  // namespace ccdt::refine
