// The discrete frictional contact problem as numbers alone: what codes exchange in FCLIB files.
//
//   find r with   u = W r + q   and at each contact c, with block (N, T[, R]) of B numbers, normal first,
//   0 <= u_N  perp  r_N >= 0,
//   norm(r_T) <= mu r_N,    r_T opposite to u_T when sliding,
//   norm(r_R) <= mu_R r_N,  r_R opposite to u_R when rolling (B = 5 only).
//
// B = 2: disks and plane bodies, B = 3: bodies in space, B = 5: with rolling (R: two tangential components).
// W: Delassus operator, positive semidefinite (a slight asymmetry, as of files with gyroscopic terms, is kept).
// Units: any consistent ones; u a velocity and r an impulse, or displacement and force.
// Source: Acary, Bremond and Huber 2018 (FCLIB); rolling: Acary and Bourrier 2021.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace galet::cd {

struct DiscreteProblem {
  int block = 3;  ///< B
  /// W by compressed rows: entries start[a] .. start[a + 1] of row a; columns ascending, each once.
  std::vector<std::int64_t> start;
  std::vector<int> column;
  std::vector<double> value;
  std::vector<double> q;     ///< B per contact
  std::vector<double> mu;    ///< one per contact
  std::vector<double> mu_r;  ///< one per contact where B = 5 (a length), else empty
  std::string title, description;

  int contacts() const { return static_cast<int>(mu.size()); }
  int rows() const { return block * contacts(); }
};

/// What is wrong with a problem (sizes, order of columns, values that aren't finite, mu < 0, a negative diagonal);
/// empty when sound.
std::vector<std::string> mistakes_of(const DiscreteProblem& problem);

}  // namespace galet::cd
