#include "engine/delaunay/open_faces.h"

#include <algorithm>

namespace ccdt {
namespace {

using Corners = std::array<std::uint32_t, 3>;

Corners sorted_corners(const std::vector<Cell>& cells, std::uint32_t code) {
  const auto& v = cells[cell_of(code)].vertices;
  const auto& corner = face_corners[face_of(code)];
  std::uint32_t a = v[corner[0]], b = v[corner[1]], c = v[corner[2]];
  if (a > b) std::swap(a, b);
  if (b > c) std::swap(b, c);
  if (a > b) std::swap(a, b);
  return {a, b, c};
}

std::uint32_t hash(const Corners& v) {
  std::uint64_t h = (std::uint64_t{v[0]} << 32 | v[1]) * 0x9E3779B97F4A7C15u;
  h = ((h ^ (h >> 32)) + v[2]) * 0xD6E8FEB86659FD93u;
  return static_cast<std::uint32_t>(h >> 32);
}

}  // namespace

bool OpenFaces::close_or_open(std::vector<Cell>& cells, std::uint32_t code) {
  const Corners corners = sorted_corners(cells, code);
  const std::uint32_t h = hash(corners);
  std::size_t place = h & mask_;
  for (; table_[place] != empty; place = (place + 1) & mask_) {
    const std::uint32_t other = code_in(table_[place]);
    if (hash_of(table_[place]) != h || sorted_corners(cells, other) != corners) continue;
    cells[cell_of(code)].neighbors[face_of(code)] = other;
    cells[cell_of(other)].neighbors[face_of(other)] = code;
    erase(place);
    return true;
  }
  table_[place] = std::uint64_t{h} << 32 | code;
  if (2 * ++size_ > table_.size()) grow();
  return false;
}

/// Moves later entries up into the gap, where they are not above their own places.
void OpenFaces::erase(std::size_t place) {
  --size_;
  for (std::size_t next = (place + 1) & mask_; table_[next] != empty; next = (next + 1) & mask_) {
    const std::size_t home = hash_of(table_[next]) & mask_;
    if (((next - home) & mask_) < ((next - place) & mask_)) continue;
    table_[place] = table_[next];
    place = next;
  }
  table_[place] = empty;
}

void OpenFaces::grow() {
  const std::vector<std::uint64_t> old = std::move(table_);
  table_.assign(2 * old.size(), empty);
  mask_ = table_.size() - 1;
  for (const std::uint64_t entry : old) {
    if (entry == empty) continue;
    std::size_t place = hash_of(entry) & mask_;
    while (table_[place] != empty) place = (place + 1) & mask_;
    table_[place] = entry;
  }
}

Corners outward_corners(const std::vector<Cell>& cells, std::uint32_t code) {
  const auto& v = cells[cell_of(code)].vertices;
  const auto& corner = face_corners[face_of(code)];
  return {v[corner[0]], v[corner[2]], v[corner[1]]};
}

}  // namespace ccdt
