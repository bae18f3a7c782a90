#include "bench/experiments/count_search.h"

#include <algorithm>
#include <cmath>

namespace ccdt::bench {
namespace {

constexpr double usual_exponent = 3;  ///< the number of tetrahedra is about proportional to 1 / edge length^3
constexpr double most_stretch = 2;    ///< largest factor between the edge lengths of two tries if the secant fails
constexpr double least_exponent = 0.7, largest_exponent = 6;

struct Try {
  double edge_length, count;
};

/// The exponent between two tries, if it is reliable.
double exponent_between(const Try& a, const Try& b) {
  const double lengths = std::log(a.edge_length / b.edge_length), counts = std::log(b.count / a.count);
  if (std::abs(lengths) < 1e-9) return usual_exponent;
  return std::clamp(counts / lengths, least_exponent, largest_exponent);
}

/// The known bounds of the wanted edge length.
struct Bracket {
  double shorter, longer;
  bool is_shorter_tried = false, is_longer_tried = false;

  void take(const Try& made, double wanted) {
    if (made.count > wanted && made.edge_length >= shorter) {
      shorter = made.edge_length;
      is_shorter_tried = true;
    } else if (made.count <= wanted && made.edge_length <= longer) {
      longer = made.edge_length;
      is_longer_tried = true;
    }
  }

  /// Replaces a guess outside the bounds by an end that has not been tried yet, otherwise by a value between the ends.
  double hold(double guess) const {
    if (guess > shorter && guess < longer) return guess;
    if (guess <= shorter && !is_shorter_tried) return shorter;
    if (guess >= longer && !is_longer_tried) return longer;
    const double low = is_shorter_tried ? shorter : std::max(shorter, longer / most_stretch);
    const double high = is_longer_tried ? longer : std::min(longer, shorter * most_stretch);
    return std::sqrt(low * high);
  }
};

/// Did much longer edges make hardly fewer tetrahedra? Then small features of the surface determine the number, and no
/// edge length helps.
bool is_stuck(const Try& before, const Try& made, double wanted) {
  constexpr double much = 1.2, hardly = 1.03;
  return made.count > wanted && made.edge_length > much * before.edge_length && before.count < hardly * made.count;
}

}  // namespace

std::optional<CountFound> search_edge_length(const CountSearch& search,
                                             const std::function<std::optional<std::uint64_t>(double)>& count_of) {
  std::optional<CountFound> best;
  std::optional<Try> before;
  Bracket bracket{search.shortest, search.longest};
  double edge_length = std::clamp(search.first, search.shortest, search.longest);
  const auto error = [&](double count) { return std::abs(std::log(count / search.wanted)); };
  for (int i = 0; i < search.most_tries; ++i) {
    const auto counted = count_of(edge_length);
    if (!counted || *counted == 0) return best;
    const Try made{edge_length, static_cast<double>(*counted)};
    const bool is_near = std::abs(made.count / search.wanted - 1) <= search.tolerance;
    if (!best || error(made.count) < error(best->count)) best = CountFound{edge_length, made.count, is_near};
    if (is_near) return best;
    if (before && is_stuck(*before, made, search.wanted)) return best;
    bracket.take(made, search.wanted);
    const double exponent = before ? exponent_between(*before, made) : usual_exponent;
    const double next = bracket.hold(edge_length * std::pow(made.count / search.wanted, 1 / exponent));
    if (std::abs(next / edge_length - 1) < 1e-6) return best;  // at an end of the allowed range
    before = made;
    edge_length = next;
  }
  return best;
}

}  // namespace ccdt::bench
