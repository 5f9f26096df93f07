// Files of states at intervals of a run (output.frames), and of one state (galet export).
//
//   md_grains_000012.vtp, md_contacts_000012.vtp, md_cell_000012.vtp and md_grains.pvd, ...   paraview
//   md_000012.xyz                                                                            xyz
//   md_000012.dump                                                                           lammps
// Each file is written under another name and renamed, and a collection is written after what it lists: at every
// moment, also after a crash, it is whole and names whole files only.
#pragma once

#include <string>
#include <vector>

#include "common/engine/snapshot.hpp"
#include "src/run_control.hpp"

namespace galet {

class FrameFiles {
 public:
  /// `stem`: the files' common beginning, with their folder. No format: "paraview".
  FrameFiles(std::string stem, std::vector<std::string> formats, std::vector<int> material);

  /// Writes the files of frame `frame`, whose state `snapshot` is.
  template <int D>
  void write(const Frame& frame, const Snapshot<D>& snapshot) const;

  /// What a user opens: the collections, or the pattern of the file names.
  std::vector<std::string> opened() const;

 private:
  std::string stem_;
  std::vector<std::string> formats_;
  std::vector<int> material_;
};

/// One state, without numbers and collections: stem_grains.vtp, ..., or stem.xyz, or stem.dump. Returns the paths.
template <int D>
std::vector<std::string> write_state(const std::string& stem, const std::string& format, const Snapshot<D>& snapshot,
                                     long step, const std::vector<int>& material);

extern template void FrameFiles::write<2>(const Frame&, const Snapshot<2>&) const;
extern template void FrameFiles::write<3>(const Frame&, const Snapshot<3>&) const;
extern template std::vector<std::string> write_state<2>(const std::string&, const std::string&, const Snapshot<2>&,
                                                        long, const std::vector<int>&);
extern template std::vector<std::string> write_state<3>(const std::string&, const std::string&, const Snapshot<3>&,
                                                        long, const std::vector<int>&);

}  // namespace galet
