#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/base/raw_vector.h"
#include "engine/lattice/domain_surface.h"
#include "engine/lattice/options.h"
#include "engine/lattice/target_sizes.h"

namespace ccdt::lattice {

/// The side of the cubic cell of a lattice for a target edge length.
///
/// For the same target, all three lattices have the same number of points per volume: that of the FCC lattice whose
/// nearest neighbors are `edge_length` apart, sqrt(2) / edge_length^3.
///
///     lattice  points/cell    side / edge_length     nearest neighbors
///     fcc      4              sqrt(2)   = 1.41421    12 at 1.00000 edge_length
///     bcc      2              2^(1/6)   = 1.12246     8 at 0.97208 edge_length
///     sc       1              2^(-1/6)  = 0.89090     6 at 0.89090 edge_length
double cell_side(Lattice kind, double edge_length);

/// The inverse of `cell_side`.
double edge_length_of_cell(Lattice kind, double side);

/// The nearest number that has at most 8 significant bits: a change below 0.4 percent. Lattice points are small
/// multiples of half a cell, so they share all trailing zero bits below these; powers of two alone would miss the
/// wanted size by up to 41 percent.
double round_to_few_bits(double positive);

/// Where a node is: touched by the surface, or entirely on one side of it.
enum class NodePlace : std::uint8_t { outside, surface, inside };

struct OctreeNode {
  std::array<std::uint32_t, 3> corner{};  ///< the least, in octree units
  std::uint32_t first_child = 0;          ///< eight in a row, in Morton order (x is the lowest bit); 0: a leaf
  std::uint32_t first_triangle = 0;       ///< of its part of `Octree::triangles`; only nodes on the surface have one
  std::uint32_t triangle_count = 0;
  std::uint8_t level = 0;  ///< 0: the root
  NodePlace place = NodePlace::surface;

  bool is_leaf() const { return first_child == 0; }
};

/// An octree whose leaves are lattice cells (paper, section 3). Nodes outside the domain are never split. The levels of
/// leaves that meet, even only in a corner, differ by at most one, unless one is outside.
///
/// An *octree unit* is half the side of the finest possible leaf, so every lattice point has whole octree units.
struct Octree {
  Point3 origin;                ///< the least corner of the root, in grid units
  double unit = 1;              ///< one octree unit in grid units; few significant bits, or a small multiple of such
  unsigned depth = 0;           ///< level of the finest possible leaves
  Box bounds;                   ///< of the surface
  RawVector<OctreeNode> nodes;  ///< the root first
  RawVector<std::uint32_t> triangles;  ///< those that touch a node, node by node

  static constexpr unsigned bits = 21;  ///< of a coordinate within the root

  std::uint32_t side(const OctreeNode& node) const { return 2u << (depth - node.level); }
  double length(std::uint32_t octree_units) const { return unit * octree_units; }
  Point3 point(const std::array<std::uint32_t, 3>& c) const {
    return origin + Point3{unit * c[0], unit * c[1], unit * c[2]};
  }
  Box box(const OctreeNode& node) const {
    const Point3 low = point(node.corner);
    const double side_length = length(side(node));
    return {low, low + Point3{side_length, side_length, side_length}};
  }
  /// The child of an inner node that holds a point of the node (each child holds its lower faces, not the upper ones).
  std::uint32_t child_at(const OctreeNode& node, const std::array<std::uint32_t, 3>& c) const;
  /// The leaf that holds a point within the root.
  const OctreeNode& leaf_at(const std::array<std::uint32_t, 3>& c) const;
  /// The leaf that holds a point of the root.
  ///
  /// \param p  integers in grid units
  const OctreeNode& leaf_with(const Point3& p) const;
  std::span<const std::uint32_t> triangles_of(const OctreeNode& node) const {
    return std::span(triangles).subspan(node.first_triangle, node.triangle_count);
  }
};

/// Builds the octree whose leaves have the right cell side for the wanted size, within a factor of sqrt(2), and within
/// 0.4 percent where that is the reference size.
///
/// \throw LimitError  more leaves than a program can index
Octree build_octree(const DomainSurface& surface, const TargetSizes& size, Lattice kind);

/// Is a point of a node on the surface strictly inside the domain? Exact. If no ray in the whole tree decides, the
/// answer is no: then a point may be missing, but no point is wrong.
bool is_inside(const Octree& tree, const DomainSurface& surface, const Point3& p, const OctreeNode& node);

}  // namespace ccdt::lattice
