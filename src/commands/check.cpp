// galet check: is the scene sound? Every mistake is listed; nothing is run.
#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "common/core/error.hpp"
#include "common/scene/derive.hpp"
#include "common/scene/packing.hpp"
#include "src/commands/arguments.hpp"
#include "src/commands/commands.hpp"
#include "src/dimension.hpp"

namespace galet::cli {

namespace {

struct CheckArguments {
  SceneArguments scene;
  bool json = false;
};

/// Reads the scene, places its grains and derives its numbers: all that can go wrong before a run.
std::vector<Mistake> mistakes_of(const SceneArguments& arguments) {
  try {
    const Scene scene = load(arguments);
    with_dimension(scene.dimension,
                   [&](auto dimension) { derive(scene, grain_facts(scene, initial_sample<dimension>(scene))); });
    return {};
  } catch (const InputError& error) {
    return error.mistakes();
  }
}

int check_scene(const CheckArguments& arguments) {
  const std::vector<Mistake> mistakes = mistakes_of(arguments.scene);
  if (arguments.json) {
    nlohmann::ordered_json json{{"file", arguments.scene.path}, {"ok", mistakes.empty()}};
    json["mistakes"] = nlohmann::ordered_json::array();
    for (const Mistake& mistake : mistakes)
      json["mistakes"].push_back(
          {{"file", mistake.file}, {"line", mistake.line}, {"column", mistake.column}, {"message", mistake.message}});
    fmt::print("{}\n", json.dump(2));
  } else {
    for (const Mistake& mistake : mistakes) fmt::print(stderr, "{}\n", to_string(mistake));
    if (mistakes.empty()) fmt::print("{}: ok\n", arguments.scene.path);
  }
  return mistakes.empty() ? 0 : 2;
}

}  // namespace

void add_check(CLI::App& app, Action& action) {
  CLI::App* command = app.add_subcommand("check", "Check a scene file and list every mistake");
  auto arguments = std::make_shared<CheckArguments>();
  add_scene_arguments(*command, arguments->scene);
  command->add_flag("--json", arguments->json, "print one JSON object");
  command->callback([&action, arguments] { action = [arguments] { return check_scene(*arguments); }; });
}

}  // namespace galet::cli
