// What the inertia of a stress-driven cell does to results: plane shear of disks at constant pressure with both
// engines, the inertia of the cell a tenth to ten times the default one.
//
//   cd_cell_inertia STEM > table.csv       (STEM.svg: mu* and Phi, each over its mean, against the factor)
//
// 400 disks (+-20 %, mu = 0.4, e = 0.1), I = 0.1; after a strain of 5, means over a strain of 30 with block errors
// (common/measure/block_average.hpp). `sigma_error`: mean of sigma_yy / P - 1; `sigma_scatter`: its standard deviation
// from sample to sample, which does depend on the inertia: a heavy cell answers slowly. What it can't tell: transients.
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "cd/engine.hpp"
#include "common/io/figure.hpp"
#include "common/measure/block_average.hpp"
#include "common/measure/numbers.hpp"
#include "common/measure/stress.hpp"
#include "common/scene/derive.hpp"
#include "common/scene/packing.hpp"
#include "md/engine.hpp"

namespace galet {
namespace {

constexpr double rate = 0.1, settle_strain = 5, strain = 30;
constexpr int looks = 15000;

Scene shear_scene(double factor) {
  Scene scene;
  scene.dimension = 2;
  scene.seed = 5;
  scene.grains.count = 400;
  scene.grains.diameter = {SizeKind::uniform, 1, 0.2, {}, {}};
  scene.material.friction = 0.4;
  scene.material.restitution = 0.1;
  scene.material.stiffness_level = 1e3;
  scene.initial.solid_fraction = 0.5;
  scene.initial.speed = 0.1;
  scene.cell.periodic.assign(2, true);
  scene.cell.inertia_factor = factor;
  scene.loading.kind = LoadingKind::plane_shear;
  scene.loading.pressure = 1;
  scene.loading.shear_rate = rate;
  scene.cd.dt = 0.02;
  scene.cd.tolerance = 1e-3;
  scene.run.strain = settle_strain + strain;
  return scene;
}

struct Result {
  Estimate mu, fraction, sigma;
  double scatter = 0;
};

Result shear(EngineKind kind, double factor) {
  const Scene scene = shear_scene(factor);
  const Sample<2> gas = initial_sample<2>(scene);
  const Derived derived = derive(scene, grain_facts<2>(scene, gas));
  const auto engine =
      kind == EngineKind::md ? md::make_engine<2>(scene, derived, gas) : cd::make_engine<2>(scene, derived, gas);
  engine->advance(std::lround(settle_strain / rate / engine->dt()));
  const long interval = std::max(1L, std::lround(strain / rate / looks / engine->dt()));
  std::vector<double> shear_stress, fraction, normal;
  for (int look = 0; look < looks; ++look) {
    engine->advance(interval);
    const Snapshot<2> state = engine->snapshot();
    const Mat<2> sigma = stress<2>(state).total();
    shear_stress.push_back(-0.5 * (sigma(0, 1) + sigma(1, 0)));
    normal.push_back(sigma(1, 1));
    fraction.push_back(solid_fraction<2>(state));
  }
  Result result;
  result.sigma = block_average(normal), result.fraction = block_average(fraction);
  const Estimate tau = block_average(shear_stress);
  result.mu = {tau.value / result.sigma.value, tau.error / result.sigma.value};
  for (const double value : normal) result.scatter += std::pow(value - result.sigma.value, 2) / looks;
  result.scatter = std::sqrt(result.scatter);
  return result;
}

}  // namespace
}  // namespace galet

int main(int argc, char** argv) {
  using namespace galet;
  const std::string stem = argc > 1 ? argv[1] : "cd_cell_inertia";
  Figure figure{.title = "Plane shear at I = 0.1: what the inertia of the cell changes",
                .x_label = "inertia of the cell / default",
                .y_label = "value / mean over the factors",
                .log_x = true,
                .series = {}};
  fmt::print("engine,inertia_factor,mu_star,mu_star_error,Phi,Phi_error,sigma_error,sigma_error_error,sigma_scatter\n");
  for (const EngineKind kind : {EngineKind::md, EngineKind::cd}) {
    const std::string name = kind == EngineKind::md ? "md" : "cd";
    std::vector<double> factors;
    std::vector<Estimate> mu, fraction;
    for (const double factor : {0.1, 0.3, 1.0, 3.0, 10.0}) {
      const Result result = shear(kind, factor);
      factors.push_back(factor), mu.push_back(result.mu), fraction.push_back(result.fraction);
      fmt::print("{},{},{:.4f},{:.4f},{:.5f},{:.5f},{:.5f},{:.5f},{:.3f}\n", name, factor, result.mu.value,
                 result.mu.error, result.fraction.value, result.fraction.error, result.sigma.value - 1,
                 result.sigma.error, result.scatter);
      std::fflush(stdout);
    }
    const auto add = [&](const std::string& label, const std::vector<Estimate>& values) {
      double mean = 0;
      for (const Estimate& value : values) mean += value.value / static_cast<double>(values.size());
      Series series{.label = name + ": " + label, .x = factors, .y = {}, .y_error = {}, .line = true};
      for (const Estimate& value : values)
        series.y.push_back(value.value / mean), series.y_error.push_back(value.error / mean);
      figure.series.push_back(series);
    };
    add("mu*", mu);
    add("Phi", fraction);
  }
  write_figure(stem, figure);
}
