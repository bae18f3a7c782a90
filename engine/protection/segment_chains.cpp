#include "engine/protection/segment_chains.h"

#include <algorithm>
#include <tuple>
#include <utility>

namespace ccdt::protection {

void SegmentChains::append(std::span<const plc::Segment> segments) {
  if (begins_.empty()) begins_.push_back(0);
  begins_.reserve(begins_.size() + segments.size());
  vertices_.reserve(vertices_.size() + 2 * segments.size());
  for (const plc::Segment& segment : segments) {
    vertices_.push_back({segment.ends[0], 0});
    vertices_.push_back({segment.ends[1], whole_segment});
    begins_.push_back(static_cast<std::uint32_t>(vertices_.size()));
  }
}

std::vector<std::array<VertexId, 2>> SegmentChains::pieces() const {
  std::vector<std::array<VertexId, 2>> all;
  all.reserve(vertices_.size() - size());
  for (std::size_t s = 0; s < size(); ++s)
    for (std::uint32_t i = begins_[s] + 1; i < begins_[s + 1]; ++i)
      all.push_back({vertices_[i - 1].vertex, vertices_[i].vertex});
  return all;
}

void SegmentChains::insert(std::vector<InnerVertex> added) {
  if (added.empty()) return;
  std::ranges::sort(added, {}, [](const InnerVertex& v) { return std::tuple(v.segment, v.vertex.fraction); });
  std::vector<ChainVertex> all;
  all.reserve(vertices_.size() + added.size());
  auto next = added.cbegin();
  for (std::uint32_t s = 0; s < size(); ++s) {
    const std::span<const ChainVertex> chain = (*this)[s];
    begins_[s] = static_cast<std::uint32_t>(all.size());
    for (const ChainVertex& v : chain) {
      for (; next != added.cend() && next->segment == s && next->vertex.fraction < v.fraction; ++next)
        all.push_back(next->vertex);
      all.push_back(v);
    }
  }
  begins_.back() = static_cast<std::uint32_t>(all.size());
  vertices_ = std::move(all);
}

std::size_t count_split(const SegmentChains& chains) {
  std::size_t count = 0;
  for (std::size_t s = 0; s < chains.size(); ++s) count += is_split(chains[s]);
  return count;
}

}  // namespace ccdt::protection
