#include "engine/protection/split_edges.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "engine/base/errors.h"

namespace ccdt::protection {
namespace {

constexpr std::uint32_t whole = whole_segment;
constexpr std::uint32_t no_segment = 0xFFFFFFFFu;

/// From this level on, a piece is not split close to its ends. Levels of 4, 8 and 12 cost about the same number of
/// splits.
constexpr std::uint32_t most_splits_at_feet = 8;

/// Parts of a piece that its splits leave at the least, if that does no harm.
constexpr double least_part_at_foot = 0.001;

/// Where a piece is split for the sake of an encroaching vertex: at the foot of the vertex, so that it is in the
/// diametral sphere of neither half. Very near to an end of the piece it is somewhat farther from that end, but only so
/// far that the vertex stays out of both spheres.
///
/// \param from, to  the ends of the piece; like the foot and the result in distances from the segment's first end
double split_near_foot(double foot, double squared_height, double from, double to) {
  const double margin = least_part_at_foot * (to - from), room = 0.9 * squared_height;
  const double wanted = std::clamp(foot, from + margin, to - margin);
  return std::clamp(wanted, foot - room / (to - foot), foot + room / (foot - from));
}

Point3 point_on_segment(const plc::Plc& plc, std::uint32_t segment, std::uint32_t fraction) {
  const Point3& a = plc.vertices[plc.segments[segment].ends[0]];
  const Point3& b = plc.vertices[plc.segments[segment].ends[1]];
  // The ends are multiples of 2^20, so that this is exact.
  return a + fraction * ((1.0 / whole) * (b - a));
}

/// More than any real part was seen to need (six splits for each vertex), so that one whose segments split each other
/// on and on ends within seconds.
std::size_t most_splits(std::size_t vertices) {
  return 10000 + 10 * vertices;
}

[[noreturn]] void refuse_further_splits(const plc::Plc& plc, const Subsegment& piece, const char* why) {
  Place place;
  place.file = plc.name;
  for (const VertexId v : plc.segments[piece.segment].ends) place.points.push_back(as_array(plc.world[v]));
  throw LimitError(
      std::string("a segment cannot be protected: ") + why, place,
      "look for features at its ends that are smaller than 1e-6 of it, and remove them or split the segment");
}

}  // namespace

EdgeSplitter::EdgeSplitter(const plc::Plc& plc, Protection strategy, delaunay::Delaunay& delaunay,
                           const SegmentChains& chains)
    : plc_(plc),
      strategy_(strategy),
      d_(delaunay),
      insertion_(delaunay),
      segment_of_(delaunay.vertices.size() - plc.vertices.size(), no_segment),
      most_vertices_(delaunay.vertices.size() + most_splits(delaunay.vertices.size())) {
  for (std::uint32_t s = 0; s < chains.size(); ++s)
    for (std::size_t i = 1; i + 1 < chains[s].size(); ++i) segment_of_[chains[s][i].vertex - plc.vertices.size()] = s;
}

ChainVertex EdgeSplitter::split(const Subsegment& piece) {
  if (piece.to.fraction - piece.from.fraction < 2)
    refuse_further_splits(plc_, piece, "it would have to be split into more than 2^20 pieces");
  if (d_.vertices.size() > most_vertices_)
    refuse_further_splits(plc_, piece, "the edges have been split far more often than there are vertices");
  const std::uint32_t fraction = split_fraction(piece);
  const auto id = static_cast<std::uint32_t>(d_.vertices.size());
  d_.vertices.push_back({point_on_segment(plc_, piece.segment, fraction), id, 0});
  insertion_.find_cavity(id, d_.vertices[piece.from.vertex].cell);
  destroyed_.clear();
  for (const std::uint32_t cell : insertion_.cavity_cells()) destroyed_.push_back(d_.cells[cell].vertices);
  insertion_.fill_cavity();
  segment_of_.push_back(piece.segment);
  return {VertexId(id), fraction, std::max(piece.from.level, piece.to.level) + 1};
}

/// A fraction strictly between the ends of the piece.
std::uint32_t EdgeSplitter::split_fraction(const Subsegment& piece) {
  const std::uint32_t middle = piece.from.fraction + (piece.to.fraction - piece.from.fraction) / 2;
  if (strategy_ == Protection::midpoint) return middle;
  const auto encroaching = encroaching_vertex(piece, middle);
  if (!encroaching) return middle;
  const auto& ends = plc_.segments[piece.segment].ends;
  const double length = std::sqrt(squared_length(d_.point(ends[1]) - d_.point(ends[0])));
  const double fraction = std::nearbyint(split_length(piece, *encroaching) / length * whole);
  return static_cast<std::uint32_t>(std::clamp(fraction, piece.from.fraction + 1.0, piece.to.fraction - 1.0));
}

/// Of the vertices around a point of the piece the one that sees the piece under the largest obtuse angle: it is why
/// the piece is missing. Nothing if none is in the diametral sphere.
std::optional<std::uint32_t> EdgeSplitter::encroaching_vertex(const Subsegment& piece, std::uint32_t fraction) {
  const auto probe = static_cast<std::uint32_t>(d_.vertices.size());
  d_.vertices.push_back({point_on_segment(plc_, piece.segment, fraction), probe, 0});
  insertion_.find_cavity(probe, d_.vertices[piece.from.vertex].cell);
  const Point3 &a = d_.point(piece.from.vertex), &b = d_.point(piece.to.vertex);
  std::optional<std::uint32_t> worst;
  double least_cosine = 0;
  for (const delaunay::CavityFace& face : insertion_.cavity_faces()) {
    for (const std::uint32_t v : face.vertices) {
      if (v == delaunay::ghost_vertex || v == piece.from.vertex || v == piece.to.vertex) continue;
      const Point3 to_a = a - d_.point(v), to_b = b - d_.point(v);
      const double cosine = dot(to_a, to_b) / std::sqrt(squared_length(to_a) * squared_length(to_b));
      // Of equals the first, whatever the order of the cells.
      if (cosine > least_cosine || (cosine == least_cosine && v >= worst.value_or(0))) continue;
      least_cosine = cosine;
      worst = v;
    }
  }
  insertion_.discard_cavity();
  d_.vertices.pop_back();
  return worst;
}

/// Where the piece is split for the sake of an encroaching vertex, as a distance from the first end of its segment.
double EdgeSplitter::split_length(const Subsegment& piece, std::uint32_t encroaching) const {
  const auto& ends = plc_.segments[piece.segment].ends;
  const Point3 &first = d_.point(ends[0]), &p = d_.point(encroaching);
  const double length = std::sqrt(squared_length(d_.point(ends[1]) - first));
  const std::uint32_t other =
      encroaching < plc_.vertices.size() ? no_segment : segment_of_[encroaching - plc_.vertices.size()];
  if (other != no_segment) {
    // On a segment that meets this one: on its shell, so that the two do not split each other forever.
    const auto& others = plc_.segments[other].ends;
    for (int i = 0; i < 2; ++i) {
      if (ends[i] != others[0] && ends[i] != others[1]) continue;
      const double radius = std::sqrt(squared_length(p - d_.point(ends[i])));
      const double along = i == 0 ? radius : length - radius;
      if (along * whole > length * (piece.from.fraction + 1) && along * whole < length * (piece.to.fraction - 1))
        return along;
    }
  }
  // Feet of segments that are not quite parallel move towards each other without end. After some splits, they keep
  // their distance from the ends of the piece.
  const double from = length * piece.from.fraction / whole, to = length * piece.to.fraction / whole;
  const bool is_deep = std::max(piece.from.level, piece.to.level) >= most_splits_at_feet;
  const double margin = is_deep ? 0.2 * (to - from) : 0;
  const Point3 axis = (1 / length) * (d_.point(ends[1]) - first);
  const double foot = dot(p - first, axis), height2 = squared_length(p - first - foot * axis);
  return std::clamp(split_near_foot(foot, height2, from, to), from + margin, to - margin);
}

}  // namespace ccdt::protection
