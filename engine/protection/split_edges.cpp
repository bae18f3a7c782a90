#include "engine/protection/split_edges.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <string>
#include <utility>

#include "engine/base/errors.h"
#include "engine/protection/protect_edges.h"

namespace ccdt::protection {
namespace {

/// From this level on, a piece is not split close to its ends. Levels of 4, 8 and 12 cost about the same number of
/// splits.
constexpr std::uint32_t most_splits_at_feet = 8;

/// Smallest share of a piece that a split leaves, if it does no harm.
constexpr double least_part_at_foot = 0.001;

/// Where to split a piece because of an encroaching vertex: at the foot of the vertex, so that it is outside the
/// diametral spheres of both halves. Near an end of the piece, the split moves away from that end, but only so far that
/// the vertex stays outside both spheres.
///
/// \param from, to  the ends of the piece; like the foot and the result, these are distances from the segment's first
///        end
SplitPlace split_near_foot(double foot, double squared_height, double from, double to) {
  const double margin = least_part_at_foot * (to - from), room = 0.9 * squared_height;
  const double wanted = std::clamp(foot, from + margin, to - margin);
  const double low = foot - room / (to - foot), high = foot + room / (foot - from);
  return {std::clamp(wanted, low, high), low, high};
}

/// Where a line, between two distances from its origin, meets a round plane: among the planes across its dominant axis,
/// the one whose coordinate is a multiple of the largest power of two. Parallel lines meet the same planes.
double distance_of_round_plane(const Point3& origin, const Point3& direction, double from, double to) {
  const auto along = as_array(direction);
  std::size_t axis = 0;
  for (std::size_t i = 1; i < 3; ++i)
    if (std::fabs(along[i]) > std::fabs(along[axis])) axis = i;
  const double start = as_array(origin)[axis];
  const auto [low, high] = std::minmax({start + from * along[axis], start + to * along[axis]});
  double step = 0x1p52;  // more than any coordinate
  while (std::floor(high / step) * step < low) step /= 2;
  return std::clamp((std::floor(high / step) * step - start) / along[axis], from, to);
}

/// The least fraction of a segment whose multiples are on the grid. The coordinates of its ends are multiples of 2^20
/// or, in regular shapes, of greater powers of two.
std::uint32_t finest_step(const Point3& along) {
  int zeros = std::countr_zero(whole_segment);
  for (const double part : as_array(along))
    if (part != 0) zeros = std::min(zeros, std::countr_zero(static_cast<std::uint64_t>(std::fabs(part))));
  return whole_segment >> zeros;
}

/// More than any real part needed (six splits per vertex). So segments that would split each other forever are refused
/// within seconds.
std::size_t most_splits(std::size_t vertices) {
  return 100000 + 10 * vertices;
}

[[noreturn]] void refuse_further_splits(const plc::Plc& plc, const Subsegment& piece, const char* why) {
  Place place;
  place.file = plc.name;
  for (const VertexId v : plc.segments[piece.segment].ends) place.points.push_back(as_array(plc.world[v]));
  throw SegmentLimit(
      plc.segments[piece.segment].ends,
      LimitError(std::string("a segment cannot be protected: ") + why, place,
                 "look for features at its ends or beside it that are smaller than 1e-5 of it, and remove them or "
                 "split the segment"));
}

}  // namespace

EdgeSplitter::EdgeSplitter(const plc::Plc& plc, Protection strategy, delaunay::Delaunay& delaunay,
                           const SegmentChains& chains)
    : plc_(plc),
      strategy_(strategy),
      d_(delaunay),
      insertion_(delaunay),
      search_(delaunay),
      segment_of_(delaunay.vertices.size() - plc.vertices.size(), none),
      most_vertices_(delaunay.vertices.size() + most_splits(delaunay.vertices.size())) {
  for (std::uint32_t s = 0; s < chains.size(); ++s)
    for (std::size_t i = 1; i + 1 < chains[s].size(); ++i) segment_of_[chains[s][i].vertex - plc.vertices.size()] = s;
}

bool EdgeSplitter::can_split(const Subsegment& piece) const {
  return piece.to.fraction - piece.from.fraction >= 2 * step_of(piece.segment);
}

ChainVertex EdgeSplitter::choose(const Subsegment& piece) {
  if (!can_split(piece))
    refuse_further_splits(plc_, piece, "it would have to be split at places that are not on the grid");
  if (d_.vertices.size() > most_vertices_)
    refuse_further_splits(plc_, piece, "the edges have been split far more often than there are vertices");
  const std::uint32_t fraction = split_fraction(piece);
  const std::uint32_t id = d_.add_vertex(point_on_segment(plc_, piece.segment, fraction));
  insertion_.find_cavity(id, d_.cell_at[piece.from.vertex]);
  segment_of_.push_back(piece.segment);
  return {VertexId(id), fraction, std::max(piece.from.level, piece.to.level) + 1};
}

/// The step between the fractions at which a segment may be split.
std::uint32_t EdgeSplitter::step_of(std::uint32_t segment) const {
  const auto& [a, b] = plc_.segments[segment].ends;
  return strategy_ == Protection::midpoint ? usual_step : finest_step(d_.point(b) - d_.point(a));
}

/// The fraction, strictly between the ends of the piece, that is nearest to the wanted place. It is a multiple of the
/// default step or, if no such fraction will do, of a smaller one that the segment allows.
std::uint32_t EdgeSplitter::fraction_near(const Subsegment& piece, const SplitPlace& place) const {
  const auto& ends = plc_.segments[piece.segment].ends;
  const double unit = std::sqrt(squared_length(d_.point(ends[1]) - d_.point(ends[0]))) / whole_segment;
  const std::uint32_t finest = step_of(piece.segment);
  for (std::uint32_t step = usual_step;; step /= 2) {
    const std::uint32_t first = (piece.from.fraction / step + 1) * step, last = (piece.to.fraction - 1) / step * step;
    if (first > last) continue;
    const auto nearest = step * static_cast<std::uint32_t>(std::nearbyint(std::max(0.0, place.wanted) / (unit * step)));
    const std::uint32_t fraction = std::clamp(nearest, first, last);
    if (step == finest || (place.low <= unit * fraction && unit * fraction <= place.high)) return fraction;
  }
}

/// A fraction strictly between the ends of the piece.
std::uint32_t EdgeSplitter::split_fraction(const Subsegment& piece) {
  const std::uint32_t length = piece.to.fraction - piece.from.fraction;
  const std::uint32_t step = length < 2 * usual_step ? step_of(piece.segment) : usual_step;
  const std::uint32_t middle = (piece.from.fraction + length / 2) / step * step;
  if (strategy_ == Protection::midpoint) return middle;
  const auto encroaching = encroaching_vertex(piece, middle);
  return encroaching ? fraction_near(piece, split_place(piece, *encroaching)) : middle;
}

/// Of the vertices that a new vertex on the piece would be joined to, the one that sees the piece at the largest obtuse
/// angle: it is why the piece is missing. None if no vertex is in the diametral sphere.
std::optional<std::uint32_t> EdgeSplitter::encroaching_vertex(const Subsegment& piece, std::uint32_t fraction) {
  const Point3 p = point_on_segment(plc_, piece.segment, fraction);
  const WorstVertex none(d_.point(piece.from.vertex), d_.point(piece.to.vertex));
  // It is nearly always the worst of all vertices.
  WorstVertex worst = none;
  if (search_.find_worst(piece.from.vertex, piece.to.vertex, worst) &&
      (!worst.vertex() || would_be_joined(d_, *worst.vertex(), p)))
    return worst.vertex();
  worst = none;
  insertion_.find_cavity(d_.add_vertex(p), d_.cell_at[piece.from.vertex]);
  for (const delaunay::CavityFace& face : insertion_.cavity_faces())
    for (const std::uint32_t v : face.vertices)
      if (v != delaunay::ghost_vertex) worst.examine(v, d_.point(v));
  insertion_.discard_cavity();
  d_.remove_last_vertex();
  return worst.vertex();
}

/// Where to split the piece because of an encroaching vertex.
SplitPlace EdgeSplitter::split_place(const Subsegment& piece, std::uint32_t encroaching) const {
  const auto& ends = plc_.segments[piece.segment].ends;
  const Point3 &first = d_.point(ends[0]), &p = d_.point(encroaching);
  const double length = std::sqrt(squared_length(d_.point(ends[1]) - first));
  const double from = length * piece.from.fraction / whole_segment, to = length * piece.to.fraction / whole_segment;
  const std::uint32_t other =
      encroaching < plc_.vertices.size() ? none : segment_of_[encroaching - plc_.vertices.size()];
  if (other != none) {
    // The vertex is on a segment that meets this one. The split is on its shell, so that the two do not split each
    // other forever.
    const double margin = length * std::min(usual_step, (piece.to.fraction - piece.from.fraction) / 2) / whole_segment;
    const auto& others = plc_.segments[other].ends;
    for (int i = 0; i < 2; ++i) {
      if (ends[i] != others[0] && ends[i] != others[1]) continue;
      const double radius = std::sqrt(squared_length(p - d_.point(ends[i])));
      const double along = i == 0 ? radius : length - radius;
      if (along > from + margin && along < to - margin) return {along, from, to};
    }
  }
  const Point3 axis = (1 / length) * (d_.point(ends[1]) - first);
  const double foot = dot(p - first, axis), height2 = squared_length(p - first - foot * axis);
  SplitPlace place = split_near_foot(foot, height2, from, to);
  // Feet on segments that are not quite parallel would move toward each other forever. So after some splits, pieces are
  // no longer split near their ends but where adjacent ones are split as well.
  const bool is_deep = std::max(piece.from.level, piece.to.level) >= most_splits_at_feet;
  const double margin = is_deep ? 0.2 * (to - from) : 0;
  if (place.wanted >= from + margin && place.wanted <= to - margin) return place;
  const double wanted = distance_of_round_plane(first, axis, from + margin, to - margin);
  return {wanted, wanted, wanted};
}

}  // namespace ccdt::protection
