// The list of all studies.
#pragma once

#include <span>
#include <string>

#include "src/studies/study.hpp"

namespace galet {

std::span<const Study> all_studies();

/// Throws InputError with a near match when there is none of that name.
const Study& find_study(const std::string& name);

/// What the runs of a study cost, from their sizes alone (src/cost.hpp: expect a factor of 2 or 3 either way).
struct StudyCost {
  int runs = 0;
  double seconds = 0;  ///< of one core
};
StudyCost estimate_study(const Study& study, StudySize size);

/// The same for one run.
double estimate_run(const StudyRun& run);

}  // namespace galet
