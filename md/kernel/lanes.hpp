// The lanes of common/core/lanes.hpp under the names that the kernels of md use.
#pragma once

#include "common/core/lanes.hpp"

namespace galet::md {

using namespace lanes;

}  // namespace galet::md
