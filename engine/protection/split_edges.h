#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "engine/delaunay/delaunay.h"
#include "engine/delaunay/insertion.h"
#include "engine/plc/plc.h"
#include "engine/protection/encroachment.h"
#include "engine/protection/options.h"
#include "engine/protection/segment_chains.h"

namespace ccdt::protection {

/// A piece of a segment: from one vertex of its chain to the next.
struct Subsegment {
  std::uint32_t segment;
  ChainVertex from, to;
};

/// Where to split a piece, as distances from the first end of its segment.
struct SplitPlace {
  double wanted;
  double low, high;  ///< between these, the split serves its purpose
};

/// Splits pieces of segments by new vertices of the tetrahedralization; keeps its working memory between splits.
class EdgeSplitter {
 public:
  /// \param chains  the vertices on the segments so far
  EdgeSplitter(const plc::Plc& plc, Protection strategy, delaunay::Delaunay& delaunay, const SegmentChains& chains);

  /// Is the piece long enough to have a possible place for a split between its ends?
  bool can_split(const Subsegment& piece) const;

  /// Adds a vertex that splits the piece according to `strategy`, and finds its cavity. The caller adds it to the
  /// chain, examines the cavity and calls `insert`.
  ///
  /// \throw LimitError  the piece is as short as the grid allows, or there are far too many splits
  ChainVertex choose(const Subsegment& piece);
  const delaunay::Insertion& insertion() const { return insertion_; }
  void insert() { insertion_.fill_cavity(); }

 private:
  std::uint32_t step_of(std::uint32_t segment) const;
  std::uint32_t fraction_near(const Subsegment& piece, const SplitPlace& place) const;
  std::uint32_t split_fraction(const Subsegment& piece);
  std::optional<std::uint32_t> encroaching_vertex(const Subsegment& piece, std::uint32_t fraction);
  SplitPlace split_place(const Subsegment& piece, std::uint32_t encroaching) const;

  const plc::Plc& plc_;
  Protection strategy_;
  delaunay::Delaunay& d_;
  delaunay::Insertion insertion_;
  DiametralSearch search_;
  std::vector<std::uint32_t> segment_of_;  ///< by vertex, without those of the PLC; none: not on a segment
  std::size_t most_vertices_;              ///< more would mean far too many splits
};

}  // namespace ccdt::protection
