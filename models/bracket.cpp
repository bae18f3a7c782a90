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

// Millimeters. The foot runs along x and the wall along z. The width of both is along y.
constexpr double thickness = 8;
constexpr double length = 80;  // of both legs
constexpr double width = 60;
constexpr double bend = 16;  // outer radius of the bend, where the legs begin; the inner radius is this minus thickness
constexpr double rounding = 12;  // radius of the free corners of the legs
constexpr double straight = length - rounding;
constexpr double gusset_low = 26, gusset_high = 34;           // its sides
constexpr double gusset_end = 44;                             // how far it goes along both legs
constexpr double gusset_cut = gusset_end + thickness - bend;  // height of its slope above the start of the foot
constexpr double hole_radius = 5;
constexpr double hole_place = 56;  // along the leg
constexpr std::array hole_across{15.0, 45.0};
constexpr double slit_start = 62;  // the slit goes from there to the end of the foot
constexpr double slit_across = 30;

enum Marker { foot = 1, wall, bent, ends, sides, holes, gusset, interior_face, slit };

const Point3 y_axis{0, 1, 0};

constexpr double narrow =
    6;  // of the faces beside the curves: less than the thickness, because of the inner arcs of the bend

/// The surface, and how finely its curves are cut.
struct Bracket {
  ModelSurface surface;
  double edge_length;
  double spacing;

  Chain line_between(const Point3& from, const Point3& to) { return line(surface, from, to, spacing); }

  void add(const Chart& chart, const std::vector<Chain>& around, Marker marker, std::vector<Chain> hole_loops = {},
           std::vector<Chain> cuts = {}) {
    std::vector<Chain> loops{closed_loop(around)};
    for (Chain& hole : hole_loops) loops.push_back(std::move(hole));
    add_patch(surface, {chart, std::move(loops), std::move(cuts), edge_length, marker});
  }
};

/// One of the legs, which are mirror images. Its own coordinates: `out` away from the bend, `across` along y, and `up`
/// through its thickness, from the outside of the angle to the inside.
struct Leg {
  bool is_foot;

  Marker marker() const { return is_foot ? foot : wall; }
  Axis up_axis() const { return is_foot ? Axis::z : Axis::x; }
  Point3 at(double out, double across, double up) const {
    return is_foot ? Point3{out, across, up} : Point3{up, across, out};
  }
  /// Converts an angle from `out` toward `across` to an angle around `up_axis`.
  double angle(double from_out) const { return is_foot ? from_out : 90 - from_out; }
};

/// The curves of a leg, in order around it: [0] on its outer face, [1] on its inner face, and those between the faces.
struct LegCurves {
  std::array<std::vector<Chain>, 2> around;  ///< side, corner, end (the foot's in two parts), corner, side
  std::vector<Chain> through;                ///< where the curves of `around` meet, so one more than these
  std::array<Chain, 2> slit_lines;           ///< from the end inward; the foot only
  std::array<std::vector<Ring>, 2> rings;    ///< the holes
  Chain outer_bend;                          ///< where the bend begins, from low to high across
  std::array<Chain, 2> inner_bend;           ///< below and above the gusset
  std::array<Chain, 2> gusset_sides;         ///< outward from the bend, low and high
  Chain gusset_tip;                          ///< from low to high
};

LegCurves cut_leg(Bracket& b, const Leg& leg) {
  LegCurves c;
  const std::array heights{0.0, thickness};
  for (std::size_t face = 0; face < 2; ++face) {
    const double up = heights[face];
    const auto at = [&](double out, double across) { return leg.at(out, across, up); };
    const auto corner_arc = [&](double across, double from, double to) {
      return arc(b.surface, leg.up_axis(), at(straight, across), rounding, leg.angle(from), leg.angle(to), b.spacing);
    };
    auto& around = c.around[face];
    around.push_back(b.line_between(at(bend, 0), at(straight, 0)));
    around.push_back(corner_arc(rounding, 270, 360));
    if (leg.is_foot) {
      around.push_back(b.line_between(at(length, rounding), at(length, slit_across)));
      around.push_back(b.line_between(at(length, slit_across), at(length, width - rounding)));
      c.slit_lines[face] = b.line_between(at(length, slit_across), at(slit_start, slit_across));
    } else {
      around.push_back(b.line_between(at(length, rounding), at(length, width - rounding)));
    }
    around.push_back(corner_arc(width - rounding, 0, 90));
    around.push_back(b.line_between(at(straight, width), at(bend, width)));
    for (const double across : hole_across) {
      c.rings[face].push_back(ring(b.surface, leg.up_axis(), at(hole_place, across), hole_radius, up, b.spacing));
    }
  }
  const auto point = [&](std::uint32_t id) { return b.surface.vertices[id]; };
  for (std::size_t i = 0; i <= c.around[0].size(); ++i) {
    const bool last = i == c.around[0].size();
    const std::uint32_t low = last ? c.around[0].back().back() : c.around[0][i].front();
    const std::uint32_t high = last ? c.around[1].back().back() : c.around[1][i].front();
    c.through.push_back(b.line_between(point(low), point(high)));
  }
  const auto inner = [&](double out, double across) { return leg.at(out, across, thickness); };
  c.outer_bend = b.line_between(leg.at(bend, 0, 0), leg.at(bend, width, 0));
  c.inner_bend = {b.line_between(inner(bend, 0), inner(bend, gusset_low)),
                  b.line_between(inner(bend, gusset_high), inner(bend, width))};
  c.gusset_sides = {b.line_between(inner(bend, gusset_low), inner(gusset_end, gusset_low)),
                    b.line_between(inner(bend, gusset_high), inner(gusset_end, gusset_high))};
  c.gusset_tip = b.line_between(inner(gusset_end, gusset_low), inner(gusset_end, gusset_high));
  return c;
}

