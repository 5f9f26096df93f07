// galet picture: the state of a checkpoint as a picture. Disks: grains and force chains as SVG and PNG. Spheres: a PNG
// file drawn by VTK.
#include <filesystem>
#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "common/core/error.hpp"
#include "common/io/checkpoint.hpp"
#include "common/io/svg.hpp"
#include "src/commands/commands.hpp"
#include "src/dimension.hpp"
#include "src/picture_files.hpp"
#include "src/render.hpp"
#include "src/restart.hpp"
#include "src/simulation.hpp"

namespace galet::cli {

namespace {

namespace fs = std::filesystem;

struct PictureArguments {
  std::string checkpoint;
  std::string out;
  std::optional<std::string> colour;
  std::optional<int> width;
};

int draw_disks(const PictureArguments& arguments, const std::string& stem, Simulation<2>& simulation) {
  if (arguments.colour)
    throw InputError("--colour is for spheres: grains of a picture of disks are grey, their forces coloured");
  std::vector<std::string> files;
  SvgOptions options{simulation.scene().title};
  if (arguments.width) options.width = *arguments.width;
  galet::add_picture(files, stem, force_chain_svg(simulation.engine().snapshot(), options));
  for (const std::string& file : files) fmt::print("wrote {}\n", file);
  return 0;
}

int draw_spheres(const PictureArguments& arguments, const std::string& stem, Simulation<3>& simulation) {
  RenderOptions options{simulation.scene().title};
  if (arguments.colour == "coordination") options.colour = GrainColour::coordination;
  if (arguments.width) options.width = *arguments.width;
  const std::string missing = render_spheres(stem + ".png", simulation.engine().snapshot(), options);
  if (!missing.empty()) throw RunError(missing);
  fmt::print("wrote {}.png\n", stem);
  return 0;
}

int draw(const PictureArguments& arguments) {
  const Archive archive = read_checkpoint(arguments.checkpoint);
  const Scene scene = stored_scene(archive);
  const fs::path named = arguments.out.empty() ? arguments.checkpoint : arguments.out;
  const std::string stem = (named.parent_path() / named.stem()).string();
  return with_dimension(scene.dimension, [&](auto dimension) {
    Simulation<dimension> simulation = Simulation<dimension>::resume(scene, archive);
    if constexpr (dimension == 2)
      return draw_disks(arguments, stem, simulation);
    else
      return draw_spheres(arguments, stem, simulation);
  });
}

}  // namespace

void add_picture(CLI::App& app, Action& action) {
  CLI::App* command = app.add_subcommand("picture", "Draw the state of a checkpoint");
  auto arguments = std::make_shared<PictureArguments>();
  command->add_option("FILE", arguments->checkpoint, "checkpoint of a run (.h5)")->required();
  command->add_option("--out", arguments->out,
                      "picture to write (default: beside the checkpoint); its extension follows from the dimension: "
                      ".svg and .png of disks, .png of spheres");
  command->add_option("--colour", arguments->colour, "spheres: what grains are coloured by (default: speed)")
      ->check(CLI::IsMember({"speed", "coordination"}));
  command->add_option("--width", arguments->width, "pixels (default: 900 for disks, 1600 for spheres)")
      ->check(CLI::Range(400, 8000));
  command->callback([&action, arguments] { action = [arguments] { return draw(*arguments); }; });
}

}  // namespace galet::cli
