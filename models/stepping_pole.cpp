#include <array>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "models/parts.h"
#include "models/patch.h"
#include "models/revolve.h"

namespace ccdt::models {
namespace {

// Millimeters; the axis is z, from the stub at the bottom to the cap at the top.
constexpr double stub_end = -30;
constexpr double thread_radius = 7;  // of the thread's crests
constexpr double thread_depth = 1.5;
constexpr double thread_pitch = 3.5;
constexpr int thread_turns = 7;
constexpr double hexagon_radius = 17;  // to its corners
constexpr double hexagon_top = 8;
constexpr double collar_radius = 22;  // of the collar below and of the cap above the grip
constexpr double collar_top = 13;
constexpr int teeth = 12;
constexpr double tooth_radius = 18;
constexpr double root_radius = 15;
constexpr double cap_bottom = 78;
constexpr double cap_top = 87;
constexpr double cap_fillet = 4;
constexpr double bore_mouth = 9;  // radius of the chamfer
constexpr double bore_radius = 7.5;
constexpr double bore_bottom = 45;
constexpr double bore_tip = 41;  // of the cone that the drill leaves

enum Marker { thread = 1, hexagon, collar, tooth, root, flank, cap, bore };

double narrow_arc() {
  return root_radius * 10 * std::numbers::pi / 180;
}

Revolution around_axis(double edge_length, Marker marker) {
  return {Axis::z, {}, edge_length, marker};
}

/// A prism's side faces are between these lines; its outline at both ends.
struct Outline {
  std::vector<Chain> pieces;  // counterclockwise

