#include "engine/lattice/cell_size.h"

#include <cmath>

namespace ccdt {

namespace {

/// side / edge_length, see the table in the header.
double side_for_unit_edge(Lattice kind) {
  switch (kind) {
    case Lattice::bcc:
      return std::exp2(1.0 / 6);
    case Lattice::sc:
      return std::exp2(-1.0 / 6);
    case Lattice::fcc:
    case Lattice::none:
      break;
  }
  return std::sqrt(2.0);
}

}  // namespace

double cell_side(Lattice kind, double edge_length) {
  return edge_length * side_for_unit_edge(kind);
}

double edge_length_of_cell(Lattice kind, double side) {
  return side / side_for_unit_edge(kind);
}

double round_to_few_bits(double positive) {
  constexpr int significant_bits = 8;
  int exponent = 0;
  const double fraction = std::frexp(positive, &exponent);
  return std::ldexp(std::round(std::ldexp(fraction, significant_bits)), exponent - significant_bits);
}

}  // namespace ccdt
