#include "common/core/instructions.hpp"

#include <atomic>
#include <string>

#include "common/core/error.hpp"

namespace galet {

bool has_instructions(Instructions set) {
#ifdef GALET_AVX2
  if (set == Instructions::avx2) return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
#endif
#ifdef GALET_AVX512
  if (set == Instructions::avx512)
    return has_instructions(Instructions::avx2) && __builtin_cpu_supports("avx512f") &&
           __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl");
#endif
  return set == Instructions::scalar;
}

namespace {

std::atomic<Instructions>& chosen() {
  static std::atomic<Instructions> set = best_instructions();
  return set;
}

}  // namespace

std::string_view to_string(Instructions set) {
  return set == Instructions::avx512 ? "avx512" : set == Instructions::avx2 ? "avx2" : "scalar";
}

Instructions best_instructions() {
  for (const Instructions set : {Instructions::avx512, Instructions::avx2})
    if (has_instructions(set)) return set;
  return Instructions::scalar;
}

Instructions instructions() { return chosen(); }

void use_instructions(Instructions set) {
  if (!has_instructions(set))
    throw InputError("this processor or build has no " + std::string(to_string(set)) + " kernels");
  chosen() = set;
}

int lane_width(Instructions set) { return set == Instructions::avx512 ? 8 : set == Instructions::avx2 ? 4 : 1; }

}  // namespace galet
