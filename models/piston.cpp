#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "models/parts.h"
#include "models/patch.h"
#include "models/revolve.h"

namespace ccdt::models {
namespace {

// Millimeters; the axis is z, the pin's axis is parallel to x.
constexpr double radius = 40;         // of the outside
constexpr double height = 70;         // of the crown above the rim of the skirt
constexpr double groove_radius = 36;  // of the grooves' floors
constexpr double groove_width = 4;    // and that of the lands between them
constexpr double skirt_top = 43;      // where the lowest groove begins
constexpr double cavity_radius = 32;  // of the hollow
constexpr double cavity_top = 58;     // its ceiling
constexpr double cavity_fillet = 6;   // between its wall and its ceiling
constexpr double bowl_radius = 24;    // of the rim of the combustion bowl
constexpr double bowl_depth = 5;
constexpr double pin_radius = 9;
constexpr double pin_height = 22;  // of its axis
constexpr double boss_radius = 15;
constexpr double boss_face = 14;  // distance of the bosses' faces from the piston's axis

enum Marker { crown = 1, bowl, land, groove, skirt, rim, cavity, pin_bore, boss };

/// The two circles of a hole around the pin's axis on one side: one in the plane of the boss's face and one on a
/// cylinder around the piston's axis, both in halves that begin at angle 0 and 180 (toward +y and -y).
struct PinTube {
  Ring circle;
  std::array<Chain, 2> on_cylinder;
  Chain seam_plus_y, seam_minus_y;  // from the circle to the cylinder
};

PinTube pin_tube(ModelSurface& surface, double side, double tube_radius, double cylinder_radius, double spacing) {
  const auto on_cylinder = [=](double degrees) {
    const double y = tube_radius * cosine(degrees);
    return Point3{side * std::sqrt(cylinder_radius * cylinder_radius - y * y), y,
                  pin_height + tube_radius * sine(degrees)};
  };
  PinTube tube;
  tube.circle = ring(surface, Axis::x, {0, 0, pin_height}, tube_radius, side * boss_face, spacing);
  for (int half = 0; half < 2; ++half) {
    const double start = 180.0 * half;
    tube.on_cylinder[static_cast<std::size_t>(half)] = curve(
        surface, on_cylinder(start), on_cylinder(start + 180), [=](double t) { return on_cylinder(start + 180 * t); },
        spacing, least_edges_of_circle / 2);
  }
  const auto& halves = tube.on_cylinder;
  const auto at = [&](std::uint32_t id) { return surface.vertices[id]; };
  const Point3 from_plus = at(tube.circle.chain[0]), from_minus = at(tube.circle.chain[tube.circle.chain.size() / 2]);
  tube.seam_plus_y = line(surface, from_plus, at(halves[0].front()), spacing);
  tube.seam_minus_y = line(surface, from_minus, at(halves[1].front()), spacing);
  return tube;
}

Chain hole_of(const PinTube& tube) {
  return closed_loop(tube.on_cylinder);
}

void add_tube_wall(ModelSurface& surface, const PinTube& tube, double tube_radius, OuterSide outer_side,
                   double edge_length, Marker marker) {
  for (int half = 0; half < 2; ++half) {
    const Chain& start = half == 0 ? tube.seam_plus_y : tube.seam_minus_y;
    const Chain& end = half == 0 ? tube.seam_minus_y : tube.seam_plus_y;
    const std::array loop{part_of(tube.circle, 2 * half, 2 * half + 2), end,
                          reversed(tube.on_cylinder[static_cast<std::size_t>(half)]), reversed(start)};
    const Chart chart = cylinder_chart(Axis::x, {0, 0, pin_height}, tube_radius, 90 + 180 * half, outer_side);
    add_patch(surface, {chart, {closed_loop(loop)}, {}, edge_length, marker});
  }
}

/// A cylinder around the piston's axis between two rings. Each half (toward +x and -x) has a hole for the pin.
void add_pierced_cylinder(ModelSurface& surface, const Ring& lower, const Ring& upper,
                          const std::array<Chain, 2>& holes, OuterSide outer_side, double edge_length, Marker marker) {
  const Point3 plus{0, lower.radius, 0}, minus{0, -lower.radius, 0};
  const auto seam = [&](const Point3& side) {
    return line(surface, {side.x, side.y, lower.height}, {side.x, side.y, upper.height}, edge_length);
  };
  const Chain plus_y = seam(plus), minus_y = seam(minus);
  for (int half = 0; half < 2; ++half) {
    const int quarter = half == 0 ? 3 : 1;
    const Chain& start = half == 0 ? minus_y : plus_y;
    const Chain& end = half == 0 ? plus_y : minus_y;
    const std::array loop{part_of(lower, quarter, quarter + 2), end, reversed(part_of(upper, quarter, quarter + 2)),
                          reversed(start)};
    const Chart chart = cylinder_chart(Axis::z, {}, lower.radius, 180 * half, outer_side);
    add_patch(surface, {chart, {closed_loop(loop), holes[static_cast<std::size_t>(half)]}, {}, edge_length, marker});
  }
}

/// The lands and grooves from the top of the skirt to the edge of the crown. \return the ring of that edge
Ring add_ring_belt(ModelSurface& surface, const Ring& top_of_skirt, double edge_length) {
  const double fine = spacing_beside(edge_length, groove_width);
  const std::array<ProfilePoint, 12> profile{{{groove_radius, 43},
                                              {groove_radius, 47},
                                              {radius, 47},
                                              {radius, 51},
                                              {groove_radius, 51},
                                              {groove_radius, 55},
                                              {radius, 55},
                                              {radius, 59},
                                              {groove_radius, 59},
                                              {groove_radius, 63},
                                              {radius, 63},
                                              {radius, height}}};
  Ring before = top_of_skirt;
  for (const ProfilePoint& corner_point : profile) {
    const Ring next = ring(surface, Axis::z, {}, corner_point.radius, corner_point.height, fine);
    const bool is_land = before.radius == radius && next.radius == radius;
    add_cone(surface, before, next, {Axis::z, {}, edge_length, is_land ? land : groove});
    before = next;
  }
  return before;
}

void add_crown(ModelSurface& surface, const Ring& edge, double edge_length) {
  const double sphere = (bowl_radius * bowl_radius + bowl_depth * bowl_depth) / (2 * bowl_depth);
  const double rim_angle = std::asin(bowl_radius / sphere) * 180 / std::numbers::pi;
  const Ring bowl_rim = ring(surface, Axis::z, {}, bowl_radius, height, edge_length);
  const Ring bottom = ring(surface, Axis::z, {}, 0, height - bowl_depth, edge_length);
  add_cone(surface, edge, bowl_rim, {Axis::z, {}, edge_length, crown});
  const Profile profile = round_profile({0, height - bowl_depth + sphere}, sphere, rim_angle - 90, -90);
  add_revolution(surface, bowl_rim, bottom, profile, {Axis::z, {}, edge_length, bowl});
}

/// The ceiling of the hollow and its fillet. \return the ring where the wall begins
Ring add_ceiling(ModelSurface& surface, double edge_length) {
  const double fine = spacing_beside(edge_length, cavity_fillet * std::numbers::pi / 2);
  const double flat = cavity_radius - cavity_fillet;
  const Ring pole = ring(surface, Axis::z, {}, 0, cavity_top, fine);
  const Ring ceiling = ring(surface, Axis::z, {}, flat, cavity_top, fine);
  Ring wall = ring(surface, Axis::z, {}, cavity_radius, cavity_top - cavity_fillet, fine);
  add_cone(surface, pole, ceiling, {Axis::z, {}, edge_length, cavity});
  const Profile fillet = round_profile({flat, cavity_top - cavity_fillet}, cavity_fillet, 90, 0);
  add_revolution(surface, ceiling, wall, fillet, {Axis::z, {}, edge_length, cavity});
  return wall;
}

}  // namespace

plc::InputPlc make_piston(double edge_length) {
  ModelSurface surface;
  const double rim_spacing = spacing_beside(edge_length, radius - cavity_radius);
  const double boss_spacing = spacing_beside(edge_length, boss_radius - pin_radius);
  const Ring outer_rim = ring(surface, Axis::z, {}, radius, 0, rim_spacing);
  const Ring inner_rim = ring(surface, Axis::z, {}, cavity_radius, 0, rim_spacing);
  add_cone(surface, inner_rim, outer_rim, {Axis::z, {}, edge_length, rim});

  std::array<Chain, 2> outer_holes, inner_holes;
  for (std::size_t i = 0; i < 2; ++i) {
    const double side = i == 0 ? 1 : -1;
    const PinTube bore = pin_tube(surface, side, pin_radius, radius, boss_spacing);
    const PinTube outside = pin_tube(surface, side, boss_radius, cavity_radius, boss_spacing);
    add_tube_wall(surface, bore, pin_radius, OuterSide::towards_axis, edge_length, pin_bore);
    add_tube_wall(surface, outside, boss_radius, OuterSide::away_from_axis, edge_length, boss);
    const Revolution face{Axis::x, {0, 0, pin_height}, edge_length, boss};
    if (side > 0) add_cone(surface, bore.circle, outside.circle, face);
    if (side < 0) add_cone(surface, outside.circle, bore.circle, face);
    outer_holes[i] = hole_of(bore);
    inner_holes[i] = hole_of(outside);
  }

  const Ring top_of_skirt = ring(surface, Axis::z, {}, radius, skirt_top, spacing_beside(edge_length, groove_width));
  add_pierced_cylinder(surface, outer_rim, top_of_skirt, outer_holes, OuterSide::away_from_axis, edge_length, skirt);
  add_crown(surface, add_ring_belt(surface, top_of_skirt, edge_length), edge_length);
  add_pierced_cylinder(surface, inner_rim, add_ceiling(surface, edge_length), inner_holes, OuterSide::towards_axis,
                       edge_length, cavity);
  return to_input(std::move(surface), plc::InputPlc::Inside::even_odd);
}

}  // namespace ccdt::models
