// The rules of loadings and ends: those of the scene itself, and those of each of its stages.
#include <algorithm>
#include <set>

#include "common/core/near_match.hpp"
#include "common/scene/check_report.hpp"
#include "common/scene/loading.hpp"

namespace galet::scene_check {

namespace {

/// A loading and its end, and what a file calls them.
struct Part {
  const LoadingSpec& loading;
  const EndSpec& end;
  std::string loading_table;  ///< "loading", "stage[1].loading"
  std::string drive_list;     ///< "drive", "stage[1].drive"
  std::string drive_entries;  ///< "[[drive]]", "[[stage.drive]]"
  std::string end_table;      ///< "run", "stage[1]"
  bool has_unit = false;      ///< whether [loading] gives a pressure for it

  std::string in_loading(const char* field) const { return loading_table + "." + field; }
  std::string in_end(const char* field) const { return end_table + "." + field; }
  bool pressure() const { return loading.pressure || has_unit; }
};

bool all_periodic(const Scene& scene) {
  return std::find(scene.cell.periodic.begin(), scene.cell.periodic.end(), false) == scene.cell.periodic.end();
}

std::string kind_name(LoadingKind kind) {
  const char* names[] = {"none", "plane_shear", "isotropic", "oedometric", "biaxial", "triaxial", "drives"};
  return quoted(names[static_cast<int>(kind)]);
}

// ---- loadings ----------------------------------------------------------------------------------------------

void check_plane_shear(Report& report, const Part& part) {
  const LoadingSpec& loading = part.loading;
  const std::string kind = part.in_loading("kind"), rate = part.in_loading("shear_rate");
  const std::string number = part.in_loading("inertial_number"), pressure = part.in_loading("pressure");
  const bool shear = loading.kind == LoadingKind::plane_shear, axial = has_axis(loading.kind);
  report.rule(!loading.shear_rate || !loading.inertial_number, number,
              fmt::format("{} and {} exclude each other", rate, number), {rate});
  report.rule(!shear || loading.shear_rate || loading.inertial_number, part.loading_table,
              fmt::format("{} or {} is needed with kind = \"plane_shear\"", rate, number), {kind, rate, number});
  report.rule(shear || !loading.shear_rate, rate, fmt::format("{} needs {} = \"plane_shear\"", rate, kind), {kind});
  report.rule(shear || axial || !loading.inertial_number, number,
              fmt::format("{} needs {} = \"plane_shear\", \"oedometric\", \"biaxial\" or \"triaxial\"", number, kind),
              {kind});
  report.rule(!(shear || axial) || !loading.inertial_number || part.pressure(), number,
              fmt::format("{} needs {}: it is the {} rate times sqrt(m / (P d^(D-2)))", number, pressure,
                          shear ? "shear" : "compression"),
              {kind, pressure, "loading.pressure"});
  const std::string fixed = part.in_loading("fixed_volume");
  report.rule(shear || !loading.fixed_volume, fixed, fmt::format("{} needs {} = \"plane_shear\"", fixed, kind), {kind});
}

/// What drives the axis: exactly one thing.
void check_axis(Report& report, const Part& part) {
  const LoadingSpec& loading = part.loading;
  const bool axial = has_axis(loading.kind);
  const std::string kind = part.in_loading("kind");
  Paths given;
  const auto source = [&](bool is_given, const char* field, bool of_axis_only = true) {
    if (!is_given) return;
    const std::string path = part.in_loading(field);
    if (of_axis_only)
      report.rule(axial, path, fmt::format("{} needs {} = \"oedometric\", \"biaxial\" or \"triaxial\"", path, kind),
                  {kind});
    if (axial && !given.empty())
      report.add(path, fmt::format("{} and {} exclude each other", given.back(), path), {given.back()});
    given.push_back(path);
  };
  source(loading.compression_rate.has_value(), "compression_rate");
  source(loading.inertial_number.has_value(), "inertial_number", false);
  source(loading.axial_stress.has_value(), "axial_stress");
  source(loading.hold_axial, "hold_axial");
  report.rule(!axial || !given.empty(), part.loading_table,
              fmt::format("{0}.compression_rate, {0}.inertial_number, {0}.axial_stress or {0}.hold_axial is needed "
                          "with kind = {1}",
                          part.loading_table, kind_name(loading.kind)),
              {part.loading_table});
  const std::string to = part.in_loading("axial_stress_to");
  report.rule(!loading.axial_stress_to || loading.axial_stress || loading.hold_axial, to,
              fmt::format("{0} needs {1}.axial_stress or {1}.hold_axial: where it starts", to, part.loading_table),
              {part.in_loading("axial_stress"), part.in_loading("hold_axial"), kind});
}

void check_dimension(Report& report, const Part& part) {
  const LoadingKind kind = part.loading.kind;
  const std::string path = part.in_loading("kind");
  report.rule(kind != LoadingKind::biaxial || report.scene.dimension == 2, path,
              path + " = \"biaxial\" needs dimension = 2: \"triaxial\" is its counterpart in 3D", {"dimension"});
  report.rule(kind != LoadingKind::triaxial || report.scene.dimension == 3, path,
              path + " = \"triaxial\" needs dimension = 3: \"biaxial\" is its counterpart in 2D", {"dimension"});
}

void check_pressure(Report& report, const Part& part) {
  const LoadingSpec& loading = part.loading;
  const std::string kind = part.in_loading("kind"), pressure = part.in_loading("pressure");
  const bool lateral = loading.kind == LoadingKind::biaxial || loading.kind == LoadingKind::triaxial;
  const bool isotropic = loading.kind == LoadingKind::isotropic;
  report.rule(!(isotropic || lateral) || part.pressure(), part.loading_table,
              fmt::format("{} is needed with kind = {}", pressure, kind_name(loading.kind)),
              {kind, pressure, "loading.pressure"});
  const std::string to = part.in_loading("pressure_to");
  if (!loading.pressure_to) return;
  const bool held =
      isotropic || lateral || (loading.kind == LoadingKind::plane_shear && part.pressure() && !loading.fixed_volume);
  report.rule(held, to, fmt::format("{} needs a {} that holds {}", to, kind, pressure),
              {kind, pressure, part.in_loading("fixed_volume"), "loading.pressure"});
}

/// Inclined gravity pulls along x, also where x is periodic: something must hold the grains back.
void check_inclination(Report& report, const Part& part) {
  const Scene& scene = report.scene;
  const std::string path = part.in_loading("inclination");
  if (!part.loading.inclination) return;
  const bool pulled = !part.loading.gravity.empty() || !scene.loading.gravity.empty();
  report.rule(pulled, path, fmt::format("{} needs {}: what it turns", path, part.in_loading("gravity")),
              {part.in_loading("gravity"), "loading.gravity"});
  report.rule(!scene.planes.empty() || !scene.cylinders.empty() || !scene.bodies.empty(), path,
              path + " needs a floor, a [[plane]] or a [[body]] that is not free: grains would fall forever",
              {"plane", "body", "cylinder"});
}

void check_gravity(Report& report, const Part& part) {
  const Scene& scene = report.scene;
  check_inclination(report, part);
  const auto& gravity = part.loading.gravity;
  const std::string path = part.in_loading("gravity");
  report.components(path, gravity.size());
  if (gravity.size() != static_cast<std::size_t>(scene.dimension)) return;
  for (std::size_t a = 0; a < gravity.size(); ++a)
    report.rule(gravity[a] == 0 || !is_periodic(scene, a), path,
                fmt::format("{}: {} is a periodic direction, in which grains would fall forever; set cell.periodic to "
                            "false there{}",
                            path, axis(a), a == 0 ? ", or turn gravity by " + part.in_loading("inclination") : ""),
                {"cell.periodic", "dimension"});
}

/// Rate, stress or hold: exactly one.
void check_drive_source(Report& report, const std::string& entry, const CellDrive& drive) {
  const std::string rate = entry + ".rate", stress = entry + ".stress", hold = entry + ".hold";
  report.rule(!drive.rate || !drive.stress, stress, fmt::format("{} and {} exclude each other", rate, stress), {rate});
  report.rule(!drive.rate || !drive.hold, hold, fmt::format("{} and {} exclude each other", rate, hold), {rate});
  report.rule(!drive.stress || !drive.hold, hold, fmt::format("{} and {} exclude each other", stress, hold), {stress});
  report.rule(drive.rate || drive.stress || drive.hold, entry, fmt::format("{}: rate or stress is needed", entry),
              {rate, stress, hold});
  report.rule(!drive.stress_to || drive.stress || drive.hold, entry + ".stress_to",
              fmt::format("{0}.stress_to needs {0}.stress or {0}.hold: where it starts", entry), {stress, hold});
}

void check_drives(Report& report, const Part& part) {
  const auto& drives = part.loading.drives;
  const std::string kind = part.in_loading("kind");
  const bool wanted = part.loading.kind == LoadingKind::drives;
  report.rule(!wanted || !drives.empty(), kind,
              fmt::format("{} = \"drives\" needs {} entries", kind, part.drive_entries), {part.drive_list});
  report.rule(wanted || drives.empty(), part.drive_list,
              fmt::format("{} entries need {} = \"drives\"", part.drive_entries, kind), {kind});
  const Paths names = component_names(report.scene.dimension);
  std::set<std::string> seen;
  const bool isotropic =
      std::any_of(drives.begin(), drives.end(), [](const CellDrive& drive) { return drive.component == "isotropic"; });
  for (std::size_t k = 0; k < drives.size(); ++k) {
    const CellDrive& drive = drives[k];
    const std::string entry = fmt::format("{}[{}]", part.drive_list, k), component = entry + ".component";
    const bool known = std::find(names.begin(), names.end(), drive.component) != names.end();
    report.rule(known, component,
                fmt::format("{}: expected {}, got {}{}", component, alternatives(quoted(names)),
                            quoted(drive.component), suggestion(drive.component, names)),
                {"dimension"});
    report.rule(!known || seen.insert(drive.component).second, component,
                fmt::format("{}: {} is driven twice", component, quoted(drive.component)));
    const bool diagonal = drive.component.size() == 2 && drive.component[0] == drive.component[1];
    report.rule(!known || !isotropic || !diagonal, component,
                fmt::format("{}: {} and \"isotropic\" drive the same rate", component, quoted(drive.component)));
    check_drive_source(report, entry, drive);
  }
}

void check_loading(Report& report, const Part& part) {
  check_plane_shear(report, part);
  check_axis(report, part);
  check_dimension(report, part);
  check_gravity(report, part);
  check_drives(report, part);
  check_pressure(report, part);
  report.rule(part.loading.kind == LoadingKind::none || all_periodic(report.scene), "cell.periodic",
              fmt::format("cell.periodic: this {} moves the cell, which must be periodic in each direction",
                          part.in_loading("kind")),
              {part.in_loading("kind")});
}

// ---- ends --------------------------------------------------------------------------------------------------

void check_equilibrium(Report& report, const Part& part) {
  const EndSpec& end = part.end;
  const Paths reads = {part.loading_table, part.drive_list, "loading.pressure", part.in_end("cycles")};
  const auto asked = [&](bool given, const char* field) {
    if (!given) return;
    const std::string path = part.in_end(field);
    report.rule(!imposes_rate(part.loading), path,
                path + " needs a loading that imposes no rate: with one nothing comes to rest", reads);
    report.rule(!has_changing_stress(part.loading), path,
                path + " needs stresses that don't change: nothing comes to rest before they stop", reads);
    report.rule(part.pressure(), path,
                fmt::format("{} needs {}: stresses and energies are compared with it", path, "loading.pressure"),
                reads);
  };
  asked(end.equilibrium.has_value(), "equilibrium");
  asked(end.unbalanced.has_value(), "unbalanced");
  const std::string tolerance = part.in_end("stress_tolerance");
  report.rule(!end.stress_tolerance || end.equilibrium || end.unbalanced, tolerance,
              fmt::format("{} needs {} or {}", tolerance, part.in_end("equilibrium"), part.in_end("unbalanced")),
              {part.in_end("equilibrium"), part.in_end("unbalanced")});
}

void check_until(Report& report, const Part& part) {
  const EndSpec& end = part.end;
  const std::string until = part.in_end("until"), stress = part.in_end("until_stress"),
                    strain = part.in_end("until_strain");
  const Paths names = component_names(report.scene.dimension);
  const bool known = std::find(names.begin(), names.end(), end.until) != names.end();
  report.rule(end.until.empty() || known, until,
              fmt::format("{}: expected {}, got {}{}", until, alternatives(quoted(names)), quoted(end.until),
                          suggestion(end.until, names)),
              {"dimension"});
  report.rule(end.until.empty() || end.until_stress || end.until_strain, until,
              fmt::format("{} needs {} or {}", until, stress, strain), {stress, strain});
  report.rule(!end.until_stress || !end.until_strain, strain,
              fmt::format("{} and {} exclude each other", stress, strain), {stress});
  report.rule(!end.until_stress || !end.until.empty(), stress,
              fmt::format("{} needs {}: the component that reaches it", stress, until), {until});
  report.rule(!end.until_strain || !end.until.empty(), strain,
              fmt::format("{} needs {}: the component that reaches it", strain, until), {until});
}

void check_end(Report& report, const Part& part) {
  const EndSpec& end = part.end;
  const std::string duration = part.in_end("duration"), strain = part.in_end("strain"), cycles = part.in_end("cycles");
  const bool moves = imposes_rate(part.loading);
  report.rule(!end.duration || !end.strain, strain, fmt::format("{} and {} exclude each other", duration, strain),
              {duration});
  report.rule(end.duration || end.strain, part.end_table, fmt::format("{} or {} is needed", duration, strain),
              {duration, strain});
  report.rule(!end.strain || moves, strain, strain + " needs a loading that imposes a rate",
              {part.loading_table, part.drive_list});
  report.rule(end.cycles == 0 || moves || has_changing_stress(part.loading), cycles,
              cycles + " needs a loading that imposes a rate or a stress that changes",
              {part.loading_table, part.drive_list});
  check_equilibrium(report, part);
  check_until(report, part);
}

/// What belongs to the stages is not said of the whole.
void check_whole_of_stages(Report& report) {
  const Scene& scene = report.scene;
  const EndSpec& end = scene.run;
  const auto refuse = [&](bool given, const char* path) {
    report.rule(!given, path, fmt::format("{} and [[stage]] entries exclude each other: each stage has its own", path),
                {"stage"});
  };
  refuse(scene.loading.kind != LoadingKind::none, "loading.kind");
  refuse(!scene.loading.drives.empty(), "drive");
  refuse(end.duration.has_value(), "run.duration");
  refuse(end.strain.has_value(), "run.strain");
  refuse(end.equilibrium.has_value(), "run.equilibrium");
  refuse(end.unbalanced.has_value(), "run.unbalanced");
  refuse(!end.until.empty(), "run.until");
  refuse(end.cycles > 0, "run.cycles");
  std::set<std::string> names;
  for (std::size_t k = 0; k < scene.stages.size(); ++k) {
    const std::string& name = scene.stages[k].name;
    report.rule(name.empty() || names.insert(name).second, fmt::format("stage[{}].name", k),
                fmt::format("stage[{}].name: {} is the name of another stage already", k, quoted(name)));
  }
}

}  // namespace

void check_loadings(Report& report) {
  const Scene& scene = report.scene;
  if (scene.stages.empty()) {
    const Part whole{scene.loading, scene.run, "loading", "drive", "[[drive]]", "run"};
    check_loading(report, whole);
    check_end(report, whole);
    return;
  }
  check_whole_of_stages(report);
  for (std::size_t k = 0; k < scene.stages.size(); ++k) {
    const StageSpec& stage = scene.stages[k];
    const std::string at = fmt::format("stage[{}]", k);
    const Part part{stage.loading,
                    stage,
                    at + ".loading",
                    at + ".drive",
                    "[[stage.drive]]",
                    at,
                    scene.loading.pressure.has_value()};
    check_loading(report, part);
    check_end(report, part);
  }
}

bool imposes_flow(const Scene& scene) {
  return imposes_rate(scene.loading) || std::any_of(scene.stages.begin(), scene.stages.end(),
                                                    [](const StageSpec& stage) { return imposes_rate(stage.loading); });
}

}  // namespace galet::scene_check
