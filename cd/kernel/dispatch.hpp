// The sweep kernels of each instruction set (common/core/instructions.hpp).
#pragma once

#include "cd/kernel/view.hpp"
#include "common/core/instructions.hpp"

namespace galet::cd {

/// `cell`: the cell deforms, so that L counts and the sum of p (x) b is wanted.
template <Layout Y>
SweepFunctions sweep_functions(Instructions set, bool cell);

}  // namespace galet::cd
