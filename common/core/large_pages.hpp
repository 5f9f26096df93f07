// An allocator for arrays that a step goes through: large ones ask for large pages (2 MiB), so that a processor's table
// of pages holds them. Linux gives these on request where its setting is `madvise`; elsewhere the request changes
// nothing. Small arrays come as usual.
#pragma once

#include <cstddef>
#include <new>
#include <vector>

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace galet {

template <class T>
class LargePages {
 public:
  using value_type = T;
  static constexpr std::size_t page = std::size_t{1} << 21, least = 2 * page;  ///< bytes

  LargePages() = default;
  template <class Other>
  LargePages(const LargePages<Other>&) {}

  T* allocate(std::size_t count) {
    const std::size_t bytes = count * sizeof(T);
    void* memory = ::operator new(bytes, alignment(bytes));
#ifdef __linux__
    if (bytes >= least) madvise(memory, bytes, MADV_HUGEPAGE);  // a wish: what comes of it changes nothing but speed
#endif
    return static_cast<T*>(memory);
  }
  void deallocate(T* memory, std::size_t count) { ::operator delete(memory, alignment(count * sizeof(T))); }

  template <class Other>
  bool operator==(const LargePages<Other>&) const {
    return true;
  }

 private:
  static std::align_val_t alignment(std::size_t bytes) { return std::align_val_t(bytes >= least ? page : alignof(T)); }
};

/// Bytes that the array holds (memory_use.hpp).
template <class T>
std::size_t bytes_of(const std::vector<T, LargePages<T>>& values) {
  return values.capacity() * sizeof(T);
}

}  // namespace galet
