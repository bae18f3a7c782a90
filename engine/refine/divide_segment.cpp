#include "engine/refine/divide_segment.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace ccdt::refine {
namespace {

/// On shells, an interval is halved if it is longer than this times the wanted length.
constexpr double longest_on_shells = 1.4;

/// Shells stay at least this times the wanted length away from the far end of their part of the segment.
constexpr double shortest_on_shells = 0.5;

Point3 at_share(const std::array<Point3, 2>& ends, double share) {
  return at_fraction(ends, static_cast<std::uint32_t>(share * all_steps));
}

/// Divides a segment into intervals of nearly equal length, measured in wanted edge lengths.
std::vector<double> even_shares(const std::array<Point3, 2>& ends, sizes::SizeWalk& sizes) {
  const double whole = length(ends[1] - ends[0]);
  std::vector<std::pair<double, double>> passed = {{0, 0}};  // share of the length, and wanted edges up to there
  double size = sizes.at(ends[0]);
  for (double t = 0; t < 1;) {
    const double step = std::min(0.5 * size / whole, 1 - t);
    t = 1 - t - step < 1e-9 ? 1 : t + step;
    const double next = sizes.at(at_share(ends, t));
    passed.emplace_back(t, passed.back().second + 0.5 * step * whole * (1 / size + 1 / next));
    size = next;
  }
  const auto pieces = static_cast<std::uint32_t>(std::max(1.0, std::nearbyint(passed.back().second)));
  std::vector<double> shares;
  std::size_t i = 0;
  for (std::uint32_t piece = 1; piece < pieces; ++piece) {
    const double wanted = passed.back().second * piece / pieces;
    while (passed[i + 1].second < wanted) ++i;
    const auto& [from, before] = passed[i];
    const auto& [to, after] = passed[i + 1];
    shares.push_back(from + (to - from) * (wanted - before) / (after - before));
  }
  return shares;
}

/// Shells: distances from the first end, made by repeatedly halving the interval up to a power of two. So segments that
/// meet at a small angle have vertices at the same distances, as they must (Ruppert 1995).
class Shells {
 public:
  /// \param least, most  distances from the first end
  Shells(const std::array<Point3, 2>& ends, double least, double most, sizes::SizeWalk& sizes)
      : ends_(ends), whole_(length(ends[1] - ends[0])), least_(least), most_(most), sizes_(sizes) {}

  /// \return  shares of the whole length, in increasing order
  std::vector<double> shares() {
    shares_.clear();
    int exponent = 0;
    std::frexp(whole_, &exponent);
    divide(0, std::ldexp(1.0, exponent));  // a power of two above the length
    return shares_;
  }

 private:
  void divide(double low, double high) {
    const double half = 0.5 * (low + high);
    if (low >= most_ || half < whole_ / all_steps) return;
    const double wanted = sizes_.at(at_share(ends_, std::min(half, most_) / whole_));
    if (high - low < longest_on_shells * wanted) return;
    if (may_end_at(half, least_, wanted)) {
      divide(low, half);
      if (half < most_ - shortest_on_shells * wanted) shares_.push_back(half / whole_);
    }
    divide(half, high);
  }

  const std::array<Point3, 2>& ends_;
  const double whole_, least_, most_;
  sizes::SizeWalk& sizes_;
  std::vector<double> shares_;
};

/// Shells around the end with a small angle. If both ends have one, each half has shells around its own end.
std::vector<double> shares_on_shells(const std::array<Point3, 2>& ends, const LeastDistances& least,
                                     sizes::SizeWalk& sizes) {
  const double whole = length(ends[1] - ends[0]);
  const double of_first = least[0] == no_small_angle ? 0 : least[1] == no_small_angle ? whole : whole / 2;
  const std::array<Point3, 2> turned = {ends[1], ends[0]};
  std::vector<double> shares = Shells(ends, least[0], of_first, sizes).shares();
  std::vector<double> of_second = Shells(turned, least[1], whole - of_first, sizes).shares();
  for (auto share = of_second.rbegin(); share != of_second.rend(); ++share) shares.push_back(1 - *share);
  return shares;
}

}  // namespace

std::vector<std::uint32_t> divide_segment(const std::array<Point3, 2>& ends, const LeastDistances& least,
                                          sizes::SizeWalk& sizes) {
  const bool has_small_angle = least[0] != no_small_angle || least[1] != no_small_angle;
  std::vector<std::uint32_t> fractions;
  for (const double share : has_small_angle ? shares_on_shells(ends, least, sizes) : even_shares(ends, sizes)) {
    const auto fraction = static_cast<std::uint32_t>(std::nearbyint(share * all_steps));
    if (fraction > (fractions.empty() ? 0 : fractions.back()) && fraction < all_steps) fractions.push_back(fraction);
  }
  return fractions;
}

}  // namespace ccdt::refine
