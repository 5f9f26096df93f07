// The sweep kernels in plain C++.
#include "cd/kernel/sweep.hpp"

namespace galet::cd {

template SweepFunctions sweep_functions_of_width<Layout{2, false}, 1>(bool);
template SweepFunctions sweep_functions_of_width<Layout{2, true}, 1>(bool);
template SweepFunctions sweep_functions_of_width<Layout{3, false}, 1>(bool);
template SweepFunctions sweep_functions_of_width<Layout{3, true}, 1>(bool);

}  // namespace galet::cd
