// `operator new` of the program takes large arrays from a pool of pages. Sanitizers have their own.

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)

#include <cstddef>
#include <cstdlib>
#include <new>

#include "tools/page_pool.h"

namespace {

using ccdt::tools::PagePool;

/// Smaller arrays are not worth the system calls.
constexpr std::size_t least_pooled = std::size_t{1} << 19;

/// Never destroyed: the last arrays are freed after all static objects are gone.
PagePool& pool() {
  alignas(PagePool) static std::byte place[sizeof(PagePool)];
  static PagePool& made = *::new (static_cast<void*>(place)) PagePool;
  return made;
}

void* checked(void* place) {
  if (place == nullptr) throw std::bad_alloc();
  return place;
}

}  // namespace

// NOLINTBEGIN(cppcoreguidelines-no-malloc): this is what others use instead of `malloc`
void* operator new(std::size_t bytes) {
  return bytes < least_pooled ? checked(std::malloc(bytes)) : pool().take(bytes);
}

void* operator new(std::size_t bytes, std::align_val_t alignment) {
  const auto unit = static_cast<std::size_t>(alignment);
  if (bytes < least_pooled || unit > PagePool::alignment) return checked(std::aligned_alloc(unit, bytes));
  return pool().take(bytes);
}

void operator delete(void* place) noexcept {
  if (!pool().give_back(place)) std::free(place);
}

void operator delete(void* place, std::size_t bytes) noexcept {
  bytes < least_pooled ? std::free(place) : operator delete(place);
}

void operator delete(void* place, std::align_val_t) noexcept {
  operator delete(place);
}

void operator delete(void* place, std::size_t bytes, std::align_val_t) noexcept {
  operator delete(place, bytes);
}
// NOLINTEND(cppcoreguidelines-no-malloc)

#endif
