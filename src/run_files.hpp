// The files that a run leaves in its folder, named after the engine: md_series.csv, md_summary.json, md_mu_star.svg,
// sample_md.svg (2D) and so on.
#pragma once

#include <string>
#include <vector>

#include "src/run_result.hpp"
#include "src/simulation.hpp"

namespace galet {

/// Series, summary and pictures. A failed run leaves no picture: its state is not sound. Returns the files' paths.
template <int D>
std::vector<std::string> write_run(const RunResult& result, Simulation<D>& simulation, const std::string& scene,
                                   const std::string& directory);

extern template std::vector<std::string> write_run<2>(const RunResult&, Simulation<2>&, const std::string&,
                                                      const std::string&);
extern template std::vector<std::string> write_run<3>(const RunResult&, Simulation<3>&, const std::string&,
                                                      const std::string&);

}  // namespace galet
