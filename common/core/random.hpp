// Counter-based random numbers (Philox 4x32-10; Salmon, Moraes, Dror and Shaw, SC 2011). A number depends only on
// (seed, stream, counter): it is the same whatever the order in which grains are treated, the number of threads,
// the compiler or the standard library.
#pragma once

#include <array>
#include <cstdint>

namespace galet {

/// The Philox 4x32 block function with 10 rounds.
std::array<std::uint32_t, 4> philox(std::array<std::uint32_t, 4> counter, std::array<std::uint32_t, 2> key);

/// The random numbers of one object (a grain, say) of a run with `seed`.
class RandomStream {
 public:
  RandomStream(std::uint64_t seed, std::uint64_t stream) : seed_(seed), stream_(stream) {}
  /// Uniform in [0, 1), 53 bits.
  double uniform();
  double uniform(double low, double high) { return low + (high - low) * uniform(); }
  /// Normal with mean 0 and variance 1 (Box-Muller; one of the pair is used).
  double normal();

 private:
  std::uint64_t seed_;
  std::uint64_t stream_;
  std::uint64_t counter_ = 0;
};

}  // namespace galet
