// The kernels for processors with AVX2 and FMA (compiled with -mavx2 -mfma, and nothing else in this file).
#include "md/kernel/grains.hpp"
#include "md/kernel/pass.hpp"

namespace galet::md {

template PassFunction pass_of_width<Layout{2, false}, 4>(Kernel);
template GrainFunctions grain_functions_of_width<Layout{2, false}, 4>();
template PassFunction pass_of_width<Layout{2, true}, 4>(Kernel);
template GrainFunctions grain_functions_of_width<Layout{2, true}, 4>();
template PassFunction pass_of_width<Layout{2, true, true}, 4>(Kernel);
template GrainFunctions grain_functions_of_width<Layout{2, true, true}, 4>();
template PassFunction pass_of_width<Layout{3, false}, 4>(Kernel);
template GrainFunctions grain_functions_of_width<Layout{3, false}, 4>();
template PassFunction pass_of_width<Layout{3, true}, 4>(Kernel);
template GrainFunctions grain_functions_of_width<Layout{3, true}, 4>();
template PassFunction pass_of_width<Layout{3, true, true}, 4>(Kernel);
template GrainFunctions grain_functions_of_width<Layout{3, true, true}, 4>();

}  // namespace galet::md
