#include "tools/page_pool.h"

#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>

namespace ccdt::tools {
namespace {

/// If less than this is left of a piece, it is not kept. That limits the number of pieces.
constexpr std::size_t least_rest = std::size_t{1} << 18;

std::size_t round_up(std::size_t size, std::size_t unit) {
  return (size + unit - 1) / unit * unit;
}

std::size_t page_size() {
  static const auto size = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
  return size;
}

/// The size of a part of a block without the pages at its end that were never used.
std::size_t used_size(std::byte* begin, std::size_t size) {
  std::array<unsigned char, 1024> in_memory{};
  for (std::size_t end = size / page_size(); end > 0;) {
    const std::size_t first = end - std::min(end, in_memory.size());
    mincore(begin + first * page_size(), (end - first) * page_size(), in_memory.data());
    for (; end > first; --end)
      if ((in_memory[end - 1 - first] & 1) != 0) return end * page_size();
  }
  return 0;
}

/// Null if there is not enough memory.
std::byte* map_pages(std::size_t size) {
  void* const pages = mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  return pages == MAP_FAILED ? nullptr : static_cast<std::byte*>(pages);
}

}  // namespace

void* PagePool::take(std::size_t bytes) {
  if (bytes > std::numeric_limits<std::size_t>::max() - 2 * alignment) throw std::bad_alloc();
  const std::size_t size = round_up(std::max<std::size_t>(bytes, 1), page_size());
  const std::lock_guard lock(mutex_);
  pieces_.reserve(pieces_.size() + 2);  // now, because nothing may fail later: one for a rest, one for new pages
  std::byte* const block = map_block(size);
  std::size_t filled = 0;
  while (filled < size) {
    Piece* const free = find_free(size - filled);
    if (free == nullptr) break;
    const std::size_t part = std::min(free->size, size - filled);
    if (!move_pages(*free, block + filled, part, block)) break;
    filled += part;
  }
  if (filled < size) pieces_.push_back({block + filled, size - filled, block});
  return block;
}

bool PagePool::give_back(void* place) noexcept {
  if (reinterpret_cast<std::uintptr_t>(place) % alignment != 0) return false;
  const std::lock_guard lock(mutex_);
  bool found = false;
  for (Piece& piece : pieces_) {
    if (piece.block != place) continue;
    found = true;
    piece.block = nullptr;
    const std::size_t used = used_size(piece.begin, piece.size);
    if (used < piece.size) munmap(piece.begin + used, piece.size - used);
    piece.size = used;
  }
  std::erase_if(pieces_, [](const Piece& piece) { return piece.size == 0; });
  return found;
}

/// New pages. A page takes no memory before it is used.
std::byte* PagePool::map_block(std::size_t size) {
  const std::size_t with_margin = size + alignment;
  std::byte* pages = map_pages(with_margin);
  if (pages == nullptr) {
    unmap_free();  // free pieces count where the system limits the memory of a process
    pages = map_pages(with_margin);
  }
  if (pages == nullptr) throw std::bad_alloc();
  const std::size_t before =
      round_up(reinterpret_cast<std::uintptr_t>(pages), alignment) - reinterpret_cast<std::uintptr_t>(pages);
  if (before > 0) munmap(pages, before);
  if (before < alignment) munmap(pages + before + size, alignment - before);
  return pages + before;
}

/// The smallest free piece that is large enough, or else the largest one.
PagePool::Piece* PagePool::find_free(std::size_t wanted) {
  Piece* best = nullptr;
  for (Piece& piece : pieces_) {
    if (piece.block != nullptr) continue;
    const bool is_better = best == nullptr || (best->size >= wanted ? wanted <= piece.size && piece.size < best->size
                                                                    : best->size < piece.size);
    if (is_better) best = &piece;
  }
  return best;
}

/// Moves the first pages of a free piece to their place in a block. The rest of it stays free.
bool PagePool::move_pages(Piece& free, std::byte* place, std::size_t size, std::byte* block) {
  if (mremap(free.begin, size, size, MREMAP_MAYMOVE | MREMAP_FIXED, place) == MAP_FAILED) {
    // There are too many pieces. The system may have unmapped the place already.
    unmap_free();
    mmap(place, size, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_FIXED_NOREPLACE, -1, 0);
    return false;
  }
  const Piece rest = {free.begin + size, free.size - size, nullptr};
  free = {place, size, block};
  if (rest.size >= least_rest)
    pieces_.push_back(rest);
  else if (rest.size > 0)
    munmap(rest.begin, rest.size);
  return true;
}

void PagePool::unmap_free() noexcept {
  for (const Piece& piece : pieces_)
    if (piece.block == nullptr) munmap(piece.begin, piece.size);
  std::erase_if(pieces_, [](const Piece& piece) { return piece.block == nullptr; });
}

}  // namespace ccdt::tools
