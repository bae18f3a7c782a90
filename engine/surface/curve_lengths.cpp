#include "engine/surface/curve_lengths.h"

#include <algorithm>

#include "engine/surface/surface_limits.h"

namespace ccdt {
namespace {

constexpr double step = 0.9;  // from one length that is tried to the next

// The pieces of the chain are no obstacle themselves: a vertex may be put on each bend.
double length_at(const FeatureCurve& curve, std::size_t i, double usual) {
  const double whole = curve.arc.back();
  const double before = i > 0 ? curve.arc[i] - curve.arc[i - 1] : 0;
  const double after = i + 1 < curve.arc.size() ? curve.arc[i + 1] - curve.arc[i] : 0;
  const double least = std::max(before, after);
  double edge = std::min(usual, whole);
  for (; edge > least; edge *= step) {
    const double from = std::clamp(curve.arc[i] - 0.5 * edge, 0.0, whole - edge);
    if (curve.deviation(from, from + edge) <= most_deviation * edge) break;
  }
  return std::min({std::max(edge, least), usual, whole});
}

}  // namespace

CurveLengths::CurveLengths(const FeatureCurves& features, double usual) : features_(features) {
  for (const FeatureCurve& curve : features.curves) {
    std::vector<double>& lengths = lengths_.emplace_back();
    for (std::size_t i = 0; i < curve.points.size(); ++i) lengths.push_back(length_at(curve, i, usual));
    for (std::size_t i = 1; i < lengths.size(); ++i)
      lengths[i] = std::min(lengths[i], lengths[i - 1] + length_growth * (curve.arc[i] - curve.arc[i - 1]));
    for (std::size_t i = lengths.size() - 1; i-- > 0;)
      lengths[i] = std::min(lengths[i], lengths[i + 1] + length_growth * (curve.arc[i + 1] - curve.arc[i]));
  }
}

double CurveLengths::at(std::uint32_t curve, double arc) const {
  const std::vector<double>& arcs = features_.curves[curve].arc;
  const auto after = std::upper_bound(arcs.begin() + 1, arcs.end() - 1, arc);
  const auto i = static_cast<std::size_t>(after - arcs.begin());
  const std::vector<double>& lengths = lengths_[curve];
  return std::min(lengths[i - 1] + length_growth * (arc - arcs[i - 1]), lengths[i] + length_growth * (arcs[i] - arc));
}

}  // namespace ccdt
