// What `galet verify` prints: a table for a terminal, one JSON object, a Markdown page.
#pragma once

#include <string>
#include <vector>

#include "src/verify/registry.hpp"

namespace galet::verify {

/// One row per check, then what failed and why, and how many passed.
std::string to_text(const std::vector<Outcome>& outcomes);

/// {"cases": [{case, engine, quantity, value, exact, error, tolerance, reason, pass, verdict, seconds, steps}, ...]}:
/// one entry per check; a refusal, or a case that has no meaning for the engine, is one entry without quantity.
std::string to_json(const std::vector<Outcome>& outcomes);

/// A section per case: what is run, the exact answer's source, what trouble would look like, and the checks.
std::string to_markdown(const std::vector<Outcome>& outcomes);

/// The cases themselves, without running them.
std::string list_text(const std::vector<const Case*>& cases);
std::string list_json(const std::vector<const Case*>& cases);

}  // namespace galet::verify