void add_leg_faces(Bracket& b, const Leg& leg, const LegCurves& c) {
  const Point3 up = leg.at(0, 0, 1);
  for (std::size_t face = 0; face < 2; ++face) {
    std::vector<Chain> around = c.around[face];
    if (face == 0) {
      around.push_back(reversed(c.outer_bend));
    } else {
      for (const Chain& piece : {reversed(c.inner_bend[1]), c.gusset_sides[1], reversed(c.gusset_tip),
                                 reversed(c.gusset_sides[0]), reversed(c.inner_bend[0])}) {
        around.push_back(piece);
      }
    }
    std::vector<Chain> hole_loops, cuts;
    for (const Ring& hole : c.rings[face]) hole_loops.push_back(hole.chain);
    if (leg.is_foot) cuts.push_back(c.slit_lines[face]);
    const Chart chart = plane_chart((face == 0 ? 0 : thickness) * up, (face == 0 ? -1.0 : 1.0) * up);
    b.add(chart, around, leg.marker(), std::move(hole_loops), std::move(cuts));
  }
}

/// The faces through the thickness: sides, rounded corners, end and holes.
void add_leg_rim(Bracket& b, const Leg& leg, const LegCurves& c) {
  const std::size_t pieces = c.around[0].size();
  for (std::size_t i = 0; i < pieces; ++i) {
    const std::vector<Chain> around{c.around[0][i], c.through[i + 1], reversed(c.around[1][i]), reversed(c.through[i])};
    const auto corner_chart = [&](double across, double middle) {
      return cylinder_chart(leg.up_axis(), leg.at(straight, across, 0), rounding, leg.angle(middle),
                            OuterSide::away_from_axis);
    };
    if (i == 0)
      b.add(plane_chart({}, -1 * y_axis), around, sides);
    else if (i == 1)
      b.add(corner_chart(rounding, 315), around, ends);
    else if (i == pieces - 2)
      b.add(corner_chart(width - rounding, 45), around, ends);
    else if (i == pieces - 1)
      b.add(plane_chart(width * y_axis, y_axis), around, sides);
    else
      b.add(plane_chart(leg.at(length, 0, 0), leg.at(1, 0, 0)), around, ends);
  }
  for (std::size_t i = 0; i < hole_across.size(); ++i) {
    add_cone(b.surface, c.rings[1][i], c.rings[0][i],
             {leg.up_axis(), leg.at(hole_place, hole_across[i], 0), b.edge_length, holes});
  }
}

/// The arcs of the bend from the foot to the wall at a place across, on the outside or the inside of the angle.
Chain bend_arc(Bracket& b, double across, double radius) {
  return arc(b.surface, Axis::y, {bend, across, bend}, radius, 180, 270, b.spacing);
}

void add_bend(Bracket& b, const LegCurves& on_foot, const LegCurves& on_wall, const std::array<Chain, 2>& gusset_arcs) {
  constexpr double inside = bend - thickness;
  const std::array outer{bend_arc(b, 0, bend), bend_arc(b, width, bend)};
  const std::array inner{bend_arc(b, 0, inside), bend_arc(b, width, inside)};
  const auto chart = [](double radius, OuterSide outer_side) {
    return cylinder_chart(Axis::y, {bend, 0, bend}, radius, 225, outer_side);
  };
  const auto add_strip = [&](const Chart& where, const Chain& low_arc, const Chain& high_arc, const Chain& foot_line,
                             const Chain& wall_line) {
    b.add(where, {foot_line, high_arc, reversed(wall_line), reversed(low_arc)}, bent);
  };
  add_strip(chart(bend, OuterSide::away_from_axis), outer[0], outer[1], on_foot.outer_bend, on_wall.outer_bend);
  add_strip(chart(inside, OuterSide::towards_axis), inner[0], gusset_arcs[0], on_foot.inner_bend[0],
            on_wall.inner_bend[0]);
  add_strip(chart(inside, OuterSide::towards_axis), gusset_arcs[1], inner[1], on_foot.inner_bend[1],
            on_wall.inner_bend[1]);
  for (std::size_t side = 0; side < 2; ++side) {
    const Chain& foot_line = side == 0 ? on_foot.through.front() : reversed(on_foot.through.back());
    const Chain& wall_line = side == 0 ? on_wall.through.front() : reversed(on_wall.through.back());
    const auto upward = [&](const Chain& chain) { return side == 0 ? chain : reversed(chain); };
    const Chart plane = side == 0 ? plane_chart({}, -1 * y_axis) : plane_chart(width * y_axis, y_axis);
    b.add(plane, {upward(foot_line), inner[side], reversed(upward(wall_line)), reversed(outer[side])}, sides);
  }
}

