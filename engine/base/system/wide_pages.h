// Allocator of large arrays in pages of 2 MB, where the system grants them. A pass over such an array then needs few entries of the page
// table, and the processor's prefetching does not end every 4 kB.
#pragma once
#include <sys/mman.h>

#include <cstddef>
#include <cstdlib>
#include <new>

namespace erbs {

template <class T>
struct WidePages {
  using value_type = T;
  WidePages() = default;
  template <class U>
  WidePages(const WidePages<U>&) {}
  static constexpr std::size_t page = std::size_t(2) << 20;
  static constexpr std::align_val_t alignment{alignof(T)};

  T* allocate(std::size_t n) {
    const std::size_t bytes = n * sizeof(T);
    if (bytes < page) return static_cast<T*>(::operator new(bytes, alignment));
    const std::size_t whole = (bytes + page - 1) / page * page;
    void* at = std::aligned_alloc(page, whole);
    if (at == nullptr) throw std::bad_alloc();
#ifdef MADV_HUGEPAGE
    ::madvise(at, whole, MADV_HUGEPAGE);  // a hint: if it is refused the pages stay small
#endif
    return static_cast<T*>(at);
  }
  void deallocate(T* at, std::size_t n) {
    if (n * sizeof(T) < page) ::operator delete(at, alignment);
    else std::free(at);
  }
  bool operator==(const WidePages&) const { return true; }
};

}  // namespace erbs
