// The kernels in plain C++.
#include "md/kernel/grains.hpp"
#include "md/kernel/pass.hpp"

namespace galet::md {

template PassFunction pass_of_width<Layout{2, false}, 1>(Kernel);
template GrainFunctions grain_functions_of_width<Layout{2, false}, 1>();
template PassFunction pass_of_width<Layout{2, true}, 1>(Kernel);
template GrainFunctions grain_functions_of_width<Layout{2, true}, 1>();
template PassFunction pass_of_width<Layout{2, true, true}, 1>(Kernel);
template GrainFunctions grain_functions_of_width<Layout{2, true, true}, 1>();
template PassFunction pass_of_width<Layout{3, false}, 1>(Kernel);
template GrainFunctions grain_functions_of_width<Layout{3, false}, 1>();
template PassFunction pass_of_width<Layout{3, true}, 1>(Kernel);
template GrainFunctions grain_functions_of_width<Layout{3, true}, 1>();
template PassFunction pass_of_width<Layout{3, true, true}, 1>(Kernel);
template GrainFunctions grain_functions_of_width<Layout{3, true, true}, 1>();

}  // namespace galet::md
