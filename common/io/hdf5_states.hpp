// States and tables as HDF5 files, for h5py and its like.
//
//   state        attributes of the root: format "galet state", version, dimension, engine, time, step
//     /cell        box (row a, column b: component a of cell vector b), rate (velocity gradient), strain, periodic
//     /grains      position (inside the cell), velocity (v + L x), fluctuation (v), angular_velocity (absent without
//                  friction), radius, mass, material and, in scenes with rigid bodies, body (-1: none)
//     /contacts    i, j (a plane's number follows the grains'), normal (from i to j), branch, gap, force (on j),
//     touching
//                  and, with friction, mobilised
//     /planes      point, normal, velocity; radius (0: a plane, else a cylinder), inside (1: grains are in the
//     cylinder),
//                  angular_velocity and, in 3D, axis of a cylinder
//   trajectory   time, step of each frame; /frames/000012 leads to the state in a file of its own (an external link)
//   table        a dataset per column
//
// One row per grain, contact or plane: arrays of N x D (spins: N in the plane, N x 3 in space). A dataset that measures
// something has the attribute "unit" in a scene in SI units. Numbers are the snapshot's, bit for bit. A state never
// changes once it is written, and a trajectory is written after the states that it names: a reader, also after a crash,
// finds whole files. Equal states give equal files.
#pragma once

#include <string>
#include <vector>

#include "common/engine/snapshot.hpp"
#include "common/io/csv.hpp"

namespace galet {

struct StateLabels {
  long step = 0;
  std::vector<int> material;  ///< of each grain; empty: all 0
  bool si = false;            ///< units are SI, not the scene's own
};

/// The bytes of a state's file.
template <int D>
std::string hdf5_state(const Snapshot<D>& snapshot, const StateLabels& labels);

/// The bytes of a trajectory: the times and steps of the states, and the names of their files in the same folder.
std::string hdf5_trajectory(const std::vector<double>& times, const std::vector<long>& steps,
                            const std::vector<std::string>& files);

/// The bytes of a table of numbers; empty cells become NaN. Comments "column: meaning" become the attribute "meaning"
/// of their columns, others an attribute of the root.
std::string hdf5_table(const CsvTable& table);

extern template std::string hdf5_state<2>(const Snapshot<2>&, const StateLabels&);
extern template std::string hdf5_state<3>(const Snapshot<3>&, const StateLabels&);

}  // namespace galet
