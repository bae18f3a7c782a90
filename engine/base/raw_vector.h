#pragma once

#include <memory>
#include <new>
#include <utility>
#include <vector>

namespace ccdt {

/// Leaves new elements of a plain type as they are in memory, unless they are given a value.
template <class T>
struct RawAllocator : std::allocator<T> {
  template <class U>
  struct rebind {
    using other = RawAllocator<U>;
  };
  template <class U, class... Arguments>
  void construct(U* place, Arguments&&... arguments) {
    if constexpr (sizeof...(Arguments) == 0)
      ::new (static_cast<void*>(place)) U;
    else
      ::new (static_cast<void*>(place)) U(std::forward<Arguments>(arguments)...);
  }
};

/// A vector for large arrays that several threads fill: `resize` does not write to new elements, so it is fast, and the
/// system hands out each page to the thread that first uses it.
template <class T>
using RawVector = std::vector<T, RawAllocator<T>>;

}  // namespace ccdt
