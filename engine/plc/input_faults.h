#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "engine/plc/close_triangles.h"
#include "engine/plc/edge_table.h"
#include "engine/plc/plc.h"

namespace ccdt::plc {

/// The triangles with the same corners as an earlier one, each paired with the first of these.
std::vector<TrianglePair> find_duplicate_triangles(const Plc& plc, const TriangleSet& triangles);

/// \param pairs       not empty
/// \throw InputError  always
[[noreturn]] void throw_duplicates(const Plc& plc, const TriangleSet& triangles, std::span<const TrianglePair> pairs);

/// \param pairs     not empty; the pair with the smallest facet numbers is named
/// \param at_least  there may be more than in `pairs`
/// \throw InputError  always
[[noreturn]] void throw_overlaps(const Plc& plc, const TriangleSet& triangles, const SegmentSet& segments,
                                 std::span<const Overlap> pairs, bool at_least);

/// The loops of edges that have only one triangle.
/// \throw InputError  always; to be called if there is such an edge
[[noreturn]] void throw_open_surface(const Plc& plc, const EdgeTable& edges);

/// \throw InputError  always, with this place in the input
[[noreturn]] void throw_input_error(const Plc& plc, const std::string& what, const std::string& remedy,
                                    const std::vector<Point3>& world_points = {},
                                    const std::vector<long long>& facets = {});

}  // namespace ccdt::plc
