#include "engine/protection/protect_edges.h"

#include <algorithm>
#include <cmath>

#include "engine/base/errors.h"
#include "engine/delaunay/cell_star.h"
#include "engine/delaunay/insertion.h"

namespace ccdt {
namespace {

constexpr std::uint32_t whole = whole_segment;

/// A piece of a segment.
struct Subsegment {
  std::uint32_t segment;
  ChainVertex from, to;
};

Point3 point_on_segment(const Plc& plc, std::uint32_t segment, std::uint32_t fraction) {
  const Point3& a = plc.vertices[plc.segments[segment].ends[0]];
  const Point3& b = plc.vertices[plc.segments[segment].ends[1]];
  // The ends are multiples of 2^20, so that this is exact.
  return a + fraction * ((1.0 / whole) * (b - a));
}

/// By vertex: do two segments meet there at an acute angle?
std::vector<bool> acute_vertices(const Plc& plc) {
  std::vector<std::vector<Point3>> directions(plc.vertices.size());
  for (const Segment& s : plc.segments) {
    const Point3 along = plc.vertices[s.ends[1]] - plc.vertices[s.ends[0]];
    const Point3 unit = (1 / std::sqrt(squared_length(along))) * along;
    directions[s.ends[0]].push_back(unit);
    directions[s.ends[1]].push_back(-1.0 * unit);
  }
  std::vector<bool> acute(plc.vertices.size(), false);
  for (std::size_t v = 0; v < acute.size(); ++v)
    for (std::size_t i = 0; i < directions[v].size() && !acute[v]; ++i)
      for (std::size_t j = 0; j < i && !acute[v]; ++j) acute[v] = dot(directions[v][i], directions[v][j]) > 1e-9;
  return acute;
}

/// Where to split: a fraction strictly between the ends of the piece.
std::uint32_t split_fraction(const Plc& plc, const Subsegment& piece, Protection strategy,
                             const std::vector<bool>& acute) {
  const std::uint32_t middle = piece.from.fraction + (piece.to.fraction - piece.from.fraction) / 2;
  if (strategy == Protection::midpoint) return middle;
  const Segment& segment = plc.segments[piece.segment];
  const bool acute_from = piece.from.fraction == 0 && acute[segment.ends[0]],
             acute_to = piece.to.fraction == whole && acute[segment.ends[1]];
  if (acute_from == acute_to) return middle;
  const double length = std::sqrt(squared_length(plc.vertices[segment.ends[1]] - plc.vertices[segment.ends[0]]));
  const double half = length * (piece.to.fraction - piece.from.fraction) / whole / 2;
  const double shell = std::exp2(std::nearbyint(std::log2(half)));
  const auto offset = static_cast<std::uint32_t>(std::nearbyint(shell / length * whole));
  const std::uint32_t fraction = acute_from ? offset : whole - offset;
  return std::clamp(fraction, piece.from.fraction + 1, piece.to.fraction - 1);
}

[[noreturn]] void refuse_further_splits(const Plc& plc, const Subsegment& piece) {
  Place place;
  place.file = plc.name;
  for (const VertexId v : plc.segments[piece.segment].ends) place.points.push_back(as_array(plc.world[v]));
  throw LimitError(
      "a segment cannot be protected: it would have to be split into more than 2^20 pieces", place,
      "look for features at its ends that are smaller than 1e-6 of it, and remove them or split the segment");
}

/// Splits a piece at a new vertex of the tetrahedralization.
ChainVertex split(const Plc& plc, const Subsegment& piece, Protection strategy, const std::vector<bool>& acute,
                  Delaunay& delaunay, Insertion& insertion) {
  if (piece.to.fraction - piece.from.fraction < 2) refuse_further_splits(plc, piece);
  const std::uint32_t fraction = split_fraction(plc, piece, strategy, acute);
  const auto id = static_cast<std::uint32_t>(delaunay.vertices.size());
  delaunay.vertices.push_back({point_on_segment(plc, piece.segment, fraction), id, 0});
  insertion.dig(id, delaunay.vertices[piece.from.vertex].cell);
  insertion.fill();
  return {VertexId(id), fraction};
}

/// Splits the pieces of one segment until, as things stand, all are Delaunay edges.
void protect_segment(const Plc& plc, std::uint32_t segment, Protection strategy, const std::vector<bool>& acute,
                     Delaunay& delaunay, Insertion& insertion, CellStar& star, std::vector<ChainVertex>& chain) {
  std::vector<ChainVertex> ahead(chain.rbegin(), chain.rend() - 1);
  chain.resize(1);
  while (!ahead.empty()) {
    const Subsegment piece{segment, chain.back(), ahead.back()};
    if (star.has_edge(piece.from.vertex, piece.to.vertex)) {
      chain.push_back(piece.to);
      ahead.pop_back();
    } else {
      ahead.push_back(split(plc, piece, strategy, acute, delaunay, insertion));
    }
  }
}

bool is_protected(const std::vector<ChainVertex>& chain, CellStar& star) {
  for (std::size_t i = 0; i + 1 < chain.size(); ++i)
    if (!star.has_edge(chain[i].vertex, chain[i + 1].vertex)) return false;
  return true;
}

}  // namespace

std::uint64_t protect_edges(const Plc& plc, const std::vector<bool>& must_be_chain, Protection strategy,
                            Delaunay& delaunay, SegmentChains& chains, const Progress& progress) {
  const std::vector<bool> acute = acute_vertices(plc);
  const std::size_t before = delaunay.vertices.size();
  Insertion insertion(delaunay);
  CellStar star(delaunay);
  // A new vertex may knock out a segment that was done: go round until nothing changes.
  for (bool changed = true; changed;) {
    changed = false;
    for (std::uint32_t s = 0; s < plc.segments.size(); ++s) {
      if ((s & 0xFFF) == 0) report(progress, "protect", s, plc.segments.size());
      if (!must_be_chain[s] || is_protected(chains[s], star)) continue;
      protect_segment(plc, s, strategy, acute, delaunay, insertion, star, chains[s]);
      changed = true;
    }
  }
  return delaunay.vertices.size() - before;
}

SegmentChains bare_chains(const Plc& plc) {
  SegmentChains chains(plc.segments.size());
  for (std::size_t s = 0; s < chains.size(); ++s)
    chains[s] = {{plc.segments[s].ends[0], 0}, {plc.segments[s].ends[1], whole}};
  return chains;
}

std::vector<bool> grazeable_segments(const Plc& plc) {
  std::vector<bool> grazeable(plc.segments.size());
  for (std::size_t s = 0; s < grazeable.size(); ++s) grazeable[s] = plc.segments[s].grazeable;
  return grazeable;
}

}  // namespace ccdt
