// The sweep kernels for processors with AVX2 and FMA (compiled with -mavx2 -mfma, and nothing else in this file).
#include "cd/kernel/sweep.hpp"

namespace galet::cd {

template SweepFunctions sweep_functions_of_width<Layout{2, false}, 4>(bool);
template SweepFunctions sweep_functions_of_width<Layout{2, true}, 4>(bool);
template SweepFunctions sweep_functions_of_width<Layout{3, false}, 4>(bool);
template SweepFunctions sweep_functions_of_width<Layout{3, true}, 4>(bool);

}  // namespace galet::cd
