#pragma once

#include "engine/base/progress.h"
#include "engine/plc/input.h"
#include "engine/surface/options.h"

namespace ccdt::surface {

/// Replaces the triangles of a surface by nearly equilateral ones with edges of nearly one length: in rounds of edge
/// splits, collapses, flips and tangential relaxation, each projected back to the original surface (Botsch and Kobbelt,
/// "A remeshing approach to multiresolution modeling", 2004).
///
/// The following keep their shape: sharp edges, edges with one facet or more than two, borders between facets of
/// different markers, and the segments of the input. All of these get new vertices along themselves. Their corners, and
/// the vertices that the input lists without using them, stay as points. Flat patches stay flat. Facet markers,
/// segments with their markers, holes and regions are preserved.
///
/// No triangle is turned over or made worse than a limit. Edges are shorter where features are short or near each
/// other, where the surface is curved, and where another sheet is opposite, through the solid or a gap. They grow
/// gently from there, so that neither needles nor flat tetrahedra are needed. All these short edges make at most about
/// four times as many triangles as the given edge length alone would, or 10,000 if that is more; beyond that, the
/// shortest become longer. At the end, the worst triangles are improved one by one: angles below 30 degrees remain only
/// at sharp corners and where the surface is rough. If triangles of the result still cross, the edges there become
/// shorter. If that does not help, the old triangles stay there. The result always builds (`build_plc`).
///
/// With a deviation, bends between wide facets are kept as well (`turns_of_wide_bends`), edges are as short as the
/// curvature wants, whatever that costs, and places that are still too far away are treated like crossings.
///
/// \return  triangles and segments only; vertices are numbered anew
/// \throw InputError  the input is not a valid PLC, or an option is out of range
/// \throw LimitError  the new surface would have too many triangles
/// \throw MeshError   no valid surface was found at this edge length; with the place
plc::InputPlc remesh_surface(const plc::InputPlc& input, const RemeshOptions& options, const Progress& progress = {});

}  // namespace ccdt::surface
