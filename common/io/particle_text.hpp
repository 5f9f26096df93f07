// States as text for programs that show particles: extended XYZ (OVITO, ASE) and LAMMPS text dumps.
//   extended XYZ  Lattice="a b c" (cell vectors, one after the other), pbc, Time, Properties=
//                 id:I:1:species:S:1:pos:R:3:radius:R:1:mass:R:1:velo:R:3:omega:R:3. OVITO takes `radius` as Radius.
//   LAMMPS dump   ITEM: BOX BOUNDS with tilt where the cell is tilted; ITEM: ATOMS id type radius mass x y z vx vy vz
//                 omegax omegay omegaz; read by LAMMPS (rerun, read_dump) and OVITO. The box must be upper triangular
//                 (std::invalid_argument): LAMMPS knows no other.
// One state per text. Positions inside the cell, velocities v + L x. Species and type: material + 1. Disks have z = 0
// in a cell that is open along z and as thick as the largest disk. Numbers in the shortest form that reads back to the
// same bits.
#pragma once

#include <string>
#include <vector>

#include "common/engine/snapshot.hpp"

namespace galet {

template <int D>
std::string extended_xyz(const Snapshot<D>& snapshot, const std::vector<int>& material = {});

/// `step`: the number that the dump calls its timestep.
template <int D>
std::string lammps_dump(const Snapshot<D>& snapshot, long step, const std::vector<int>& material = {});

extern template std::string extended_xyz<2>(const Snapshot<2>&, const std::vector<int>&);
extern template std::string extended_xyz<3>(const Snapshot<3>&, const std::vector<int>&);
extern template std::string lammps_dump<2>(const Snapshot<2>&, long, const std::vector<int>&);
extern template std::string lammps_dump<3>(const Snapshot<3>&, long, const std::vector<int>&);

}  // namespace galet
