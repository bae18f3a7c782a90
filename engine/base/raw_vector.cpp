#include "engine/base/raw_vector.h"

#include <new>

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace ccdt {

#if defined(__linux__) && defined(MADV_HUGEPAGE)

namespace {

constexpr std::size_t large_page = std::size_t{1} << 21;

std::size_t whole_pages(std::size_t bytes) {
  return (bytes + large_page - 1) / large_page * large_page;
}

}  // namespace

void* allocate_large_pages(std::size_t bytes) {
  // One page more, to begin where a large page can; what is left over at both ends is given back.
  const std::size_t size = whole_pages(bytes);
  void* const all = mmap(nullptr, size + large_page, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (all == MAP_FAILED) throw std::bad_alloc();
  const std::size_t before = (large_page - reinterpret_cast<std::size_t>(all) % large_page) % large_page;
  char* const place = static_cast<char*>(all) + before;
  if (before > 0) munmap(all, before);
  munmap(place + size, large_page - before);
  madvise(place, size, MADV_HUGEPAGE);  // a hint: without large pages, all is as usual
  return place;
}

void free_large_pages(void* place, std::size_t bytes) {
  munmap(place, whole_pages(bytes));
}

#else

void* allocate_large_pages(std::size_t bytes) {
  return ::operator new(bytes);
}

void free_large_pages(void* place, std::size_t) {
  ::operator delete(place);
}

#endif

}  // namespace ccdt
