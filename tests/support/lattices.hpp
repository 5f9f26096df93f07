// Crystals of touching grains in a periodic cell, for measures that have closed forms on them.
#pragma once

#include <cmath>
#include <vector>

#include "common/scene/sample.hpp"
#include "tests/support/brute_force.hpp"

namespace galet::test {

inline constexpr double lattice_force = 2.7, lattice_diameter = 1.3;

/// Grains of one diameter on the sites cell * (k + basis) of an n x n (x n) piece of a Bravais lattice with basis.
template <int D>
Sample<D> crystal(const Mat<D>& unit, const std::vector<Vec<D>>& basis, int n) {
  Sample<D> sample;
  sample.cell.box = n * unit;
  sample.cell.periodic.fill(true);
  int cells = 1;
  for (int a = 0; a < D; ++a) cells *= n;
  sample.resize(cells * static_cast<int>(basis.size()));
  sample.radius.assign(sample.count(), lattice_diameter / 2);
  int grain = 0;
  for (int code = 0; code < cells; ++code) {
    Vec<D> k;
    for (int a = 0, rest = code; a < D; ++a, rest /= n) k[a] = rest % n;
    for (const Vec<D>& site : basis) sample.position[grain++] = unit * (k + site);
  }
  return sample;
}

template <int D>
ContactColumns<D> touching(const Sample<D>& sample) {
  return brute_force_contacts<D>(sample, 1e-9, [](int, int, double) { return lattice_force; });
}

inline Sample<2> triangular(int n) {
  Mat<2> unit;
  unit << 1, 0.5, 0, std::sqrt(3.0) / 2;
  return crystal<2>(lattice_diameter * unit, {Vec<2>::Zero()}, n);
}
inline Sample<2> square(int n) { return crystal<2>(lattice_diameter * Mat<2>::Identity(), {Vec<2>::Zero()}, n); }
inline Sample<3> cubic(int n) { return crystal<3>(lattice_diameter * Mat<3>::Identity(), {Vec<3>::Zero()}, n); }
inline Sample<3> face_centred(int n) {
  return crystal<3>(std::sqrt(2.0) * lattice_diameter * Mat<3>::Identity(),
                    {Vec<3>::Zero(), Vec<3>(0.5, 0.5, 0), Vec<3>(0.5, 0, 0.5), Vec<3>(0, 0.5, 0.5)}, n);
}

}  // namespace galet::test
