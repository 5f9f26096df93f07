// The figures of a report: which columns of a run's tables are drawn against which.
#pragma once

#include <string>
#include <vector>

#include "common/io/figure.hpp"
#include "src/report/run_folder.hpp"

namespace galet::report {

struct NamedFigure {
  std::string name;     ///< of its files
  std::string caption;  ///< HTML
  Figure figure;
};

/// Histories: against the strain in shear, else against time. Columns without values, or that stay zero, are left out.
std::vector<NamedFigure> series_figures(const EngineRun& run);

/// Profiles across the layers, the position upwards.
std::vector<NamedFigure> profile_figures(const EngineRun& run);

/// Forces, gaps, local solid fractions.
std::vector<NamedFigure> distribution_figures(const EngineRun& run);

/// The figures drawn by gnuplot, side by side under a heading; nothing for none of them, and a sentence in their place
/// where there is no gnuplot. `prefix` makes their parts' names unique in the page.
std::string figures_html(const std::string& heading, const std::vector<NamedFigure>& figures,
                         const std::string& prefix);

}  // namespace galet::report
