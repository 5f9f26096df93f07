// Which instruction set the contact pass uses, chosen when the program runs.
//
// Each set has a file of its own that is compiled for it and holds nothing but its kernels (templates on the width of
// the lanes, everything else inlined): no other part of the program can come to run an instruction that the processor
// lacks. All of them give the same bits.
#pragma once

#include <string_view>

#include "md/kernel/view.hpp"

namespace galet::md {

enum class Instructions { scalar, avx2 };

std::string_view to_string(Instructions set);

/// What the processor has, and this build holds kernels for.
Instructions best_instructions();

/// What engines made from now on use; at the start the best there is. Throws InputError when the processor lacks it.
Instructions instructions();
void use_instructions(Instructions set);

/// Doubles per operation.
int lane_width(Instructions set);

template <Layout Y>
PassFunction pass_function(Instructions set, Kernel kernel);

template <Layout Y>
GrainFunctions grain_functions(Instructions set);

}  // namespace galet::md
