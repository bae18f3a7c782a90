#pragma once

#include "engine/sizes/size_field.h"
#include "engine/surface/feature_curves.h"
#include "engine/surface/original_surface.h"

namespace ccdt::surface {

/// The growth of the wanted edge length per unit of distance from a place where shorter edges are wanted.
inline constexpr double length_growth = 0.3;

/// The largest distance between the middle of an edge and the original surface or feature, as a fraction of its length:
/// a circle keeps at least eighteen edges.
inline constexpr double most_deviation = 0.044;

/// The same for the edges that improve bad triangles: a circle keeps fifteen edges.
inline constexpr double most_deviation_of_improved = 0.055;

/// The edge lengths that the shape of a surface allows: short curves between corners stay single edges, long ones
/// need edges that stay near them (`most_deviation`), and edges fit the thickness of solids and of gaps between curved
/// sheets.
///
/// \param plc        that the surface was cut from
/// \param usual      the edge length wanted where the shape does not need less
/// \param deviation  edges are at most this far from features; infinite: any
sizes::SizeField lengths_of_shape(const plc::Plc& plc, const OriginalSurface& surface, const FeatureCurves& features,
                                  double usual, double deviation);

}  // namespace ccdt::surface
