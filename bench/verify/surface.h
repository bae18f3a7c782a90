#pragma once

#include <functional>
#include <span>

#include "bench/verify/sites.h"

namespace ccdt::verification {

/// Lengths within which things count as equal.
struct Tolerances {
  double box;    ///< largest extent of the input's bounding box
  double place;  ///< two points are in one place
  double flat;   ///< a patch is flat
};

Tolerances find_tolerances(const InputPlc& input, double flatness);

/// The input's facets as *pieces* that are bounded by directed edges between sites: triangles, and cells of polygons
/// with holes. A piece is seen from *above* where its outer loop is counterclockwise.
///
/// An edge on which another facet has a vertex is split there, so that facets which share a line share edges.
struct Surface {
  Sites sites;
  Tolerances tolerances;
  std::vector<std::uint32_t> piece_begin;  ///< directed edges of each piece: [piece_begin[p], piece_begin[p+1])
  std::vector<std::array<std::uint32_t, 2>> directed;  ///< from, to
  std::vector<std::uint32_t> piece_of;                 ///< of each directed edge
  std::vector<std::uint32_t> edge_of;                  ///< of each directed edge
  std::vector<int> marker;                             ///< of each piece
  std::vector<std::uint32_t> number;                   ///< of each piece: number of its facet in the file
  std::vector<Point3> area_vector;                     ///< of each piece: normal, as long as its area

  std::vector<std::array<std::uint32_t, 2>> edges;     ///< ascending sites
  std::vector<std::uint32_t> use_begin, uses;          ///< directed edges along each edge
  std::vector<std::array<std::uint32_t, 2>> segments;  ///< that the input asks for by themselves
  std::vector<bool> slides;  ///< of each site: a mesh need not have it (slide.h); empty: it must have them all

  std::uint32_t pieces() const { return static_cast<std::uint32_t>(marker.size()); }
  std::uint32_t use_count(std::uint32_t edge) const { return use_begin[edge + 1] - use_begin[edge]; }
  const Point3& at(std::uint32_t site) const { return sites.position[site]; }
  /// Some point of the piece's plane.
  const Point3& origin(std::uint32_t piece) const { return at(directed[piece_begin[piece]][0]); }
  bool is_triangle(std::uint32_t piece) const { return piece_begin[piece + 1] - piece_begin[piece] == 3; }
  /// Does the directed edge run from the smaller site to the larger?
  bool is_forward(std::uint32_t use) const { return directed[use][0] < directed[use][1]; }
};

/// Finds what follows from the directed edges of the pieces: edges and areas.
void index_surface(Surface& surface);

/// Splits the directed edges at the sites that `within` gives for an edge, from the edge's first end to its second.
void split_directed(const std::function<std::vector<std::uint32_t>(std::uint32_t edge)>& within, Surface& surface);

/// The sites strictly within an edge out of some, in the order from its first end to its second.
std::vector<std::uint32_t> select_within(const Surface& surface, const std::array<std::uint32_t, 2>& edge,
                                         std::span<const std::uint32_t> sites);

Surface find_surface(const InputPlc& input, Sites sites, const Tolerances& tolerances);

}  // namespace ccdt::verification
