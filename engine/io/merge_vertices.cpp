#include "engine/io/merge_vertices.h"

#include <bit>

namespace ccdt::io {

namespace {

constexpr std::uint32_t free_slot = 0xFFFFFFFFu;

std::uint64_t mixed(std::uint64_t h) {  // the finalizer of MurmurHash3
  h = (h ^ (h >> 33)) * 0xff51afd7ed558ccdull;
  h = (h ^ (h >> 33)) * 0xc4ceb9fe1a85ec53ull;
  return h ^ (h >> 33);
}

std::uint64_t hash_of(const Point3& p) {
  std::uint64_t h = mixed(std::bit_cast<std::uint64_t>(p.x));
  h = mixed(h ^ std::bit_cast<std::uint64_t>(p.y));
  return mixed(h + std::bit_cast<std::uint64_t>(p.z));
}

}  // namespace

VertexMerger::VertexMerger(std::vector<Point3>& vertices) : vertices_(vertices), slots_(1024, free_slot) {}

std::size_t VertexMerger::slot_of(const Point3& point) const {
  const std::size_t mask = slots_.size() - 1;
  std::size_t slot = hash_of(point) & mask;
  while (slots_[slot] != free_slot && vertices_[slots_[slot]] != point) slot = (slot + 1) & mask;
  return slot;
}

std::uint32_t VertexMerger::index_of(Point3 point) {
  point = {point.x + 0.0, point.y + 0.0, point.z + 0.0};  // -0 becomes 0
  if (2 * vertices_.size() >= slots_.size()) grow();
  std::uint32_t& entry = slots_[slot_of(point)];
  if (entry == free_slot) {
    entry = static_cast<std::uint32_t>(vertices_.size());
    vertices_.push_back(point);
  }
  return entry;
}

void VertexMerger::grow() {
  slots_.assign(2 * slots_.size(), free_slot);
  for (std::uint32_t i = 0; i < vertices_.size(); ++i) slots_[slot_of(vertices_[i])] = i;
}

}  // namespace ccdt::io
