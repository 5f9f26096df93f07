#include "src/studies/flow_walls.hpp"

#include <cmath>

#include <fmt/format.h>

#include "src/engines.hpp"
#include "src/studies/estimates.hpp"
#include "src/studies/flow_fit.hpp"
#include "src/studies/gradient_templates.hpp"
#include "src/studies/published.hpp"
#include "src/studies/templates.hpp"

namespace galet::flow_law {

namespace {

constexpr double first_layer = 0.5;  ///< where the lower wall's grains are

/// Layers of the middle half of what flows; the others are within a few diameters of a wall, which orders them.
std::vector<LocalState> bulk_of(const StudyRow& row) {
  const std::vector<LocalState> all = layer_states(row.run.measures.profile);
  double top = 0;  // the upper wall is the last layer with grains
  for (const LocalState& layer : all)
    if (layer.solid_fraction > 0.3) top = layer.position;
  std::vector<LocalState> bulk;
  const double height = top - first_layer;
  for (const LocalState& layer : all)
    if (layer.position > first_layer + 0.25 * height && layer.position < top - 0.25 * height) bulk.push_back(layer);
  return bulk;
}

struct Bulk {
  Estimate inertial_number, mu_star, solid_fraction;
};

Bulk mean_of_bulk(const StudyRow& row) {
  const std::vector<LocalState> layers = bulk_of(row);
  return {mean_over(layers, &LocalState::inertial_number), mean_over(layers, &LocalState::mu_star),
          mean_over(layers, &LocalState::solid_fraction)};
}

std::vector<const StudyRow*> wall_rows(const std::vector<StudyRow>& rows, EngineKind engine) {
  return rows_with(rows, engine, {{"walls", 1}});
}

}  // namespace

void add_wall_runs(std::vector<StudyRun>& runs, EngineKind engine, bool quick) {
  for (const double number : quick ? std::vector{0.05, 0.1, 0.2} : std::vector{0.02, 0.05, 0.1, 0.2}) {
    WallShearScene scene;
    scene.engine = engine;
    scene.grains = quick ? 400 : 2000;
    scene.length = quick ? 22 : 44;
    scene.inertial_number = number;
    scene.duration = quick ? 600 : 2000;
    scene.title = fmt::format("flow-law: {}, between rough walls, V / H = {:g}", engine_name(engine), number);
    runs.push_back({fmt::format("{}_walls_I_{}", engine_name(engine), plain_number(number)),
                    engine,
                    {{"walls", 1}, {"I_walls", number}},
                    wall_shear_scene(scene),
                    false,
                    true});
  }
}

Estimate cell_at(const std::vector<const StudyRow*>& cell, const Estimate& number, Observable observable,
                 double slope) {
  const Estimate value = homogeneous_at(cell, number.value, observable);
  return {value.value, std::hypot(value.error, slope * number.error)};
}

void report_walls(StudyReport& report, const std::vector<StudyRow>& rows, EngineKind engine) {
  const std::vector<const StudyRow*> cell = shear_rows(rows, engine);
  const FlowFit law = fit_flow(cell);
  const Estimate b = published_estimate("flow.b"), least = published_estimate("flow.mu_min"),
                 a = published_estimate("flow.a"), most = published_estimate("flow.Phi_max");
  for (const StudyRow* row : wall_rows(rows, engine)) {
    const Bulk bulk = mean_of_bulk(*row);
    const Estimate number = bulk.inertial_number;
    const std::string of = fmt::format(", I = {:.3f} ({})", number.value, engine_name(engine));
    report.add("mu* between walls minus the cell's" + of,
               bulk.mu_star - cell_at(cell, number, Observable::mu_star, law.b.value), "flow.walls_mu");
    report.add("Phi between walls minus the cell's" + of,
               bulk.solid_fraction - cell_at(cell, number, Observable::solid_fraction, law.a.value), "flow.walls_Phi");
    report.add("mu* between walls minus the published law" + of,
               bulk.mu_star - Estimate{least.value + b.value * number.value, b.value * number.error},
               "flow.walls_law_mu");
    report.add("Phi between walls minus the published law" + of,
               bulk.solid_fraction - Estimate{most.value - a.value * number.value, a.value * number.error},
               "flow.walls_law_Phi");
  }
}

Series wall_series(const std::vector<StudyRow>& rows, EngineKind engine, bool friction) {
  Series series{engine_name(engine) + ", between walls", {}, {}, {}, false, false};
  for (const StudyRow* row : wall_rows(rows, engine)) {
    const Bulk bulk = mean_of_bulk(*row);
    const Estimate& y = friction ? bulk.mu_star : bulk.solid_fraction;
    series.x.push_back(bulk.inertial_number.value), series.y.push_back(y.value), series.y_error.push_back(y.error);
  }
  return series;
}

}  // namespace galet::flow_law
