#include "cd/kernel/dispatch.hpp"

namespace galet::cd {

// Defined in the file of each instruction set.
template <Layout Y, int W>
SweepFunctions sweep_functions_of_width(bool cell);

template <Layout Y>
SweepFunctions sweep_functions([[maybe_unused]] Instructions set, bool cell) {
#ifdef GALET_AVX2
  // There are no sweeps on eight lanes: those of four serve every wider set.
  if (set != Instructions::scalar) return sweep_functions_of_width<Y, 4>(cell);
#endif
  return sweep_functions_of_width<Y, 1>(cell);
}

template SweepFunctions sweep_functions<Layout{2, false}>(Instructions, bool);
template SweepFunctions sweep_functions<Layout{2, true}>(Instructions, bool);
template SweepFunctions sweep_functions<Layout{3, false}>(Instructions, bool);
template SweepFunctions sweep_functions<Layout{3, true}>(Instructions, bool);

}  // namespace galet::cd
