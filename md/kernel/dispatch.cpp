#include "md/kernel/dispatch.hpp"

namespace galet::md {

// Defined in the file of each instruction set.
template <Layout Y, int W>
PassFunction pass_of_width(Kernel kernel);
template <Layout Y, int W>
GrainFunctions grain_functions_of_width();

template <Layout Y>
PassFunction pass_function([[maybe_unused]] Instructions set, Kernel kernel) {
#ifdef GALET_AVX512
  if (set == Instructions::avx512) return pass_of_width<Y, 8>(kernel);
#endif
#ifdef GALET_AVX2
  if (set == Instructions::avx2) return pass_of_width<Y, 4>(kernel);
#endif
  return pass_of_width<Y, 1>(kernel);
}

template <Layout Y>
GrainFunctions grain_functions([[maybe_unused]] Instructions set) {
#ifdef GALET_AVX512
  // A grain is worked on as groups of four doubles; spheres with friction have two of each kind.
  if constexpr (Y.dim == 3 && Y.friction)
    if (set == Instructions::avx512) return grain_functions_of_width<Y, 8>();
#endif
#ifdef GALET_AVX2
  if (set != Instructions::scalar) return grain_functions_of_width<Y, 4>();
#endif
  return grain_functions_of_width<Y, 1>();
}

template PassFunction pass_function<Layout{2, false}>(Instructions, Kernel);
template GrainFunctions grain_functions<Layout{2, false}>(Instructions);
template PassFunction pass_function<Layout{2, true}>(Instructions, Kernel);
template GrainFunctions grain_functions<Layout{2, true}>(Instructions);
template PassFunction pass_function<Layout{2, true, true}>(Instructions, Kernel);
template GrainFunctions grain_functions<Layout{2, true, true}>(Instructions);
template PassFunction pass_function<Layout{3, false}>(Instructions, Kernel);
template GrainFunctions grain_functions<Layout{3, false}>(Instructions);
template PassFunction pass_function<Layout{3, true}>(Instructions, Kernel);
template GrainFunctions grain_functions<Layout{3, true}>(Instructions);
template PassFunction pass_function<Layout{3, true, true}>(Instructions, Kernel);
template GrainFunctions grain_functions<Layout{3, true, true}>(Instructions);

}  // namespace galet::md
