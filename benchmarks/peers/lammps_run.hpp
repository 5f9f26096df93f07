// A sample of this project run by LAMMPS (the program `lmp`, GRANULAR package), with the law, the step and the shear
// rate of an md run: writes the data file and the input script, runs, reads the end.
//
// LAMMPS takes velocities of the half step in forces and springs, lever arms R and springs projected on the tangent
// plane; all else can be made equal (lammps_pair).
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "common/scene/pair_law.hpp"
#include "common/scene/sample.hpp"

namespace galet::bench {

/// Ways to say a contact law to LAMMPS.
enum class LammpsPair {
  history,  ///< gran/hooke/history or gran/hertz/history: the quickest ones. Damping gamma m* (Hertz: gamma m* times
            ///< the contact radius, elongations kept when K_T grows): our law for equal grains and the linear law only
  granular  ///< pair_style granular with damping tsuji (alpha = 2 zeta sqrt(m* K_N)) and, for Hertz, tangential
            ///< mindlin_rescale/force: our law for any grains
};

/// The lines pair_style and pair_coeff of a law in convention `total` without tangential viscosity. `mass`, `diameter`:
/// of the grains for which `history` is exact; `force`: normal force at which its Hertz damping equals ours.
std::string lammps_pair(LammpsPair kind, const PairLaw& law, double mass, double diameter, double force);

struct LammpsOptions {
  std::string pair;       ///< of lammps_pair
  bool newton = false;    ///< pairs of an own and a ghost atom are worked on once (on) or twice (off)
  double skin = 0.15;     ///< of the neighbour list, a length
  int sort_every = 1000;  ///< steps between sorts of the atoms by place; 0: never
  double rate = 0;        ///< L_xy, the volume is held
  double dt = 0;
  long warm = 0;   ///< steps before the clock starts
  long steps = 0;  ///< steps under the clock
};

template <int D>
struct EndState {
  std::vector<Vec<D>> position;
  std::vector<Vec<D>> velocity;    ///< fluctuation v
  Mat<D> stress = Mat<D>::Zero();  ///< contact part
  double z = 0;                    ///< mean number of contacts, rattlers counted
  double seconds = 0;              ///< processor time of the steps under the clock
};

/// Is there a program `lmp`?
bool lammps_installed();

/// Throws std::runtime_error naming the log when LAMMPS fails.
template <int D>
EndState<D> run_lammps(const Sample<D>& sample, const LammpsOptions& options, const std::filesystem::path& folder);

extern template EndState<2> run_lammps<2>(const Sample<2>&, const LammpsOptions&, const std::filesystem::path&);
extern template EndState<3> run_lammps<3>(const Sample<3>&, const LammpsOptions&, const std::filesystem::path&);

/// Rms distance of two sets of positions in a cell, over the grains that `weigh` marks (empty: all).
template <int D>
double rms_distance(const Mat<D>& box, const std::vector<Vec<D>>& a, const std::vector<Vec<D>>& b,
                    const std::vector<char>& weigh = {});

extern template double rms_distance<2>(const Mat<2>&, const std::vector<Vec<2>>&, const std::vector<Vec<2>>&,
                                       const std::vector<char>&);
extern template double rms_distance<3>(const Mat<3>&, const std::vector<Vec<3>>&, const std::vector<Vec<3>>&,
                                       const std::vector<char>&);

}  // namespace galet::bench
