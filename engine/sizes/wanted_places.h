#pragma once

#include <vector>

#include "engine/plc/input.h"
#include "engine/plc/plc.h"
#include "engine/sizes/local_sizes.h"
#include "engine/sizes/size_field.h"

namespace ccdt::sizes {

/// \throw InputError  a number is not finite or out of its range
void check_local_sizes(const LocalSizes& sizes);

/// The target edge length of tetrahedra that must not be larger than a volume, in a lattice whose edges may be longer
/// than the target by a factor of sqrt(2). All lattices fill space with tetrahedra of equal volume.
double edge_length_for_volume(double volume);

/// The places where a user wants an edge length, in grid units. Regions of `Plc` with a largest volume are among them.
///
/// \param input       of the PLC: has the names of markers
/// \param edge_length  where nothing shorter is wanted, in grid units; > 0
/// \param sharp_angle  in radians: segments with a greater angle are not part of a curved surface
/// \throw InputError  as `check_local_sizes`; there is no such marker, name, segment or region; or a length of the
///                    function is not positive
/// \throw LimitError  too many places
std::vector<SizedPlace> wanted_places(const plc::InputPlc& input, const plc::Plc& plc, const LocalSizes& sizes,
                                      double edge_length, double sharp_angle);

/// Gives regions their largest volumes, in the units of the input. Regions with the same attribute share the least one.
///
/// \throw InputError  there is no such region
void set_volumes(const LocalSizes& sizes, plc::Plc& plc);

}  // namespace ccdt::sizes
