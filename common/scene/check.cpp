#include "common/scene/check.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

#include "common/core/near_match.hpp"
#include "common/core/types.hpp"
#include "common/scene/body_shapes.hpp"
#include "common/scene/check_report.hpp"
#include "common/scene/size_distribution.hpp"

namespace galet {

using namespace scene_check;

namespace {

bool gaseous(InitialKind kind) { return kind == InitialKind::gas || kind == InitialKind::compressed_gas; }

bool glued(const ListedGrain& grain) { return !grain.body.empty(); }

bool all_periodic(const Scene& scene) {
  return std::find(scene.cell.periodic.begin(), scene.cell.periodic.end(), false) == scene.cell.periodic.end();
}

double largest_diameter(const Scene& scene) {
  if (drawn(scene.initial.kind)) return largest_diameter(scene.grains.diameter);
  double largest = 0;
  for (const ListedGrain& grain : scene.grains.listed) largest = std::max(largest, grain.diameter);
  return largest;
}

bool sound(const SizeDistribution& sizes) {
  return sizes.kind != SizeKind::discrete ||
         (!sizes.diameters.empty() && sizes.diameters.size() == sizes.fractions.size());
}

// ---- grains ------------------------------------------------------------------------------------------------

void check_count(Report& report) {
  const Scene& scene = report.scene;
  const int count = scene.grains.count;
  const auto listed = scene.grains.listed.size();
  if (drawn(scene.initial.kind) && listed == 0)
    report.rule(count > 0 || any_shape(scene), "grains.count", "grains.count is needed: the number of grains",
                {"initial.kind", "grain", "body"});
  if (scene.initial.kind == InitialKind::packing || scene.initial.kind == InitialKind::checkpoint)
    report.rule(count == 0, "grains.count",
                fmt::format("grains.count follows from the {}: leave it out",
                            scene.initial.kind == InitialKind::packing ? "packing file" : "checkpoint"),
                {"initial.kind"});
  if (scene.initial.kind == InitialKind::listed && count > 0 && listed > 0)
    report.rule(
        static_cast<std::size_t>(count) == listed, "grains.count",
        fmt::format("grains.count is {}, but the number of [[grain]] entries is {}: leave it out", count, listed),
        {"initial.kind", "grain"});
}

void check_diameters(Report& report) {
  const SizeDistribution& sizes = report.scene.grains.diameter;
  const Paths kind = {"grains.diameter.distribution", "grains.diameter"};
  const std::string path = "grains.diameter.";
  const bool discrete = sizes.kind == SizeKind::discrete;
  report.rule(!sizes.by_volume || sizes.kind != SizeKind::monodisperse, path + "by",
              "grains.diameter.by needs distribution = \"uniform\" or \"discrete\"", kind);
  report.rule(sizes.spread == 0 || sizes.kind == SizeKind::uniform, path + "spread",
              "grains.diameter.spread needs distribution = \"uniform\"", kind);
  if (!discrete) {
    report.rule(sizes.diameters.empty(), path + "values", "grains.diameter.values needs distribution = \"discrete\"",
                kind);
    report.rule(sizes.fractions.empty(), path + "fractions",
                "grains.diameter.fractions needs distribution = \"discrete\"", kind);
    return;
  }
  const Paths lists = {"grains.diameter.distribution", "grains.diameter.values", "grains.diameter.fractions"};
  report.rule(!sizes.diameters.empty(), path + "values",
              "grains.diameter.values is needed with distribution = \"discrete\"", lists);
  if (sizes.diameters.empty()) return;
  if (sizes.diameters.size() != sizes.fractions.size()) {
    report.add(path + "fractions",
               fmt::format("grains.diameter.fractions: one per value needed: {} values, {} fractions",
                           sizes.diameters.size(), sizes.fractions.size()),
               lists);
    return;
  }
  const double sum = std::accumulate(sizes.fractions.begin(), sizes.fractions.end(), 0.0);
  report.rule(std::abs(sum - 1) <= 1e-9, path + "fractions",
              fmt::format("grains.diameter.fractions: their sum must be 1, it is {:.10g}", sum), lists);
}

void check_listed(Report& report) {
  const Scene& scene = report.scene;
  const auto& listed = scene.grains.listed;
  const bool wanted = scene.initial.kind == InitialKind::listed;
  report.rule(!wanted || !listed.empty(), "initial.kind", "initial.kind = \"listed\" needs [[grain]] entries",
              {"grain"});
  const bool beside = scene.initial.kind == InitialKind::gas || scene.initial.kind == InitialKind::dense;
  report.rule(wanted || listed.empty() || (beside && std::all_of(listed.begin(), listed.end(), glued)), "initial.kind",
              "[[grain]] entries need initial.kind = \"listed\": other kinds make their own grains", {"grain"});
  for (std::size_t k = 0; k < listed.size(); ++k) {
    const std::string path = fmt::format("grain[{}].", k);
    const ListedGrain& grain = listed[k];
    report.components(path + "position", grain.position.size(), false);
    report.components(path + "velocity", grain.velocity.size());
    const bool fits = grain.spin.empty() || grain.spin.size() == (scene.dimension == 2 ? 1 : 3);
    report.rule(fits, path + "spin",
                fmt::format("{}spin: {}, got {} component{}", path,
                            scene.dimension == 2 ? "2D needs a number" : "3D needs 3 components", grain.spin.size(),
                            grain.spin.size() == 1 ? "" : "s"),
                {"dimension"});
    const bool turning = std::any_of(grain.spin.begin(), grain.spin.end(), [](double w) { return w != 0; });
    report.rule(!turning || rotates(scene), path + "spin",
                path + "spin needs material.friction > 0: rotations of frictionless grains are not computed",
                {"material", "other_material", "material_pair"});
  }
}

void check_grains(Report& report) {
  const GrainSpec& grains = report.scene.grains;
  check_count(report);
  check_diameters(report);
  check_listed(report);
  report.rule(!grains.density || !grains.mass, "grains.mass", "grains.density and grains.mass exclude each other",
              {"grains.density"});
  const InitialKind kind = report.scene.initial.kind;
  const bool massive = grains.density || grains.mass || kind == InitialKind::packing || kind == InitialKind::checkpoint;
  report.rule(kind != InitialKind::checkpoint || (!grains.density && !grains.mass), "grains",
              "grains.density and grains.mass have no effect on a checkpoint, whose grains have their masses",
              {"initial.kind"});
  report.rule(report.scene.reduced_units || massive, "grains",
              "grains.density or grains.mass is needed with units = \"SI\"",
              {"units", "initial.kind", "grains.density", "grains.mass"});
}

// ---- initial state and cell --------------------------------------------------------------------------------

/// The largest solid fraction at which the grains can first be placed. Random sequential insertion saturates at
/// 0.547 (disks) and 0.384 (spheres); well below that it is fast. The sites of a square or cubic lattice are at
/// least a largest diameter apart.
double placeable_fraction(const Scene& scene) {
  const int dim = scene.dimension;
  if (gaseous(scene.initial.kind)) return dim == 2 ? 0.5 : 0.33;
  if (scene.initial.kind == InitialKind::dense) return dim == 2 ? 0.83 : 0.62;
  const double equal_grains = dim == 2 ? 0.78 : 0.52;
  return equal_grains * mean_power(scene.grains.diameter, dim, dim) / std::pow(largest_diameter(scene), dim);
}

void check_solid_fraction(Report& report) {
  const Scene& scene = report.scene;
  if (!drawn(scene.initial.kind) || !sound(scene.grains.diameter)) return;
  const double most = placeable_fraction(scene);
  const std::string_view how = gaseous(scene.initial.kind)                ? "random insertion of grains"
                               : scene.initial.kind == InitialKind::dense ? "a dense packing"
                                                                          : "a lattice of these grains";
  const Paths reads = {"dimension", "initial.kind", "grains.diameter", "grains.count"};
  const auto& size = scene.cell.size;
  if (size.empty()) {
    report.rule(scene.initial.solid_fraction <= most, "initial.solid_fraction",
                fmt::format("initial.solid_fraction is {:.4g}: {} in {}D reaches {:.4g}", scene.initial.solid_fraction,
                            how, scene.dimension, most),
                reads);
  } else if (size.size() == static_cast<std::size_t>(scene.dimension)) {
    const double one = scene.dimension == 2 ? grain_volume<2>(1) : grain_volume<3>(1);
    const double volume = std::accumulate(size.begin(), size.end(), 1.0, std::multiplies<>());
    const double fraction =
        scene.grains.count * one * mean_power(scene.grains.diameter, scene.dimension, scene.dimension) / volume;
    report.rule(fraction <= most, "cell.size",
                fmt::format("cell.size: {} grains make a solid fraction of {:.4g}; {} in {}D reaches {:.4g}",
                            scene.grains.count, fraction, how, scene.dimension, most),
                reads);
  }
}

void check_initial(Report& report) {
  const Scene& scene = report.scene;
  const InitialSpec& initial = scene.initial;
  const bool packing = initial.kind == InitialKind::packing, checkpoint = initial.kind == InitialKind::checkpoint;
  const bool compressed = initial.kind == InitialKind::compressed_gas;
  report.rule(!packing || !initial.file.empty(), "initial", "initial.file is needed with kind = \"packing\"",
              {"initial.kind", "initial.file"});
  report.rule(!checkpoint || !initial.file.empty(), "initial", "initial.file is needed with kind = \"checkpoint\"",
              {"initial.kind", "initial.file"});
  report.rule(packing || checkpoint || initial.file.empty(), "initial.file",
              "initial.file needs initial.kind = \"packing\" or \"checkpoint\"", {"initial.kind"});
  report.rule(checkpoint || !initial.fresh_contacts, "initial.contacts",
              "initial.contacts needs initial.kind = \"checkpoint\": other states have no contacts yet",
              {"initial.kind"});
  report.rule(!checkpoint || scene.bodies.empty(), "initial.kind",
              "initial.kind = \"checkpoint\" and [[body]] entries exclude each other: bodies are made of listed grains",
              {"body"});
  const bool readable = initial.file.ends_with(".csv") || initial.file.ends_with(".data");
  report.rule(!packing || initial.file.empty() || readable, "initial.file",
              fmt::format("initial.file: expected a name that ends in .csv (a table) or .data (LAMMPS), got {}",
                          quoted(initial.file)),
              {"initial.kind"});
  report.rule(initial.kind != InitialKind::listed || initial.speed == 0, "initial.speed",
              "initial.speed has no effect on listed grains: give each [[grain]] its velocity", {"initial.kind"});
  report.rule(!checkpoint || initial.speed == 0, "initial.speed",
              "initial.speed has no effect on a checkpoint, whose grains have their velocities", {"initial.kind"});
  report.rule(compressed || !initial.friction, "initial.friction",
              "initial.friction needs initial.kind = \"compressed_gas\"", {"initial.kind"});
  report.rule(!compressed || scene.loading.pressure, "initial.kind",
              "initial.kind = \"compressed_gas\" needs loading.pressure", {"loading.pressure"});
  report.rule(!compressed || all_periodic(scene), "initial.kind",
              "initial.kind = \"compressed_gas\" needs a cell periodic in each direction", {"cell.periodic"});
  check_solid_fraction(report);
}

void check_cell(Report& report) {
  const Scene& scene = report.scene;
  const CellSpec& cell = scene.cell;
  report.components("cell.periodic", cell.periodic.size());
  report.components("cell.size", cell.size.size());
  report.components("cell.aspect", cell.aspect.size());
  report.rule(cell.size.empty() || cell.aspect.empty(), "cell.aspect", "cell.size and cell.aspect exclude each other",
              {"cell.size"});
  report.rule(drawn(scene.initial.kind) || cell.aspect.empty(), "cell.aspect",
              "cell.aspect has no effect on listed grains and packings", {"initial.kind"});
  report.rule(scene.initial.kind != InitialKind::checkpoint || cell.size.empty(), "cell.size",
              "cell.size has no effect on a checkpoint, which brings its cell", {"initial.kind"});
  bool any_periodic = false;
  for (std::size_t a = 0; a < static_cast<std::size_t>(scene.dimension); ++a)
    any_periodic = any_periodic || is_periodic(scene, a);
  const bool listed = scene.initial.kind == InitialKind::listed && !scene.grains.listed.empty();
  report.rule(!listed || !any_periodic || !cell.size.empty(), "cell",
              "cell.size is needed with [[grain]] entries where a direction is periodic",
              {"initial.kind", "grain", "cell.size", "cell.periodic"});
  if (!sound(scene.grains.diameter)) return;
  const double largest = largest_diameter(scene);
  for (std::size_t a = 0; a < std::min<std::size_t>(cell.size.size(), 3); ++a)
    report.rule(!is_periodic(scene, a) || cell.size[a] >= largest, "cell.size",
                fmt::format("cell.size: {:.6g} in the periodic direction {} is less than the largest diameter, {:.6g}",
                            cell.size[a], axis(a), largest),
                {"cell.periodic", "grains.diameter", "grain", "initial.kind"});
}

// ---- compare -----------------------------------------------------------------------------------------------

void check_repeated(Report& report, const std::string& path, std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const auto twice = std::adjacent_find(values.begin(), values.end());
  if (twice != values.end()) report.add(path, fmt::format("{}: {} is there twice", path, *twice));
}

void check_compare(Report& report) {
  const Scene& scene = report.scene;
  const CompareSpec& compare = scene.compare;
  report.rule(compare.inertial_numbers.empty() || scene.loading.inertial_number, "compare.inertial_numbers",
              "compare.inertial_numbers needs loading.inertial_number", {"loading.inertial_number"});
  report.rule(compare.stiffness_levels.empty() || scene.loading.pressure, "compare.stiffness_levels",
              "compare.stiffness_levels needs loading.pressure", {"loading.pressure"});
  check_repeated(report, "compare.inertial_numbers", compare.inertial_numbers);
  check_repeated(report, "compare.stiffness_levels", compare.stiffness_levels);
  check_repeated(report, "compare.cd_dt_factors", compare.cd_dt_factors);
  check_repeated(report, "compare.cd_tolerances", compare.cd_tolerances);
}

}  // namespace

std::vector<Finding> check(const Scene& scene) {
  Report report{scene};
  // The other rules count components: in another dimension their findings would be noise.
  if (scene.dimension != 2 && scene.dimension != 3)
    return {{"dimension", fmt::format("dimension: expected 2 or 3, got {}", scene.dimension), {}}};
  check_grains(report);
  check_material(report);
  check_material_names(report);
  check_relaxers(report);
  check_initial(report);
  check_cell(report);
  check_boundaries(report);
  check_bodies(report);
  check_loadings(report);
  check_output(report);
  check_compare(report);
  return report.findings;
}

}  // namespace galet
