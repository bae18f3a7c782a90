#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "engine/delaunay/delaunay.h"
#include "engine/delaunay/insertion.h"
#include "engine/plc/plc.h"
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

  /// Is the piece long enough to have a place between its ends where it may be split?
  bool can_split(const Subsegment& piece) const;

  /// Inserts a vertex that splits the piece, where `strategy` says. The caller adds it to the chain.
  ///
  /// \throw LimitError  the piece is as short as the grid allows, or there are far too many splits
  ChainVertex split(const Subsegment& piece);

  /// The cells that the last split destroyed, by their vertices.
  std::span<const std::array<std::uint32_t, 4>> destroyed() const { return destroyed_; }

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
  std::vector<std::uint32_t> segment_of_;  ///< by vertex, without those of the PLC; none: not on a segment
  std::size_t most_vertices_;              ///< more would be far too many splits
  std::vector<std::array<std::uint32_t, 4>> destroyed_;
  std::uint32_t probe_ = 0;                ///< counts the points for which cavities were searched
  std::vector<std::uint32_t> last_probe_;  ///< by vertex: the last such point whose cavity had it on its border
};

}  // namespace ccdt::protection
