#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <set>
#include <span>
#include <vector>

#include "engine/delaunay/delaunay.h"

namespace ccdt::test {

/// A cell as the sorted ids of its vertices, and the cells of a tetrahedralization as a sorted list: these can be
/// compared.
using Corners = std::array<std::uint32_t, 4>;
std::vector<Corners> sorted_cells(const delaunay::Delaunay& d);

/// The cells of the perturbed Delaunay tetrahedralization from its definition: all quadruples of vertices in whose
/// sphere no vertex is, by their points and ranks.
std::vector<Corners> cells_by_definition(std::span<const delaunay::DelaunayVertex> vertices);

/// The structure alone: neighbors name each other's common face, from its two sides; ghosts have the ghost as vertex 3
/// and finite cells are positively oriented; every vertex has a cell and names one that has it; no two have the same
/// rank; the dead cells are those of the free list.
testing::AssertionResult is_consistent(const delaunay::Delaunay& d);

/// No vertex is in the perturbed circumsphere of a cell, nor beyond a ghost's hull face, nor, in its plane, in its
/// circumcircle. With `is_consistent` this makes the tetrahedralization Delaunay.
testing::AssertionResult has_empty_spheres(const delaunay::Delaunay& d);

testing::AssertionResult are_equal(const delaunay::Delaunay& a, const delaunay::Delaunay& b);

}  // namespace ccdt::test
