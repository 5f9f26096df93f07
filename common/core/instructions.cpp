#include "common/core/instructions.hpp"

#include <atomic>
#include <string>

#include "common/core/error.hpp"

namespace galet {

namespace {

bool has(Instructions set) {
#ifdef GALET_AVX2
  if (set == Instructions::avx2) return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
#endif
  return set == Instructions::scalar;
}

std::atomic<Instructions>& chosen() {
  static std::atomic<Instructions> set = best_instructions();
  return set;
}

}  // namespace

std::string_view to_string(Instructions set) { return set == Instructions::avx2 ? "avx2" : "scalar"; }

Instructions best_instructions() { return has(Instructions::avx2) ? Instructions::avx2 : Instructions::scalar; }

Instructions instructions() { return chosen(); }

void use_instructions(Instructions set) {
  if (!has(set)) throw InputError("this processor or build has no " + std::string(to_string(set)) + " kernels");
  chosen() = set;
}

int lane_width(Instructions set) { return set == Instructions::avx2 ? 4 : 1; }

}  // namespace galet
