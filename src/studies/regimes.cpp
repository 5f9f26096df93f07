// The chapter's last table, executed: for each regime and parameter, what a change of the parameter does, and whether
// that is an effect by the test of effect.hpp, against the printed letter.
#include "src/studies/regimes.hpp"

#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "src/engines.hpp"
#include "src/studies/effect.hpp"
#include "src/studies/studies.hpp"
#include "src/studies/triaxial_curve.hpp"

namespace galet::regimes {

namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();
constexpr std::array engines = {EngineKind::md, EngineKind::cd};

std::vector<const StudyRow*> rows_of(const std::vector<StudyRow>& rows, Regime regime, EngineKind engine, int column) {
  return rows_with(rows, engine, {{"regime", static_cast<int>(regime) + 1}, {"changed", column + 1}});
}

/// A quantity of one sample of a regime that is no flow.
double of_sample(const StudyRow& row, Regime regime, std::size_t quantity) {
  if (regime == Regime::type_I) return type_I_strain(triaxial_curve(row));
  if (regime == Regime::type_II) return mean_deviator(triaxial_curve(row), 2e-3, 6e-3);
  return row.run.last[quantity == 0 ? Observable::solid_fraction : Observable::z_star];
}

Effect effect_of(const std::vector<StudyRow>& rows, Regime regime, EngineKind engine, int column,
                 std::size_t quantity) {
  const double threshold = quantities_of(regime)[quantity].threshold;
  const auto reference = rows_of(rows, regime, engine, -1), changed = rows_of(rows, regime, engine, column);
  if (regime >= Regime::critical) {
    if (reference.empty() || changed.empty()) return {{none, none}, threshold, 2};
    const Observable observable = quantity == 0 ? Observable::mu_star : Observable::solid_fraction;
    return effect_of_averages((*reference[0])[observable], (*changed[0])[observable], threshold);
  }
  std::vector<double> before, after;  // in pairs of one seed
  for (const StudyRow* row : changed)
    for (const StudyRow* other : reference)
      if (other->plan.parameter("seed") == row->plan.parameter("seed")) {
        before.push_back(of_sample(*other, regime, quantity));
        after.push_back(of_sample(*row, regime, quantity));
      }
  return effect_of_pairs(before, after, threshold);
}

std::vector<Effect> effects_of(const std::vector<StudyRow>& rows, Regime regime, EngineKind engine, int column) {
  std::vector<Effect> effects;
  for (std::size_t k = 0; k < quantities_of(regime).size(); ++k)
    effects.push_back(effect_of(rows, regime, engine, column, k));
  return effects;
}

/// The size that rows are of: what they changed the first parameter to.
StudySize size_of(const std::vector<StudyRow>& rows) {
  for (const StudyRow& row : rows)
    for (const StudyRun& run : plan(StudySize::full))
      if (run.name == row.plan.name) return run.scene == row.plan.scene ? StudySize::full : StudySize::quick;
  return StudySize::quick;
}

std::string values_text(const RegimeRow& row, EngineKind engine, int column) {
  const double from = row.reference.*columns[column], to = row.changed.*columns[column];
  if (engine == EngineKind::cd && column == 1) return fmt::format("kappa rigid -> {:g}", row.reference.*columns[1]);
  return fmt::format("{} {:g} -> {:g}", column_names[column], from, to);
}

void report_cell(StudyReport& report, const std::vector<StudyRow>& rows, Regime regime, EngineKind engine, int column,
                 StudySize size) {
  const RegimeRow row = regime_row(regime, size);
  const std::vector<Effect> effects = effects_of(rows, regime, engine, column);
  const std::vector<Quantity> quantities = quantities_of(regime);
  std::string note = fmt::format("{} for printed {}; changes:", letter_of(effects), row.printed[column]);
  for (std::size_t k = 0; k < effects.size(); ++k)
    note += fmt::format("{} {} {:+.4f} +- {:.4f} (counts from {:g} on)", k > 0 ? "," : "", quantities[k].name,
                        effects[k].change.value, effects[k].change.error, effects[k].threshold);
  report.add(fmt::format("{} ({}): {}", row.name, engine_name(engine), values_text(row, engine, column)),
             in_thresholds(decisive_effect(effects)), row.printed[column] == 'Y' ? "regimes.Y" : "regimes.N", note);
}

/// One line per regime: ours, and the printed letter where it is another one.
void report_table(StudyReport& report, const std::vector<StudyRow>& rows, EngineKind engine, StudySize size) {
  int same = 0, other = 0, open = 0, absent = 0;
  for (int r = 0; r < regime_count; ++r) {
    const Regime regime = static_cast<Regime>(r);
    const RegimeRow row = regime_row(regime, size);
    std::string line = fmt::format("{:<15}({}):", row.name, engine_name(engine));
    for (int column = 0; column < static_cast<int>(columns.size()); ++column) {
      if (!has_cell(regime, engine, column)) {
        line += fmt::format("  {} -", column_names[column]);
        continue;
      }
      const std::vector<Effect> effects = effects_of(rows, regime, engine, column);
      const char ours = letter_of(effects), printed = row.printed[column];
      if (std::isnan(decisive_effect(effects).change.value)) {
        ++absent;
        line += fmt::format("  {} . (printed {})", column_names[column], printed);
        continue;
      }
      ++(ours == '?' ? open : ours == printed ? same : other);
      line += fmt::format("  {} {}{}", column_names[column], ours,
                          ours == printed ? std::string() : fmt::format(" (printed {})", printed));
    }
    report.remarks.push_back(line);
  }
  report.remarks.push_back(fmt::format("{}: {} letters as printed, {} others, {} undecided, {} not run",
                                       engine_name(engine), same, other, open, absent));
}

Figure effect_figure(const std::vector<StudyRow>& rows, EngineKind engine) {
  Figure figure{fmt::format("Effects of six parameters in six regimes ({})", engine_name(engine)),
                "1 assembly, 2 type I, 3 type II, 4 critical, 5 dense flow, 6 collisional",
                "effect / what counts as one",
                false,
                true,
                {}};
  figure.series.push_back({"1: from here on Y", {0.5, 6.5}, {1, 1}, {}, true, false});
  for (int column = 0; column < static_cast<int>(columns.size()); ++column) {
    Series series{column_names[column], {}, {}, {}, false, false};
    for (int r = 0; r < regime_count; ++r) {
      const Regime regime = static_cast<Regime>(r);
      if (!has_cell(regime, engine, column)) continue;
      const std::vector<Effect> effects = effects_of(rows, regime, engine, column);
      const Estimate size = in_thresholds(decisive_effect(effects));
      if (!std::isfinite(size.value)) continue;
      series.x.push_back(r + 1 + 0.12 * (column - 2.5));
      series.y.push_back(size.value), series.y_error.push_back(2 * size.error);
    }
    if (!series.x.empty()) figure.series.push_back(series);
  }
  return figure;
}

}  // namespace

