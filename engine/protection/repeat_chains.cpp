#include "engine/protection/repeat_chains.h"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "engine/plc/find_repeats.h"

namespace ccdt::protection {
namespace {

/// The places of vertices inside a segment.
using InnerPlaces = std::vector<std::pair<std::uint32_t, std::uint32_t>>;  // fractions and levels

InnerPlaces places_in(std::span<const ChainVertex> chain, bool turned) {
  InnerPlaces places;
  for (const ChainVertex& v : chain.subspan(1, chain.size() - 2))
    places.emplace_back(turned ? whole_segment - v.fraction : v.fraction, v.level);
  return places;
}

/// Sorted; of two at the same place, the one with the higher level.
void unite(InnerPlaces& places) {
  std::ranges::sort(places, [](const auto& a, const auto& b) {
    return a.first != b.first ? a.first < b.first : a.second > b.second;
  });
  const auto repeated = std::ranges::unique(places, {}, [](const auto& place) { return place.first; });
  places.erase(repeated.begin(), repeated.end());
}

}  // namespace

std::optional<RepeatedChains> repeat_chains(const plc::Plc& plc, const SegmentChains& chains) {
  std::vector<InnerPlaces> places(plc.segments.size());
  for (std::uint32_t s = 0; s < places.size(); ++s) places[s] = places_in(chains[s], false);
  bool changes = false;
  for (const std::vector<plc::RepeatedSegment>& group : plc::find_repeats(plc).segments) {
    InnerPlaces all;
    for (const auto& [segment, turned] : group) {
      const InnerPlaces its = places_in(chains[segment], turned);
      all.insert(all.end(), its.begin(), its.end());
    }
    unite(all);
    for (const auto& [segment, turned] : group) {
      changes = changes || places[segment].size() < all.size();
      places[segment] = all;
      if (turned)
        for (auto& [fraction, level] : places[segment]) fraction = whole_segment - fraction;
    }
  }
  if (!changes) return {};
  RepeatedChains repeated{SegmentChains(plc.segments), {}};
  std::vector<InnerVertex> inner;
  for (std::uint32_t s = 0; s < places.size(); ++s)
    for (const auto& [fraction, level] : places[s]) {
      inner.push_back({s, {VertexId(plc.vertices.size() + inner.size()), fraction, level}});
      repeated.points.push_back(point_on_segment(plc, s, fraction));
    }
  repeated.chains.insert(std::move(inner));
  return repeated;
}

}  // namespace ccdt::protection