/// The curves of the gusset that do not lie on the legs. The interior face cuts it in two.
struct GussetCurves {
  std::array<Chain, 2> arcs;        ///< along the bend, from the foot to the wall; low and high
  std::array<Chain, 2> cut_up;      ///< the interior face's edges, from the foot upward
  Chain cut_across;                 ///< and its edge in the slope, from low to high
  std::array<Chain, 2> slope_foot;  ///< from the tip on the foot to the cut
  std::array<Chain, 2> slope_wall;  ///< from the cut to the tip on the wall
};

GussetCurves cut_gusset(Bracket& b) {
  GussetCurves g;
  const std::array across{gusset_low, gusset_high};
  for (std::size_t side = 0; side < 2; ++side) {
    const double y = across[side];
    g.arcs[side] = bend_arc(b, y, bend - thickness);
    g.cut_up[side] = b.line_between({bend, y, thickness}, {bend, y, gusset_cut});
    g.slope_foot[side] = b.line_between({gusset_end, y, thickness}, {bend, y, gusset_cut});
    g.slope_wall[side] = b.line_between({bend, y, gusset_cut}, {thickness, y, gusset_end});
  }
  g.cut_across = b.line_between({bend, gusset_low, gusset_cut}, {bend, gusset_high, gusset_cut});
  return g;
}

void add_gusset(Bracket& b, const GussetCurves& g, const LegCurves& on_foot, const LegCurves& on_wall) {
  for (std::size_t side = 0; side < 2; ++side) {
    const Chart plane =
        side == 0 ? plane_chart(gusset_low * y_axis, -1 * y_axis) : plane_chart(gusset_high * y_axis, y_axis);
    b.add(plane, {on_foot.gusset_sides[side], g.slope_foot[side], reversed(g.cut_up[side])}, gusset);
    b.add(plane, {g.cut_up[side], g.slope_wall[side], reversed(on_wall.gusset_sides[side]), reversed(g.arcs[side])},
          gusset);
  }
  const double half = 1 / std::numbers::sqrt2;
  const Chart slope = plane_chart({gusset_end, 0, thickness}, {half, 0, half});
  b.add(slope, {on_foot.gusset_tip, g.slope_foot[1], reversed(g.cut_across), reversed(g.slope_foot[0])}, gusset);
  b.add(slope, {g.cut_across, g.slope_wall[1], reversed(on_wall.gusset_tip), reversed(g.slope_wall[0])}, gusset);
}

/// The facets inside: the face where the foot begins, which divides the body, and the slit in the middle of the foot's
/// end.
void add_interior_facets(Bracket& b, const GussetCurves& g, const LegCurves& on_foot) {
  b.add(
      plane_chart({bend, 0, 0}, {1, 0, 0}),
      {on_foot.outer_bend, on_foot.through.back(), reversed(on_foot.inner_bend[1]), g.cut_up[1], reversed(g.cut_across),
       reversed(g.cut_up[0]), reversed(on_foot.inner_bend[0]), reversed(on_foot.through.front())},
      interior_face);
  const Chain slit_end = b.line_between({slit_start, slit_across, 0}, {slit_start, slit_across, thickness});
  b.add(plane_chart(slit_across * y_axis, y_axis),
        {on_foot.slit_lines[0], slit_end, reversed(on_foot.slit_lines[1]), reversed(on_foot.through[3])}, slit);
}

}  // namespace

plc::InputPlc make_bracket(double edge_length) {
  Bracket b{{}, edge_length, spacing_beside(edge_length, narrow)};
  const Leg foot_leg{true}, wall_leg{false};
  const LegCurves on_foot = cut_leg(b, foot_leg), on_wall = cut_leg(b, wall_leg);
  const GussetCurves g = cut_gusset(b);
  add_leg_faces(b, foot_leg, on_foot);
  add_leg_faces(b, wall_leg, on_wall);
  add_leg_rim(b, foot_leg, on_foot);
  add_leg_rim(b, wall_leg, on_wall);
  add_bend(b, on_foot, on_wall, g.arcs);
  add_gusset(b, g, on_foot, on_wall);
  add_interior_facets(b, g, on_foot);
  plc::InputPlc input = to_input(std::move(b.surface), plc::InputPlc::Inside::seeds);
  input.regions = {{{30, 10, thickness / 2}, foot, 0}, {{thickness / 2, slit_across, 40}, wall, 0}};
  return input;
}

}  // namespace ccdt::models
