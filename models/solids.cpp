#include "models/solids.h"

#include <array>
#include <cmath>
#include <sstream>
#include <string>

#include "engine/base/errors.h"
#include "models/parts.h"

namespace ccdt::models {
namespace {

constexpr std::array<Solid, 9> all_solids{{
    {"piston", "piston with three ring grooves, pin bosses and a bowl in the crown; 80 mm", 2.0, 0.1, 16, make_piston},
    {"bracket", "angle bracket with gusset, holes, a slit and an interior face between two regions; 80 mm", 2.0, 0.1,
     16, make_bracket},
    {"stepping-pole", "bicycle foot peg: threaded stub, hexagon, toothed grip, cap with bore; 117 mm", 1.5, 0.08, 12,
     make_stepping_pole},
    {"cube", "unit cube, a square grid on each face", 0.1, 0.0005, 1, make_cube},
    {"graded-cube", "unit cube, squares that shrink 128-fold toward a corner; the largest have the edge length", 0.0625,
     0.005, 0.5, make_graded_cube},
    {"sphere", "unit sphere", 0.1, 0.001, 1.2, make_sphere},
    {"rough-sphere", "unit sphere with radii changed at random by up to 1.5 edge lengths", 0.1, 0.001, 1.2,
     make_rough_sphere},
    {"torus", "torus of radii 1 and 0.4", 0.1, 0.001, 0.5, make_torus},
    {"schoenhardt", "Schoenhardt's polyhedron, which needs a Steiner vertex; the same at every edge length", 1.0,
     1e-300, 1e300, make_schoenhardt},
}};

const Solid& find_solid(std::string_view name) {
  std::string known;
  for (const Solid& solid : all_solids) {
    if (solid.name == name) return solid;
    known += known.empty() ? "" : ", ";
    known += solid.name;
  }
  throw InputError("there is no solid named \"" + std::string(name) + "\"", {}, "use one of: " + known);
}

void check_edge_length(const Solid& solid, double edge_length) {
  if (edge_length >= solid.finest && edge_length <= solid.coarsest) return;  // false for NaN
  std::ostringstream what, remedy;
  what << "the edge length " << edge_length << " is too " << (edge_length < solid.finest ? "short" : "long")
       << " for the solid " << solid.name;
  remedy << "choose one from " << solid.finest << " to " << solid.coarsest << " (default " << solid.default_edge_length
         << ")";
  throw InputError(what.str(), {}, remedy.str());
}

}  // namespace

std::span<const Solid> solids() {
  return all_solids;
}

plc::InputPlc make_solid(std::string_view name, double edge_length) {
  const Solid& solid = find_solid(name);
  if (edge_length <= 0) edge_length = solid.default_edge_length;
  check_edge_length(solid, edge_length);
  plc::InputPlc input = solid.make(edge_length);
  input.name = solid.name;
  return input;
}

}  // namespace ccdt::models
