// The kernels of each instruction set (common/core/instructions.hpp).
#pragma once

#include "common/core/instructions.hpp"
#include "md/kernel/view.hpp"

namespace galet::md {

template <Layout Y>
PassFunction pass_function(Instructions set, Kernel kernel);

template <Layout Y>
GrainFunctions grain_functions(Instructions set);

}  // namespace galet::md
