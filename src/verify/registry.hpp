// The cases by name and tag, and running them.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "src/verify/case.hpp"

namespace galet::verify {

/// Every case, family by family.
const std::vector<Case>& all_cases();

/// Which cases are meant: those with one of `names` as their name or tag, in the order of the table (none named: all),
/// at most as long as `effort`; a case that is asked for by its own name is run whatever its length. Throws InputError
/// with a near match for each unknown name.
std::vector<const Case*> select_cases(const std::vector<std::string>& names, Effort effort);

enum class Verdict {
  pass,
  fail,
  refused,  ///< as the case expects
  absent    ///< the case has no meaning for the engine
};
std::string to_string(Verdict verdict);

/// One case with one engine.
struct Outcome {
  const Case* of = nullptr;
  EngineKind engine = EngineKind::md;
  Verdict verdict = Verdict::fail;
  std::string reason;  ///< refused, absent: why; fail: what the engine said, if it stopped
  std::vector<Check> checks;
  long steps = 0;
  double seconds = 0;  ///< processor time of the calling thread, making of samples included
};

Outcome run_case(const Case& which, EngineKind engine);

/// Runs all, case by case; `progress` is told what comes next: its number from 0, the case, the engine.
using Progress = std::function<void(std::size_t, const Case&, EngineKind)>;
std::vector<Outcome> run_cases(const std::vector<const Case*>& cases, const std::vector<EngineKind>& engines,
                               const Progress& progress = {});

bool all_pass(const std::vector<Outcome>& outcomes);

}  // namespace galet::verify
