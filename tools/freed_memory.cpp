#include "tools/freed_memory.h"

#include <cstddef>
#include <cstdlib>
#include <new>

#ifdef __GLIBC__
#include <malloc.h>
#endif

// Sanitizers have their own `operator new`.
#if defined(__linux__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define CCDT_POOLS_PAGES

#include <atomic>

#include "tools/page_pool.h"

namespace {

using ccdt::tools::PagePool;

/// Smaller arrays are not worth the system calls.
constexpr std::size_t least_pooled = std::size_t{1} << 19;

std::atomic<bool> is_pooling = false;

/// Never destroyed: the last arrays are freed after all static objects are gone.
PagePool& pool() {
  alignas(PagePool) static std::byte place[sizeof(PagePool)];
  static PagePool& made = *::new (static_cast<void*>(place)) PagePool;
  return made;
}

bool belongs_in_pool(std::size_t bytes) {
  return bytes >= least_pooled && is_pooling.load(std::memory_order_relaxed);
}

void* checked(void* place) {
  if (place == nullptr) throw std::bad_alloc();
  return place;
}

}  // namespace

// NOLINTBEGIN(cppcoreguidelines-no-malloc): this is what others use instead of `malloc`
void* operator new(std::size_t bytes) {
  return belongs_in_pool(bytes) ? pool().take(bytes) : checked(std::malloc(bytes));
}

void* operator new(std::size_t bytes, std::align_val_t alignment) {
  const auto unit = static_cast<std::size_t>(alignment);
  if (belongs_in_pool(bytes) && unit <= PagePool::alignment) return pool().take(bytes);
  return checked(std::aligned_alloc(unit, bytes));
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

void ccdt::tools::keep_freed_memory() {
#ifdef __GLIBC__
  mallopt(M_MMAP_MAX, 0);
  mallopt(M_TRIM_THRESHOLD, -1);
#endif
#ifdef CCDT_POOLS_PAGES
  is_pooling = true;
#endif
}
