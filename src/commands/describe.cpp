// galet describe: what will run. The numbers that follow from the scene, both engines' time steps, number of steps
// and estimated cost.
#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "common/core/instructions.hpp"
#include "common/scene/loading.hpp"
#include "common/scene/packing.hpp"
#include "common/scene/stages.hpp"
#include "md/grain_order.hpp"
#include "src/commands/arguments.hpp"
#include "src/commands/commands.hpp"
#include "src/compare.hpp"
#include "src/compression.hpp"
#include "src/cost.hpp"
#include "src/dimension.hpp"
#include "src/engines.hpp"
#include "src/text_table.hpp"

namespace galet::cli {

namespace {

struct DescribeArguments {
  SceneArguments scene;
  bool json = false;
};

/// What one engine would do.
struct EngineOutlook {
  EngineKind kind;
  CostEstimate cost;
};

struct Outlook {
  Scene scene;
  Derived derived;
  std::vector<Derived> stages;
  std::vector<EngineOutlook> engines;
  std::vector<std::string> notes;
  int compare_rows = 0;
  double compare_seconds = 0;
};

void add_notes(Outlook& outlook) {
  const Derived& derived = outlook.derived;
  if (!derived.laws.stiff) outlook.notes.push_back("md can't run it: the scene says nothing about stiffness");
  if (derived.md_dt && derived.md_dt_stable && *derived.md_dt > *derived.md_dt_stable)
    outlook.notes.push_back(fmt::format(
        "md.dt is above its stability bound {:.4g}{}", *derived.md_dt_stable,
        outlook.scene.md.allow_unsafe_dt ? ", as allowed by md.allow_unsafe_dt" : ": md will refuse to run"));
  if (derived.md_dt) {
    outlook.notes.push_back(fmt::format("on this machine md uses its {} kernels: {} contacts at once",
                                        to_string(instructions()), lane_width(instructions())));
    const bool sorted = derived.grains.count >= md::least_sorted_grains;
    outlook.notes.push_back(fmt::format("md keeps its grains in memory {} ({} {} grains)",
                                        sorted ? "along Morton's curve, sorted anew when neighbours lie farther apart"
                                               : "in the order of their numbers",
                                        sorted ? "at least" : "fewer than", md::least_sorted_grains));
  }
  if (outlook.scene.initial.kind == InitialKind::compressed_gas)
    outlook.notes.push_back(
        fmt::format("before the run the gas is compressed, for at most {:g} inertial times; that is not in the cost",
                    compression_limit));
}

Outlook outlook_of(const Scene& scene) {
  Outlook outlook;
  outlook.scene = scene;
  const GrainFacts facts = with_dimension(
      scene.dimension, [&](auto dimension) { return grain_facts(scene, initial_sample<dimension>(scene)); });
  outlook.derived = derive(scene, facts);
  outlook.stages = derive_stages(scene, facts);
  if (outlook.derived.md_dt)
    outlook.engines.push_back({EngineKind::md, estimate_cost(EngineKind::md, scene, outlook.derived)});
  outlook.engines.push_back({EngineKind::cd, estimate_cost(EngineKind::cd, scene, outlook.derived)});
  for (const PlannedRow& row : compare_plan(scene)) {
    ++outlook.compare_rows;
    outlook.compare_seconds += estimate_cost(row.engine, row.scene, derive(row.scene, facts)).seconds;
  }
  add_notes(outlook);
  return outlook;
}

std::string restitution_text(const MaterialSpec& material) {
  if (material.restitution) return short_number(*material.restitution);
  return fmt::format("zeta {}", short_number(*material.damping_ratio));
}

/// What each stage drives, and for how long.
std::string stages_text(const Outlook& outlook) {
  if (outlook.scene.stages.empty()) return "";
  TextTable table({"stage", "at most", "mu", "e", "drives", "ends"});
  const std::vector<Scene> scenes = stage_scenes(outlook.scene);
  for (std::size_t k = 0; k < scenes.size(); ++k) {
    const EndSpec& end = scenes[k].run;
    std::string drives, ends;
    for (const CellDrive& drive : loading_drives(scenes[k], outlook.stages[k])) {
      drives += fmt::format("{}{}", drives.empty() ? "" : ", ", drive.component);
      if (drive.rate) drives += fmt::format(" rate {:.4g}", *drive.rate);
      if (drive.hold) drives += " held";
      if (drive.stress) drives += fmt::format(" stress {:.4g}", *drive.stress);
      if (drive.stress_to) drives += fmt::format(" to {:.4g}", *drive.stress_to);
    }
    if (end.equilibrium) ends += fmt::format("equilibrium {:g} ", *end.equilibrium);
    if (end.unbalanced) ends += fmt::format("unbalanced {:g} ", *end.unbalanced);
    if (end.until_stress) ends += fmt::format("sigma_{} {:g} ", end.until, *end.until_stress);
    if (end.until_strain) ends += fmt::format("strain {} {:g} ", end.until, *end.until_strain);
    if (end.cycles > 0) drives += fmt::format(", {} cycles", end.cycles);
    table.add({stage_name(outlook.scene, k), short_number(outlook.stages[k].duration),
               short_number(scenes[k].material.friction), restitution_text(scenes[k].material),
               drives.empty() ? "nothing" : drives, ends.empty() ? "-" : ends});
  }
  return "\n" + table.text();
}

std::string text_of(const Outlook& outlook) {
  std::string text = outlook.scene.title.empty() ? "" : outlook.scene.title + "\n\n";
  std::size_t symbol_width = 0, value_width = 0;
  const std::vector<DerivedLine> lines = explain(outlook.scene, outlook.derived);
  for (const DerivedLine& line : lines) {
    symbol_width = std::max(symbol_width, line.symbol.size());
    value_width = std::max(value_width, line.value.size());
  }
  for (const DerivedLine& line : lines)
    text += fmt::format("{:<{}}  {:<{}}  {}\n", line.symbol, symbol_width, line.value, value_width, line.from);

  text += stages_text(outlook);
  TextTable table({"engine", "dt", "steps", "cost, a guess"});
  for (const EngineOutlook& engine : outlook.engines)
    table.add({engine_name(engine.kind) + (engine.kind == outlook.scene.engine ? " (the scene's)" : ""),
               short_number(engine.cost.dt), fmt::format("{}", engine.cost.steps), duration_text(engine.cost.seconds)});
  text += "\n" + table.text();
  text += fmt::format("galet compare: {} rows, {} of processor time, a guess\n", outlook.compare_rows,
                      duration_text(outlook.compare_seconds));
  for (const std::string& note : outlook.notes) text += "note: " + note + "\n";
  return text;
}

std::string json_of(const Outlook& outlook, const std::string& path) {
  nlohmann::ordered_json json{{"scene", path},
                              {"title", outlook.scene.title},
                              {"layout", to_string(outlook.derived.layout)},
                              {"engine", engine_name(outlook.scene.engine)}};
  json["derived"] = nlohmann::ordered_json::array();
  for (const DerivedLine& line : explain(outlook.scene, outlook.derived))
    json["derived"].push_back({{"symbol", line.symbol}, {"value", line.value}, {"from", line.from}});
  for (const EngineOutlook& engine : outlook.engines)
    json["engines"][engine_name(engine.kind)] = {
        {"dt", engine.cost.dt}, {"steps", engine.cost.steps}, {"estimated_seconds", engine.cost.seconds}};
  for (std::size_t k = 0; k < outlook.scene.stages.size(); ++k)
    json["stages"].push_back({{"name", stage_name(outlook.scene, k)}, {"longest", outlook.stages[k].duration}});
  json["compare"] = {{"rows", outlook.compare_rows}, {"estimated_seconds", outlook.compare_seconds}};
  json["notes"] = outlook.notes;
  return json.dump(2);
}

int describe(const DescribeArguments& arguments) {
  const Outlook outlook = outlook_of(load(arguments.scene));
  fmt::print("{}\n", arguments.json ? json_of(outlook, arguments.scene.path) : text_of(outlook));
  return 0;
}

}  // namespace

void add_describe(CLI::App& app, Action& action) {
  CLI::App* command = app.add_subcommand("describe", "Say what a scene will run: derived numbers, steps, cost");
  auto arguments = std::make_shared<DescribeArguments>();
  add_scene_arguments(*command, arguments->scene);
  command->add_flag("--json", arguments->json, "print one JSON object");
  command->callback([&action, arguments] { action = [arguments] { return describe(*arguments); }; });
}

}  // namespace galet::cli
