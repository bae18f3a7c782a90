#pragma once

#include "engine/lattice/options.h"

namespace ccdt {

/// The side of the cubic cell of a lattice for a target edge length.
///
/// All three lattices have the same number of points per volume for the same target, that of FCC whose nearest
/// neighbours are exactly `edge_length` apart: sqrt(2) / edge_length^3.
///
///     lattice  points a cell  side / edge_length     nearest neighbours
///     fcc      4              sqrt(2)   = 1.41421    12 at 1.00000 edge_length
///     bcc      2              2^(1/6)   = 1.12246     8 at 0.97208 edge_length
///     sc       1              2^(-1/6)  = 0.89090     6 at 0.89090 edge_length
double cell_side(Lattice kind, double edge_length);

/// The inverse of `cell_side`.
double edge_length_of_cell(Lattice kind, double side);

/// The nearest number that has at most 8 significant bits: a change below 0.4 per cent. Lattice points are small
/// multiples of half a cell, so they share all trailing zero bits below these; powers of two alone would miss the
/// wanted size by up to 41 per cent.
double round_to_few_bits(double positive);

}  // namespace ccdt