  Chain loop() const { return closed_loop(pieces); }
};

/// The teeth are 30 degrees apart: 10 degrees of tip, 5 of flank, 10 of root, 5 of flank, the first tip about angle 0.
Outline tooth_outline(ModelSurface& surface, double height, double edge_length) {
  const double spacing = spacing_beside(edge_length, narrow_arc());
  const Point3 center{0, 0, height};
  Outline outline;
  for (int i = 0; i < teeth; ++i) {
    const double middle = 360.0 * i / teeth;
    const auto tip = on_circle(Axis::z, center, tooth_radius, middle + 5);
    const auto foot = on_circle(Axis::z, center, root_radius, middle + 10);
    const auto next_foot = on_circle(Axis::z, center, root_radius, middle + 20);
    const double next = 360.0 * ((i + 1) % teeth) / teeth;
    const auto next_tip = on_circle(Axis::z, center, tooth_radius, next - 5);
    outline.pieces.push_back(arc(surface, Axis::z, center, tooth_radius, middle - 5, middle + 5, spacing));
    outline.pieces.push_back(line(surface, tip, foot, spacing));
    outline.pieces.push_back(arc(surface, Axis::z, center, root_radius, middle + 10, middle + 20, spacing));
    outline.pieces.push_back(line(surface, next_foot, next_tip, spacing));
  }
  return outline;
}

Outline hexagon_outline(ModelSurface& surface, double height, double spacing) {
  Outline outline;
  for (int i = 0; i < 6; ++i) {
    outline.pieces.push_back(line(surface, on_circle(Axis::z, {0, 0, height}, hexagon_radius, 60 * i),
                                  on_circle(Axis::z, {0, 0, height}, hexagon_radius, 60 * ((i + 1) % 6)), spacing));
  }
  return outline;
}

/// The plane through two vertical lines, seen from outside when `to` is counterclockwise of `from`.
Chart side_plane(const Point3& from, const Point3& to) {
  const Point3 along = to - from;
  const double size = std::hypot(along.x, along.y);
  return plane_chart(from, {along.y / size, -along.x / size, 0});
}

/// The side faces of a prism between equal outlines. `chart_and_marker(i)` tells how piece i is laid out and marked.
template <class ChartAndMarker>
void add_sides(ModelSurface& surface, const Outline& lower, const Outline& upper, double spacing, double edge_length,
               const ChartAndMarker& chart_and_marker) {
  const auto count = lower.pieces.size();
  std::vector<Chain> lines;
  for (std::size_t i = 0; i < count; ++i) {
    const Point3 bottom = surface.vertices[lower.pieces[i].front()];
    const Point3 top = surface.vertices[upper.pieces[i].front()];
    lines.push_back(line(surface, bottom, top, spacing));
  }
  for (std::size_t i = 0; i < count; ++i) {
    const std::array loop{lower.pieces[i], lines[(i + 1) % count], reversed(upper.pieces[i]), reversed(lines[i])};
    const auto [chart, marker] = chart_and_marker(i);
    add_patch(surface, {chart, {closed_loop(loop)}, {}, edge_length, marker});
  }
}

void add_grip(ModelSurface& surface, const Outline& lower, const Outline& upper, double edge_length) {
  const auto chart_and_marker = [&](std::size_t i) -> std::pair<Chart, Marker> {
    const std::size_t tooth_number = i / 4;
    const double middle = 360.0 / teeth * static_cast<double>(tooth_number);
    if (i % 4 == 0) return {cylinder_chart(Axis::z, {}, tooth_radius, middle, OuterSide::away_from_axis), tooth};
    if (i % 4 == 2) return {cylinder_chart(Axis::z, {}, root_radius, middle + 15, OuterSide::away_from_axis), root};
    const Chain& piece = lower.pieces[i];
    return {side_plane(surface.vertices[piece.front()], surface.vertices[piece.back()]), flank};
  };
  add_sides(surface, lower, upper, spacing_beside(edge_length, narrow_arc()), edge_length, chart_and_marker);
}

void add_hexagon(ModelSurface& surface, const Outline& lower, const Outline& upper, double edge_length) {
  const auto chart_and_marker = [&](std::size_t i) -> std::pair<Chart, Marker> {
    const Chain& piece = lower.pieces[i];
    return {side_plane(surface.vertices[piece.front()], surface.vertices[piece.back()]), hexagon};
  };
  add_sides(surface, lower, upper, spacing_beside(edge_length, hexagon_radius / 4), edge_length, chart_and_marker);
}

/// A plane face between two closed curves, which faces up the axis (`outward`) or down.
void add_face(ModelSurface& surface, const Chain& outer, const Chain& inner, double height, OuterSide up,
              double edge_length, Marker marker) {
  const Chart chart = plane_chart({0, 0, height}, {0, 0, up == OuterSide::away_from_axis ? 1.0 : -1.0});
  add_patch(surface, {chart, {outer, inner}, {}, edge_length, marker});
}

/// From the pole at the end of the stub to the ring where the stub meets the hexagon.
Ring add_stub(ModelSurface& surface, double edge_length) {
  const double flank_length = std::hypot(thread_depth, thread_pitch / 2);
  const double spacing = spacing_beside(edge_length, flank_length);
  const Revolution revolution = around_axis(edge_length, thread);
  const double core = thread_radius - thread_depth;
  std::vector<ProfilePoint> profile{{core, stub_end}};
  for (int i = 0; i < thread_turns; ++i) {
    profile.push_back({thread_radius, stub_end + (i + 0.5) * thread_pitch});
    profile.push_back({core, stub_end + (i + 1.0) * thread_pitch});
  }
  profile.push_back({core, 0});
  Ring before = ring(surface, Axis::z, {}, 0, stub_end, spacing);
  for (const ProfilePoint& p : profile) {
    const Ring next = ring(surface, Axis::z, {}, p.radius, p.height, spacing);
    add_cone(surface, before, next, revolution);
    before = next;
  }
  return before;
}

/// From the edge of the cap above the grip to the tip of the bore.
void add_cap(ModelSurface& surface, const Ring& edge, double edge_length) {
  const double fine = spacing_beside(edge_length, cap_top - cap_fillet - cap_bottom);
  const double chamfer = bore_mouth - bore_radius;
  const double mouth_spacing = spacing_beside(edge_length, chamfer * std::numbers::sqrt2);
  const auto circle = [&](double radius, double height, double spacing) {
    return ring(surface, Axis::z, {}, radius, height, spacing);
  };
  const Ring fillet_start = circle(collar_radius, cap_top - cap_fillet, fine);
  const Ring fillet_end = circle(collar_radius - cap_fillet, cap_top, fine);
  const Ring mouth = circle(bore_mouth, cap_top, mouth_spacing);
  const Ring inner_mouth = circle(bore_radius, cap_top - chamfer, mouth_spacing);
  const Ring bottom = circle(bore_radius, bore_bottom, edge_length);
  const Profile fillet = round_profile({collar_radius - cap_fillet, cap_top - cap_fillet}, cap_fillet, 0, 90);
  add_cone(surface, edge, fillet_start, around_axis(edge_length, cap));
  add_revolution(surface, fillet_start, fillet_end, fillet, around_axis(edge_length, cap));
  add_cone(surface, fillet_end, mouth, around_axis(edge_length, cap));
  add_cone(surface, mouth, inner_mouth, around_axis(edge_length, bore));
  add_cone(surface, inner_mouth, bottom, around_axis(edge_length, bore));
  add_cone(surface, bottom, circle(0, bore_tip, edge_length), around_axis(edge_length, bore));
}

}  // namespace

plc::InputPlc make_stepping_pole(double edge_length) {
  ModelSurface surface;
  const double collar_spacing = spacing_beside(edge_length, collar_radius - tooth_radius);
  const auto collar_ring = [&](double height) {
    return ring(surface, Axis::z, {}, collar_radius, height, collar_spacing);
  };
  const Ring neck = add_stub(surface, edge_length);

  const double hexagon_spacing = spacing_beside(edge_length, hexagon_radius / 4);  // at least two edges per side
  const Outline hexagon_lower = hexagon_outline(surface, 0, hexagon_spacing);
  const Outline hexagon_upper = hexagon_outline(surface, hexagon_top, hexagon_spacing);
  const Ring collar_lower = collar_ring(hexagon_top), collar_upper = collar_ring(collar_top);
  add_face(surface, hexagon_lower.loop(), neck.chain, 0, OuterSide::towards_axis, edge_length, hexagon);
  add_hexagon(surface, hexagon_lower, hexagon_upper, edge_length);
  add_face(surface, collar_lower.chain, hexagon_upper.loop(), hexagon_top, OuterSide::towards_axis, edge_length,
           collar);
  add_cone(surface, collar_lower, collar_upper, around_axis(edge_length, collar));

  const Outline grip_lower = tooth_outline(surface, collar_top, edge_length);
  const Outline grip_upper = tooth_outline(surface, cap_bottom, edge_length);
  const Ring cap_edge = collar_ring(cap_bottom);
  add_face(surface, collar_upper.chain, grip_lower.loop(), collar_top, OuterSide::away_from_axis, edge_length, collar);
  add_grip(surface, grip_lower, grip_upper, edge_length);
  add_face(surface, cap_edge.chain, grip_upper.loop(), cap_bottom, OuterSide::towards_axis, edge_length, cap);
  add_cap(surface, cap_edge, edge_length);
  return to_input(std::move(surface), plc::InputPlc::Inside::even_odd);
}

}  // namespace ccdt::models
