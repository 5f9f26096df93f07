// Threads. The only file of the project that knows OpenMP is parallel.cpp.
//
// Two patterns, both giving the same bits for any number of threads:
//   parallel_ranges   static contiguous ranges; the body may write only what belongs to its own indices;
//   parallel_chunks   the index range is cut into chunks whose size does not depend on the number of threads;
//                     partial sums are kept per chunk and added by the caller in the order of the chunks.
#pragma once

#include <cstddef>

namespace galet {

/// A reference to a callable body(begin, end); cheaper than std::function, and it never allocates.
class RangeBody {
 public:
  template <class Body>
  RangeBody(const Body& body)
      : object_(&body), call_([](const void* object, std::size_t begin, std::size_t end) {
          (*static_cast<const Body*>(object))(begin, end);
        }) {}
  void operator()(std::size_t begin, std::size_t end) const { call_(object_, begin, end); }

 private:
  const void* object_;
  void (*call_)(const void*, std::size_t, std::size_t);
};

/// Number of threads used by the functions below (1 at start).
int thread_count();
void set_thread_count(int threads);

/// Calls body(begin, end) on static contiguous ranges that cover [0, count). Fewer than `grain` indices per
/// thread are not worth waking one: the work then runs on fewer threads.
void parallel_ranges(std::size_t count, RangeBody body, std::size_t grain = 512);

/// Number of indices in a chunk of parallel_chunks.
inline constexpr std::size_t chunk_size = 256;
inline std::size_t chunk_count(std::size_t count) { return (count + chunk_size - 1) / chunk_size; }

/// Calls body(chunk, begin, end) for every chunk of [0, count).
template <class Body>
void parallel_chunks(std::size_t count, const Body& body) {
  parallel_ranges(
      chunk_count(count),
      [&](std::size_t first, std::size_t last) {
        for (std::size_t chunk = first; chunk < last; ++chunk) {
          const std::size_t begin = chunk * chunk_size;
          const std::size_t end = begin + chunk_size < count ? begin + chunk_size : count;
          body(chunk, begin, end);
        }
      },
      2);
}

}  // namespace galet
