// galet export: the grains of a checkpoint for other programs, or as a packing for initial.kind = "packing".
#include <filesystem>
#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "common/io/checkpoint.hpp"
#include "common/io/lammps.hpp"
#include "common/io/packing_csv.hpp"
#include "src/commands/commands.hpp"
#include "src/dimension.hpp"
#include "src/frame_files.hpp"
#include "src/restart.hpp"
#include "src/simulation.hpp"

namespace galet::cli {

namespace {

struct ExportArguments {
  std::string checkpoint;
  std::string format = "csv";
  std::string out;
};

/// Formats that show a state, contacts included, and start no other run.
bool is_state(const std::string& format) { return format != "csv" && format != "lammps"; }

template <int D>
void write_sample(const ExportArguments& arguments, const std::string& path, const Sample<D>& sample) {
  if (arguments.format == "lammps")
    write_lammps_data(path, sample);
  else
    write_packing_csv(path, sample);
}

int export_sample(const ExportArguments& arguments) {
  const Archive archive = read_checkpoint(arguments.checkpoint);
  const Scene scene = stored_scene(archive);
  const char* extension = arguments.format == "lammps" ? ".data" : ".csv";
  const std::string path = arguments.out.empty()
                               ? std::filesystem::path(arguments.checkpoint).replace_extension(extension).string()
                               : arguments.out;
  with_dimension(scene.dimension, [&](auto dimension) {
    Simulation<dimension> simulation = Simulation<dimension>::resume(scene, archive);
    if (is_state(arguments.format)) {
      std::string stem = std::filesystem::path(path).replace_extension().string();
      // A state in HDF5 has the extension of the checkpoint, which it must not take the place of.
      if (arguments.format == "hdf5" && arguments.out.empty()) stem += "_state";
      const StateLabels labels{simulation.engine().steps(), simulation.material(), !scene.reduced_units};
      const auto files = write_state<dimension>(stem, arguments.format, simulation.engine().snapshot(), labels);
      for (const std::string& file : files) fmt::print("wrote {}\n", file);
      return;
    }
    const auto sample = simulation.present_sample();
    write_sample<dimension>(arguments, path, sample);
    fmt::print("{}: {} grains at time {:g}, velocities are fluctuations about the cell's flow\n", path, sample.count(),
               simulation.engine().time());
    if (!sample.planes.empty()) fmt::print(stderr, "note: planes have no place in a packing file\n");
  });
  return 0;
}

}  // namespace

void add_export(CLI::App& app, Action& action) {
  CLI::App* command = app.add_subcommand("export", "Write the grains of a checkpoint for other programs or runs");
  auto arguments = std::make_shared<ExportArguments>();
  command->add_option("FILE", arguments->checkpoint, "checkpoint of a run (.h5)")->required();
  command
      ->add_option(
          "--format", arguments->format,
          "csv or lammps, a data file (both read again by initial.kind = \"packing\"); to look at: paraview, hdf5, "
          "xyz (extended XYZ) or dump (LAMMPS)")
      ->check(CLI::IsMember({"csv", "lammps", "paraview", "hdf5", "xyz", "dump"}))
      ->capture_default_str();
  command->add_option(
      "--out", arguments->out,
      "file to write (default: beside the checkpoint); paraview: its name without extension begins three");
  command->callback([&action, arguments] { action = [arguments] { return export_sample(*arguments); }; });
}

}  // namespace galet::cli
