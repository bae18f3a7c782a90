#pragma once

#include <cstddef>
#include <memory>
#include <new>
#include <type_traits>
#include <utility>
#include <vector>

namespace ccdt {

/// Leaves new elements of a plain type uninitialized, unless they are given a value. This ignores default member
/// initializers.
template <class T>
struct RawAllocator : std::allocator<T> {
  template <class U>
  struct rebind {
    using other = RawAllocator<U>;
  };
  template <class U, class... Arguments>
  void construct(U* place, Arguments&&... arguments) {
    static_assert(std::is_trivially_copy_constructible_v<U> && std::is_trivially_destructible_v<U>);
    if constexpr (sizeof...(Arguments) > 0) ::new (static_cast<void*>(place)) U(std::forward<Arguments>(arguments)...);
  }
};

/// A vector for large arrays that several threads fill: `resize` does not write to new elements, so it is fast, and the
/// system hands out each page to the thread that first uses it.
template <class T>
using RawVector = std::vector<T, RawAllocator<T>>;

/// Memory in large pages.
/// \throw std::bad_alloc  there is not enough memory
void* allocate_large_pages(std::size_t bytes);
void free_large_pages(void* place);

/// The same in large pages. Small arrays are allocated as usual.
template <class T>
struct LargePageAllocator : RawAllocator<T> {
  template <class U>
  struct rebind {
    using other = LargePageAllocator<U>;
  };
  static constexpr std::size_t least_bytes = std::size_t{1} << 22;

  T* allocate(std::size_t count) {
    if (count * sizeof(T) < least_bytes) return RawAllocator<T>::allocate(count);
    return static_cast<T*>(allocate_large_pages(count * sizeof(T)));
  }
  void deallocate(T* place, std::size_t count) {
    if (count * sizeof(T) < least_bytes) return RawAllocator<T>::deallocate(place, count);
    free_large_pages(place);
  }
};

/// A `RawVector` that lives long and is read in scattered places, which is faster with large pages. They are not worth
/// their cost for an array that is read once.
template <class T>
using LargeVector = std::vector<T, LargePageAllocator<T>>;

/// Frees the memory of a vector or of another container.
template <class Container>
void release(Container& container) {
  container = Container();
}

}  // namespace ccdt
