// The account of a run's contact problems in checkpoints: restarted runs go on with it.
#pragma once

#include "common/core/archive_columns.hpp"
#include "common/core/error.hpp"
#include "common/engine/engine.hpp"

namespace galet::cd {

inline void save_summary(Archive& archive, const SolverSummary& summary) {
  archive.integers["cd.summary"] = {summary.steps, summary.sweeps, summary.missed, summary.corrections,
                                    summary.divided};
  archive.reals["cd.summary"] = {summary.worst_residual, summary.residual_sum, summary.penetration, summary.dissipated,
                                 summary.gained};
}

/// Throws InputError when the columns don't fit.
inline void restore_summary(const Archive& archive, SolverSummary& summary) {
  const auto& counts = integer_column(archive, "cd.summary");
  std::vector<double> reals(5);
  take_column(archive, "cd.summary", reals);
  if (counts.size() != 5) throw InputError("column 'cd.summary' of the checkpoint has the wrong length");
  summary.steps = counts[0], summary.sweeps = counts[1], summary.missed = counts[2];
  summary.corrections = counts[3], summary.divided = counts[4];
  summary.worst_residual = reals[0], summary.residual_sum = reals[1], summary.penetration = reals[2];
  summary.dissipated = reals[3], summary.gained = reals[4];
}

}  // namespace galet::cd
