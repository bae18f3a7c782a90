#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "engine/base/point.h"

namespace ccdt::plc {

/// A facet given by polygons in one plane, as in TetGen's .poly and in OBJ, OFF and PLY faces with more than three
/// corners. A polygon of two vertices is a segment within the facet, of one vertex a vertex within it. Loops other than
/// the outer one that bound a hole in the facet are given by `holes`: a point in each hole. In surface formats, a
/// polygon is an outline: if it runs around a hole by a bridge, there and back on the same edge, nothing is in the
/// hole.
struct PolygonFacet {
  std::vector<std::vector<std::uint32_t>> polygons;
  std::vector<Point3> holes;
  int marker = 0;
  std::uint32_t number = 0;  ///< number of the facet in the file, from 0
};

inline bool is_one_loop(const PolygonFacet& facet) {
  return facet.polygons.size() == 1 && facet.holes.empty();
}

/// The contents of a file, in its units, before any check. Indices are in range, lists that may be empty are otherwise
/// complete, and seeds are finite. Readers ensure it, and functions of the library refuse anything else
/// (`check_input`).
struct InputPlc {
  /// How the file defines the inside.
  enum class Inside {
    even_odd,  ///< surface formats: a point is inside if it is separated from infinity by an odd number of shells
    seeds,     ///< .poly, .smesh, .mesh: everything not reachable from infinity or from hole seeds
  };

  struct RegionSeed {
    Point3 seed;
    int attribute = 0;
    double max_volume = 0;  ///< 0: none
  };

  std::string name;  ///< path as the user gave it
  Inside inside = Inside::even_odd;

  std::vector<Point3> vertices;

  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<int> triangle_markers;            ///< empty, or one per triangle
  std::vector<std::uint32_t> triangle_numbers;  ///< empty (the index itself), or the number of the facet in the file
  std::vector<PolygonFacet> polygon_facets;

  std::vector<std::array<std::uint32_t, 2>> segments;
  std::vector<int> segment_markers;  ///< empty, or one per segment

  std::vector<Point3> holes;
  std::vector<RegionSeed> regions;

  /// Facets that were replaced by triangles, because they are not planar.
  struct Warped {
    std::uint64_t count = 0;
    double largest_deviation = 0;  ///< largest distance of a corner from the plane of its facet
  };
  Warped warped;

  std::map<int, std::string> marker_names;  ///< of facets, where the file names groups of them

  std::vector<std::string> notes;  ///< what is unusual in the file but was understood; one sentence each

  std::size_t facet_count() const { return triangles.size() + polygon_facets.size(); }
};

}  // namespace ccdt::plc