std::vector<StudyRun> plan(StudySize size) {
  std::vector<StudyRun> runs;
  for (int r = 0; r < regime_count; ++r) {
    const Regime regime = static_cast<Regime>(r);
    for (const EngineKind engine : engines)
      for (int column = -1; column < static_cast<int>(columns.size()); ++column) {
        if (!has_cell(regime, engine, column)) continue;
        for (int seed = 1; seed <= samples_of(regime, size); ++seed)
          runs.push_back(regime_run(regime, engine, column, seed, size));
      }
  }
  return runs;
}

StudyReport report(const std::vector<StudyRow>& rows) {
  StudyReport report;
  const StudySize size = size_of(rows);
  for (const EngineKind engine : engines) {
    for (int r = 0; r < regime_count; ++r)
      for (int column = 0; column < static_cast<int>(columns.size()); ++column)
        if (has_cell(static_cast<Regime>(r), engine, column))
          report_cell(report, rows, static_cast<Regime>(r), engine, column, size);
    report_table(report, rows, engine, size);
    report.figures.push_back({"effects_" + engine_name(engine), effect_figure(rows, engine)});
  }
  report.remarks.emplace_back(
      "findings: the change of the quantity that decides, over the change that counts as one. Y: |change| - k s is "
      "above "
      "it, N: |change| + k s below, ?: neither, .: not run; s: standard error, k: Student's 97.5 % quantile of the "
      "samples, or 2 "
      "of "
      "long averages. \"yes (2 errors)\" is undecided. In tables of runs: regime 1 to 6 as in the figures, changed 0: "
      "the reference, 1 to 6: I, kappa, e, mu, mu_R, eta");
  return report;
}

}  // namespace galet::regimes
