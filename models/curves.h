#pragma once

#include <functional>

#include "models/model_surface.h"

namespace ccdt::models {

/// An axis of rotation. The local axes keep the handedness: around z they are (x, y, z), around x (y, z, x), around y
/// (z, x, y).
enum class Axis { x, y, z };

/// From local coordinates of an axis to those of the model. It only permutes, so it is exact.
Point3 to_model(Axis axis, const Point3& local);
/// The inverse of `to_model`.
Point3 to_local(Axis axis, const Point3& model);

/// Cosine of an angle in degrees, exact at multiples of 90.
double cosine(double degrees);
/// Sine of an angle in degrees, exact at multiples of 90.
double sine(double degrees);

/// The point of a circle around an axis, at an angle in degrees from the first local axis.
Point3 on_circle(Axis axis, const Point3& center, double radius, double degrees);

/// A circle is never cut into fewer edges than this.
inline constexpr int least_edges_of_circle = 12;

/// The edge length for a curve at the border of a patch of this width: at most 1.75 times the width, so that a strip of
/// one row of triangles has no angle below 29 degrees.
double spacing_beside(double edge_length, double width);

/// Cuts the straight line between two corners into equal parts of about `spacing`.
Chain line(ModelSurface& surface, const Point3& from, const Point3& to, double spacing);

/// Cuts a curve between two corners into parts of equal arc length of about `spacing`.
///
/// \param position     the curve for a parameter from 0 to 1; its ends are the corners
/// \param least_parts  the least number of parts
Chain curve(ModelSurface& surface, const Point3& from, const Point3& to, const std::function<Point3(double)>& position,
            double spacing, int least_parts);

/// Cuts an arc between two angles (degrees, either direction) into equal parts of about `spacing`.
Chain arc(ModelSurface& surface, Axis axis, const Point3& center, double radius, double from, double to,
          double spacing);

/// A circle around an axis, counterclockwise seen from the end of the axis. A radius of 0 is a pole with one vertex.
struct Ring {
  Chain chain;
  double radius = 0;
  double height = 0;  ///< coordinate along the axis

  double spacing() const;
};

/// Cuts a circle into a multiple of four equal parts of about `spacing`, with a vertex at angle 0. `center` is any
/// point of the axis.
Ring ring(ModelSurface& surface, Axis axis, const Point3& center, double radius, double height, double spacing);

/// The open part of a ring between two quarter turns (0 to 4, counterclockwise, may go past 4).
Chain part_of(const Ring& ring, int from_quarter, int to_quarter);

}  // namespace ccdt::models
