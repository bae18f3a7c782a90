#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "engine/base/index.h"
#include "engine/base/point.h"
#include "engine/planar/triangulation.h"
#include "engine/plc/facet_frame.h"
#include "engine/plc/plane_steps.h"
#include "engine/plc/plc.h"

namespace ccdt::refine {

/// Exact planar predicates within a facet (a model of `planar::Predicates`).
class FacetPlane {
 public:
  /// \param points  of all vertices, including those that come later; must outlive this
  FacetPlane(std::span<const std::array<VertexId, 3>> triangles, bool exactly_flat, const std::vector<Point3>& points);

  int orient(VertexId a, VertexId b, VertexId c) const;
  int incircle(VertexId a, VertexId b, VertexId c, VertexId d) const;

 private:
  Point3 at(VertexId v) const { return exactly_flat_ ? points_[v] : frame_.flattened(points_[v]); }

  const std::vector<Point3>& points_;
  bool exactly_flat_;
  plc::FacetFrame frame_;
  Point3 apex_;
};

/// Where a walk toward a point ended: in a triangle that contains it, or at an edge that it must not cross.
struct WalkEnd {
  std::uint32_t triangle = none;  ///< none: the walk gave up
  std::optional<planar::Side> wall;
};

/// The constrained Delaunay triangulation of a facet, to which vertices can be added.
class FacetTriangulation {
 public:
  /// \param triangles  of the facet
  /// \param segments   edges of these
  FacetTriangulation(std::span<const std::array<VertexId, 3>> triangles, bool exactly_flat,
                     const std::vector<planar::Edge>& segments, const std::vector<Point3>& points);

  const planar::Triangulation& triangulation() const { return t_; }
  const FacetPlane& plane() const { return plane_; }

  /// A point near this one that is exactly in the facet and has integer coordinates; nothing if it is more than
  /// `farthest` away.
  std::optional<Point3> snap(const Point3& p, double farthest) const;

  /// Walks from a triangle toward a vertex that is not part of the triangulation yet.
  WalkEnd walk(std::uint32_t from, VertexId to) const;

  /// A triangle that contains a vertex that is not part of the triangulation yet.
  std::uint32_t find(VertexId v) const { return planar::locate(t_, v, plane_); }

  /// Adds a vertex in this triangle or on an edge of it. False, without any change, if it is at a corner or on a
  /// constrained edge.
  bool insert(VertexId v, std::uint32_t triangle);

  /// Adds a vertex on the edge ab.
  bool split(VertexId a, VertexId b, VertexId v) { return planar::split_edge(t_, a, b, v, plane_); }

 private:
  /// A triangle of the original facet, and the steps in its plane.
  struct Patch {
    std::array<Point3, 3> corners;
    plc::PlaneSteps steps;
  };

  FacetPlane plane_;
  planar::Triangulation t_;
  std::vector<Patch> patches_;  ///< one for all in an exactly flat facet
};

}  // namespace ccdt::refine
