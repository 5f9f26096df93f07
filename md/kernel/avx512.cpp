// The contact passes for processors with AVX-512 (compiled with -mavx512f -mavx512dq -mavx512vl, and nothing else in
// this file).
#include "md/kernel/grains.hpp"
#include "md/kernel/pass.hpp"

namespace galet::md {

template PassFunction pass_of_width<Layout{2, false}, 8>(Kernel);
template PassFunction pass_of_width<Layout{2, true}, 8>(Kernel);
template PassFunction pass_of_width<Layout{2, true, true}, 8>(Kernel);
template PassFunction pass_of_width<Layout{3, false}, 8>(Kernel);
template PassFunction pass_of_width<Layout{3, true}, 8>(Kernel);
template GrainFunctions grain_functions_of_width<Layout{3, true}, 8>();
template PassFunction pass_of_width<Layout{3, true, true}, 8>(Kernel);
template GrainFunctions grain_functions_of_width<Layout{3, true, true}, 8>();

}  // namespace galet::md
