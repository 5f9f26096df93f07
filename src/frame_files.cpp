#include "src/frame_files.hpp"

#include <filesystem>

#include <fmt/format.h>

#include "common/core/error.hpp"
#include "common/io/files.hpp"
#include "common/io/particle_text.hpp"
#include "common/io/vtk.hpp"

namespace galet {

namespace {

std::string numbered(const std::string& stem, long index, const char* extension) {
  return fmt::format("{}_{:06}{}", stem, index, extension);
}

/// The files that ParaView gets of a state.
struct Part {
  const char* name;
  std::string text;
};

template <int D>
std::vector<Part> paraview_parts(const Snapshot<D>& snapshot, const std::vector<int>& material) {
  std::vector<Part> parts = {
      {"grains", vtp_grains(snapshot, material)}, {"contacts", vtp_contacts(snapshot)}, {"cell", vtp_cell(snapshot)}};
  if (!snapshot.planes.empty()) parts.push_back({"walls", vtp_walls(snapshot)});
  return parts;
}

}  // namespace

FrameFiles::FrameFiles(std::string stem, std::vector<std::string> formats, std::vector<int> material, bool si)
    : stem_(std::move(stem)), formats_(std::move(formats)), material_(std::move(material)), si_(si) {
  if (formats_.empty()) formats_ = {"paraview"};
}

template <int D>
void FrameFiles::write(const Frame& frame, const Snapshot<D>& snapshot) const {
  const long index = static_cast<long>(frame.times.size()) - 1;
  for (const std::string& format : formats_) {
    if (format == "xyz") write_file(numbered(stem_, index, ".xyz"), extended_xyz(snapshot, material_));
    if (format == "lammps") write_file(numbered(stem_, index, ".dump"), lammps_dump(snapshot, frame.step, material_));
    if (format == "hdf5") {
      write_file(numbered(stem_, index, ".h5"), hdf5_state(snapshot, {frame.step, material_, si_}));
      const std::string name = std::filesystem::path(stem_).filename().string();
      std::vector<std::string> files;
      for (std::size_t k = 0; k < frame.times.size(); ++k) files.push_back(numbered(name, static_cast<long>(k), ".h5"));
      write_file(stem_ + "_trajectory.h5", hdf5_trajectory(frame.times, frame.steps, files));
    }
    if (format != "paraview") continue;
    for (const Part& part : paraview_parts(snapshot, material_)) {
      const std::string stem = stem_ + '_' + part.name;
      write_file(numbered(stem, index, ".vtp"), part.text);
      std::vector<std::pair<double, std::string>> files;
      for (std::size_t k = 0; k < frame.times.size(); ++k)
        files.emplace_back(frame.times[k],
                           numbered(std::filesystem::path(stem).filename().string(), static_cast<long>(k), ".vtp"));
      write_file(stem + ".pvd", pvd(files));
    }
  }
}

std::vector<std::string> FrameFiles::opened() const {
  std::vector<std::string> names;
  for (const std::string& format : formats_) {
    if (format == "paraview")
      for (const char* part : {"grains", "contacts", "cell", "walls"})  // no walls, no file of them
        if (std::filesystem::exists(stem_ + '_' + part + ".pvd")) names.push_back(stem_ + '_' + part + ".pvd");
    if (format == "xyz") names.push_back(stem_ + "_*.xyz");
    if (format == "lammps") names.push_back(stem_ + "_*.dump");
    if (format == "hdf5") names.push_back(stem_ + "_trajectory.h5");
  }
  return names;
}

template <int D>
std::vector<std::string> write_state(const std::string& stem, const std::string& format, const Snapshot<D>& snapshot,
                                     const StateLabels& labels) {
  std::vector<std::string> paths;
  const auto put = [&](const std::string& path, const std::string& text) {
    write_file(path, text);
    paths.push_back(path);
  };
  if (format == "xyz") put(stem + ".xyz", extended_xyz(snapshot, labels.material));
  if (format == "dump") put(stem + ".dump", lammps_dump(snapshot, labels.step, labels.material));
  if (format == "hdf5") put(stem + ".h5", hdf5_state(snapshot, labels));
  if (format == "paraview") {
    for (const Part& part : paraview_parts(snapshot, labels.material)) put(stem + '_' + part.name + ".vtp", part.text);
  }
  require(!paths.empty(), "a state is written as paraview, hdf5, xyz or dump");
  return paths;
}

template void FrameFiles::write<2>(const Frame&, const Snapshot<2>&) const;
template void FrameFiles::write<3>(const Frame&, const Snapshot<3>&) const;
template std::vector<std::string> write_state<2>(const std::string&, const std::string&, const Snapshot<2>&,
                                                 const StateLabels&);
template std::vector<std::string> write_state<3>(const std::string&, const std::string&, const Snapshot<3>&,
                                                 const StateLabels&);

}  // namespace galet
