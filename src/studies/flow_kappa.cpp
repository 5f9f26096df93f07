// The stiffness level: from where on it stops to matter in md, the same compliance in cd, rigid grains as the limit,
// and the states in the plane (Phi, I / sqrt(kappa)) of Campbell's regimes.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "src/engines.hpp"
#include "src/rigid_limit.hpp"
#include "src/studies/estimates.hpp"
#include "src/studies/scene_head.hpp"
#include "src/studies/studies.hpp"
#include "src/studies/templates.hpp"

namespace galet::flow_kappa {

namespace {

constexpr double softest = 40, enough = 1e3;
/// Where md is run with tangential damping also: stiff enough for the rigid limit within its errors.
constexpr double damped_level = 1e5;
/// What a contact is beside its stiffness level: md without tangential damping, as the chapter has it, or with the
/// critical one; compliant or rigid cd.
enum class Contact { plain, damped, compliant, rigid };
/// Time in which the pressure rises on the softest grains: the pressure that a gas of so many grains is compressed by
/// at once overshoots fivefold, and such grains would be pressed through one another.
constexpr double soft_start = 100;

const StudyRow* rigid_row(const std::vector<StudyRow>& rows, double state) {
  return row_with(rows, EngineKind::cd, {{"I", state}, {"rigid", 1}});
}

double stiffest(const std::vector<StudyRow>& rows) {
  const std::vector<double> levels = values_of(rows, "kappa");
  return levels.empty() ? 0 : *std::max_element(levels.begin(), levels.end());
}

void report_state(StudyReport& report, const std::vector<StudyRow>& rows, double state) {
  const std::string where = fmt::format(", I = {:g}", state);
  const auto md = [&](double level) { return row_with(rows, EngineKind::md, {{"I", state}, {"kappa", level}}); };
  const double hard = stiffest(rows);
  const Estimate one{1, 0};
  for (const auto& [observable, name] : {std::pair{Observable::mu_star, "mu*"}, {Observable::solid_fraction, "Phi"}}) {
    const Estimate limit = value_of(md(hard), observable);
    for (const double level : {enough, 1e4})
      report.add(fmt::format("{} at kappa = {:g} over {:g}, - 1{}", name, level, hard, where),
                 ratio(value_of(md(level), observable), limit) - one, "kappa.none");
    const Estimate soft = ratio(value_of(md(softest), observable), limit) - one;
    report.add(fmt::format("|{} at kappa = 40 over {:g}, - 1|{}", name, hard, where),
               {std::abs(soft.value), soft.error}, "kappa.visible");
    std::vector<MdRun> levels;
    for (const StudyRow* row : rows_with(rows, EngineKind::md, {{"I", state}}))
      if (row->plan.parameter("kappa") >= enough) levels.push_back({row->plan.parameter("kappa"), (*row)[observable]});
    const auto extrapolated = md_limit(levels);
    if (extrapolated)
      report.add(fmt::format("{} of md for kappa to infinity over rigid cd, - 1{}", name, where),
                 ratio(extrapolated->value, value_of(rigid_row(rows, state), observable)) - one, "flow.engines");
    report.add(fmt::format("{} of md with zeta_T = 1, kappa = {:g}, over rigid cd, - 1{}", name, damped_level, where),
               ratio(value_of(row_with(rows, EngineKind::md, {{"I", state}, {"zeta_T", 1}}), observable),
                     value_of(rigid_row(rows, state), observable)) -
                   one,
               "flow.engines");
    for (const StudyRow* row : rows_with(rows, EngineKind::cd, {{"I", state}})) {
      const double level = row->plan.parameter("kappa");
      if (!std::isfinite(level)) continue;
      report.add(fmt::format("{} of compliant cd over md, - 1, kappa = {:g}{}", name, level, where),
                 ratio((*row)[observable], value_of(md(level), observable)) - one, "kappa.compliant");
    }
  }
}

/// Observable against kappa, with the rigid grains as a band over the whole axis.
Figure level_figure(const std::vector<StudyRow>& rows, Observable observable) {
  const bool friction = observable == Observable::mu_star;
  Figure figure{
      "Effect of the stiffness of contacts", "stiffness level kappa", friction ? "mu*" : "Phi", true, false, {}};
  const std::vector<double> states = values_of(rows, "I");
  for (std::size_t k = 0; k < states.size(); ++k) {
    const double state = states[k];
    if (const StudyRow* rigid = rigid_row(rows, state)) {
      const Estimate value = (*rigid)[observable];
      figure.series.push_back({fmt::format("rigid cd, I = {:g}", state),
                               {softest, stiffest(rows)},
                               {value.value, value.value},
                               {value.error, value.error},
                               false,
                               true,
                               static_cast<int>(k)});
    }
    for (const EngineKind engine : {EngineKind::md, EngineKind::cd}) {
      std::vector<const StudyRow*> levels;
      for (const StudyRow* row : rows_with(rows, engine, {{"I", state}}))
        if (std::isfinite(row->plan.parameter("kappa"))) levels.push_back(row);
      if (levels.empty()) continue;
      const std::string who = engine == EngineKind::md ? "md" : "compliant cd";
      const std::string label = fmt::format("{}, I = {:g}", who, state);
      figure.series.push_back(with_look(series_of(label, levels, "kappa", observable), k, engine));
    }
  }
  return figure;
}

/// States by Phi and alpha = I / sqrt(kappa), each with its own kind of regime (Campbell 2002).
Figure regime_figure(const std::vector<StudyRow>& rows) {
  Figure figure{"States by solid fraction and rate", "Phi", "{/:Italic I} / sqrt(kappa)", false, true, {}};
  for (const double state : values_of(rows, "I")) {
    Series series;
    series.label = fmt::format("I = {:g}", state);
    for (const StudyRow* row : rows_with(rows, EngineKind::md, {{"I", state}})) {
      if (!std::isfinite(row->plan.parameter("kappa"))) continue;
      series.x.push_back((*row)[Observable::solid_fraction].value);
      series.y.push_back(state / std::sqrt(row->plan.parameter("kappa")));
    }
    figure.series.push_back(series);
  }
  return figure;
}

StudyRun flow(bool quick, double state, Contact contact, double level) {
  const bool rigid = contact == Contact::rigid, damped = contact == Contact::damped;
  ShearScene scene;
  scene.engine = rigid || contact == Contact::compliant ? EngineKind::cd : EngineKind::md;
  scene.grains = quick ? 200 : full_size_disks;
  scene.contact_steps = quick ? 0 : sparing_steps;
  scene.inertial_number = state;
  scene.strain = std::clamp(400 * state, 16.0, 40.0);
  scene.stiffness_level = level;
  if (!quick && level == softest) scene.slow_start = soft_start;
  scene.material = "viscous_convention = \"total\"\n";
  if (damped) scene.material += "tangential_damping_ratio = 1.0\n";
  scene.compliance = contact == Contact::compliant;
  const std::string what = rigid ? "rigid" : (damped ? "damped_kappa_" : "kappa_") + plain_number(level);
  scene.title = fmt::format("flow-kappa: {}, {}, I = {:g}", engine_name(scene.engine), what, state);
  // Rows of rigid grains and with tangential damping are not among those of a level.
  const std::pair<std::string, double> own = rigid    ? std::pair{"rigid", 1.0}
                                             : damped ? std::pair{"zeta_T", 1.0}
                                                      : std::pair{"kappa", level};
  return {fmt::format("{}_{}_I_{:g}", engine_name(scene.engine), what, state),
          scene.engine,
          {{"I", state}, own},
          shear_scene(scene)};
}

}  // namespace

std::vector<StudyRun> plan(StudySize size) {
  const bool quick = size == StudySize::quick;
  const std::vector<double> states = quick ? std::vector{0.1} : std::vector{0.01, 0.03, 0.1, 0.2};
  std::vector<double> levels = {softest, 200, 1e3, 1e4, 1e5};
  if (!quick) levels.push_back(2.5e5);
  std::vector<StudyRun> runs;
  for (const double state : states) {
    const auto add = [&](Contact contact, double level) { runs.push_back(flow(quick, state, contact, level)); };
    for (const double level : levels) add(Contact::plain, level);
    add(Contact::damped, damped_level);
    for (const double level : {softest, 1e3, 1e4}) add(Contact::compliant, level);
    add(Contact::rigid, 1e4);
  }
  return runs;
}

StudyReport report(const std::vector<StudyRow>& rows) {
  StudyReport report;
  for (const double state : values_of(rows, "I")) report_state(report, rows, state);
  report.figures.push_back({"mu_star", level_figure(rows, Observable::mu_star)});
  report.figures.push_back({"Phi", level_figure(rows, Observable::solid_fraction)});
  report.figures.push_back({"regimes", regime_figure(rows)});
  return report;
}

}  // namespace galet::flow_kappa
