// The published numbers that studies compare with: one table, each with its source and its uncertainty. Where a source
// states no uncertainty, `basis` says what stands for it.
#pragma once

#include <span>
#include <string_view>

#include "src/studies/verdict.hpp"

namespace galet {

/// The number called `key`. A key that the table does not have is a mistake in the program.
const Published& published(std::string_view key);

std::span<const Published> published_table();

/// Value with the uncertainty as its error, for figures.
Estimate published_estimate(std::string_view key);

}  // namespace galet
