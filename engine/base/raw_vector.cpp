#include "engine/base/raw_vector.h"

#include <new>

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace ccdt {

#if defined(__linux__) && defined(MADV_HUGEPAGE)

namespace {

constexpr std::size_t large_page = std::size_t{1} << 21;

}  // namespace

void* allocate_large_pages(std::size_t bytes) {
  void* const place = ::operator new (bytes, std::align_val_t{large_page});
  madvise(place, bytes, MADV_HUGEPAGE);  // a hint: without large pages, nothing changes
  return place;
}

void free_large_pages(void* place) {
  ::operator delete (place, std::align_val_t{large_page});
}

#else

void* allocate_large_pages(std::size_t bytes) {
  return ::operator new(bytes);
}

void free_large_pages(void* place) {
  ::operator delete(place);
}

#endif

}  // namespace ccdt
