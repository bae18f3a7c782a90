#pragma once

#include <cstddef>
#include <cstdlib>
#include <mutex>
#include <new>
#include <vector>

namespace ccdt::tools {

/// Large blocks of memory that share their pages.
///
/// New pages are expensive: the system clears each of them. So the pages of blocks that were given back go to the
/// blocks that are taken next. They move there (`mremap`), wherever they are and whatever the sizes, so no page stays
/// unused in a gap that is too small. It can serve `operator new`: it takes its own memory from `malloc`.
class PagePool {
 public:
  static constexpr std::size_t alignment = std::size_t{1} << 21;  ///< of blocks; a large page

  /// \return a block; what is in it is undefined
  /// \throw std::bad_alloc  there is not enough memory
  void* take(std::size_t bytes);

  /// \return whether a block begins at the place; if not, nothing happens
  bool give_back(void* place) noexcept;

 private:
  /// Consecutive pages that moved together.
  struct Piece {
    std::byte* begin;
    std::size_t size;
    std::byte* block;  ///< the block that they belong to; null: they are free
  };

  // NOLINTBEGIN(cppcoreguidelines-no-malloc): `operator new` would take this memory from this pool
  template <class T>
  struct Malloc {
    using value_type = T;
    Malloc() = default;
    template <class U>
    explicit Malloc(const Malloc<U>&) {}
    T* allocate(std::size_t count) {
      if (void* const place = std::malloc(count * sizeof(T))) return static_cast<T*>(place);
      throw std::bad_alloc();
    }
    void deallocate(T* place, std::size_t) { std::free(place); }
    bool operator==(const Malloc&) const = default;
  };
  // NOLINTEND(cppcoreguidelines-no-malloc)

  std::byte* map_block(std::size_t size);
  Piece* find_free(std::size_t wanted);
  bool move_pages(Piece& free, std::byte* place, std::size_t size, std::byte* block);
  void unmap_free() noexcept;

  std::mutex mutex_;
  std::vector<Piece, Malloc<Piece>> pieces_;
};

}  // namespace ccdt::tools
