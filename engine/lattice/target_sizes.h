#pragma once

#include "engine/lattice/domain_surface.h"
#include "engine/sizes/size_field.h"
#include "engine/sizes/wanted_sizes.h"

namespace ccdt::lattice {

/// The target edge length of interior points.
struct TargetSizes {
  sizes::SizeField field;
  /// The length in most of the mesh: the user's edge length, or the mean of the surface, or the median of the
  /// background (weighted by the points of a mesh of these sizes).
  double reference;
};

/// Without a background, the target is the least over the surface of (edge length there + grading * distance). The
/// surface is sampled at its vertices (mean length of the edges there) and the centroids of its triangles (mean of
/// their edges). With a background of vertices alone: the least over these of (size + grading * distance). With a
/// background mesh: linear within its tetrahedra (`sizes::InterpolatedSizes`). Either way, at most the edge length, if
/// one is given, and at most what is wanted at other places.
///
/// In grid units. Without a background, a grading of 0 means uniform.
/// \param edge_length     0: none
/// \param wanted          must outlive the result; null or empty: nothing
/// \param surface_factor  of the edge lengths of the surface
TargetSizes target_sizes(const DomainSurface& surface, double edge_length, double grading,
                         const sizes::WantedSizes* wanted = nullptr, double surface_factor = 1);

}  // namespace ccdt::lattice
