// Which instruction set the kernels of both engines use, chosen when the program runs.
//
// Each set has files of its own (md/kernel, cd/kernel) that are compiled for it and hold nothing but kernels (templates
// on the width of the lanes, everything else inlined): no other part of the program can come to run an instruction that
// the processor lacks. All of them give the same bits.
#pragma once

#include <string_view>

namespace galet {

enum class Instructions { scalar, avx2, avx512 };

std::string_view to_string(Instructions set);

/// Whether the processor has it, and this build holds kernels for it.
bool has_instructions(Instructions set);
/// The widest of those.
Instructions best_instructions();

/// What engines made from now on use; at the start the best there is. Throws InputError when the processor lacks it.
Instructions instructions();
void use_instructions(Instructions set);

/// Doubles per operation.
int lane_width(Instructions set);

}  // namespace galet
