// Files of states at intervals of a run (output.frames), and of one state (galet export).
//
//   md_grains_000012.vtp, the same of contacts, cell and walls (if any), and md_grains.pvd, ...   paraview
//   md_000012.h5 and md_trajectory.h5                                                        hdf5
//   md_000012.xyz                                                                            xyz
//   md_000012.dump                                                                           lammps
// Each file is written under another name and renamed, and a collection is written after what it lists: at every
// moment, also after a crash, it is whole and names whole files only.
#pragma once

#include <string>
#include <vector>

#include "common/engine/snapshot.hpp"
#include "common/io/hdf5_states.hpp"
#include "src/run_control.hpp"

namespace galet {

class FrameFiles {
 public:
  /// `stem`: the files' common beginning, with their folder. No format: "paraview". `si`: units are SI.
  FrameFiles(std::string stem, std::vector<std::string> formats, std::vector<int> material, bool si = false);

  /// Writes the files of frame `frame`, whose state `snapshot` is.
  template <int D>
  void write(const Frame& frame, const Snapshot<D>& snapshot) const;

  /// What a user opens of what was written: the collections, or the pattern of the file names.
  std::vector<std::string> opened() const;

 private:
  std::string stem_;
  std::vector<std::string> formats_;
  std::vector<int> material_;
  bool si_;
};

/// One state, without numbers and collections: stem_grains.vtp, ..., or stem.xyz, stem.dump or stem.h5. Returns the
/// paths.
template <int D>
std::vector<std::string> write_state(const std::string& stem, const std::string& format, const Snapshot<D>& snapshot,
                                     const StateLabels& labels);

extern template void FrameFiles::write<2>(const Frame&, const Snapshot<2>&) const;
extern template void FrameFiles::write<3>(const Frame&, const Snapshot<3>&) const;
extern template std::vector<std::string> write_state<2>(const std::string&, const std::string&, const Snapshot<2>&,
                                                        const StateLabels&);
extern template std::vector<std::string> write_state<3>(const std::string&, const std::string&, const Snapshot<3>&,
                                                        const StateLabels&);

}  // namespace galet
