#include "src/render.hpp"

#include <filesystem>

#include <fmt/format.h>

#include "common/core/error.hpp"
#include "common/io/files.hpp"
#include "common/io/program.hpp"
#include "common/io/scratch_folder.hpp"
#include "common/io/vtk.hpp"
#include "src/data_files.hpp"

namespace galet {

namespace {

// Exit codes of render.py.
constexpr int no_vtk = 3, no_context = 4;

}  // namespace

std::string render_spheres(const std::string& path, const Snapshot<3>& snapshot, const RenderOptions& options) {
  require(options.width >= 400 && options.width <= 8000, "a picture of spheres is 400 to 8000 pixels wide");
  const ScratchFolder folder;
  write_file(folder.file("grains.vtp"), vtp_grains(snapshot));
  write_file(folder.file("contacts.vtp"), vtp_contacts(snapshot));
  write_file(folder.file("cell.vtp"), vtp_cell(snapshot));
  write_file(folder.file("walls.vtp"), vtp_walls(snapshot));
  const std::string colour = options.colour == GrainColour::speed ? "speed" : "coordination",
                    script = data_file("render.py");
  // The system's own Python has the system's packages, whatever comes first along PATH.
  for (const char* python : {"python3", "/usr/bin/python3"}) {
    const ProgramEnd end = run_program({python, script, folder.path(), folder.file("picture.png"), colour,
                                        fmt::format("{}", options.width), options.title});
    if (end.well()) {
      write_file(path, read_file(folder.file("picture.png")));
      return "";
    }
    if (end.found && end.code == no_context)
      return "pictures of spheres need OpenGL in software (Debian packages libegl1 and libgl1-mesa-dri)";
    if (end.found && end.code != no_vtk) throw RunError(fmt::format("can't draw '{}': {}", path, trim(end.messages)));
  }
  return "pictures of spheres need VTK for Python 3 (Debian package python3-vtk9)";
}

}  // namespace galet
