#pragma once

#include "engine/base/progress.h"
#include "engine/plc/input.h"

namespace ccdt::surface {

struct RemeshOptions {
  double edge_length = 0;  ///< target, in the units of the input; has to be positive

  /// In degrees: an edge between two facets whose normals differ by more is kept as an edge. At 30 a circle of twelve
  /// edges or more counts as round, which is as coarse as programs for design draw one, and a chamfer of 45 degrees is
  /// still kept.
  double sharp_angle = 30;

  int iterations = 8;      ///< rounds of split, collapse, flip and relaxation
  double flatness = 1e-8;  ///< see PlcOptions
};

/// Replaces the triangles of a surface by ones that are nearly equilateral with edges of nearly one length, by rounds
/// of edge splits, collapses, flips and tangential relaxation, each projected back to the surface as it was (Botsch and
/// Kobbelt, "A remeshing approach to multiresolution modeling", 2004).
///
/// Kept are, as shapes, sharp edges, edges where one facet ends or more than two meet, borders between facets of
/// different markers and the segments of the input (all of these are divided anew, along themselves), and, as points,
/// their corners and the vertices that the input lists without using them. Flat patches stay flat. Facet markers,
/// segments with their markers, holes and regions go through.
///
/// No triangle is turned over or made worse than a limit. Edges are shorter where features are short or near to each
/// other, where the surface is curved, and where another sheet is opposite of it, through the solid or through a gap;
/// they grow gently from there, so no needles and no flat tetrahedra are needed. At the end the worst triangles are
/// improved one by one: angles below 30 degrees are left at sharp corners and where the surface is rough. Where
/// triangles of the result would cross all the same, that place gets shorter edges, and, if that does not help, its old
/// triangles. The result always builds (`build_plc`).
///
/// \return  triangles and segments only; vertices are numbered anew
/// \throw InputError  the input is no valid PLC, or an option is out of range
/// \throw MeshError   no valid surface was found at this edge length; with the place
plc::InputPlc remesh_surface(const plc::InputPlc& input, const RemeshOptions& options, const Progress& progress = {});

}  // namespace ccdt::surface
