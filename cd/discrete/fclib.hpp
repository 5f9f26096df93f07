// FCLIB files (HDF5): discrete contact problems as codes exchange them.
//
//   fclib_local   W, vectors q, mu [, mur]        u = W r + q
//   fclib_global  M, H, vectors f, w, mu [, mur]  M v = H r + f,  u = H^T v + w
//                 read as W = H^T M^-1 H, q = H^T M^-1 f + w (sparse factorisation of M)
//   spacedim: numbers per contact, 2, 3 or 5 (two of them rolling, bounded by mur); normal component first
//   info: title, description, math_info (all optional)
//   solution: u, r; of a global problem v too
//   galet: gap_time, diameter (ours, of steps of a scene; both or none): what a motion does to a gap, and d
//
// A matrix has m rows, n columns and nzmax places; nz >= 0: that many triplets (row i, column p, value x, equal places
// are summed); nz = -1: compressed columns; nz = -2: compressed rows (p: where each begins, i: indices, x: values).
// Global problems with rolling are the group fclib_global_rolling, whose bound of rolling is called mu_r; either name
// is read in either place. Equality constraints (G of a global problem, V and R of a
// local one) are refused: a DiscreteProblem has contacts only.
// Source: Acary, Bremond and Huber 2018 (FCLIB).
#pragma once

#include <optional>
#include <string>

#include "cd/discrete/global_problem.hpp"
#include "cd/discrete/problem.hpp"

namespace galet::cd {

/// What the motions of a problem mean for gaps.
struct FclibScale {
  double gap_time = 0;  ///< a gap changes by this times u_N
  double diameter = 0;  ///< d
};

/// A problem and, where the file has one, its solution (else empty).
struct FclibContent {
  DiscreteProblem problem;
  std::vector<double> u, r;
  std::optional<FclibScale> scale = {};
  std::optional<GlobalProblem> global = {};  ///< as read, where the file is in global form; never written
};

/// Throws InputError with the file, the dataset and what was expected of it. What it returns has no mistakes_of.
/// Cost: local O(entries); global that of the factorisation of M and of a solution for each column of H.
FclibContent read_fclib(const std::string& path);

/// Writes a local problem, W by compressed columns, and u and r as its solution unless they are empty. Reading it
/// gives the same bits.
void write_fclib(const std::string& path, const FclibContent& content);

/// A problem in global form and, where the file has one, its solution (else empty).
struct FclibGlobalContent {
  GlobalProblem problem;
  std::vector<double> v, u, r;
  std::optional<FclibScale> scale = {};
};

/// As it stands in the file, not reduced. Throws InputError as read_fclib does, and for files in local form.
FclibGlobalContent read_fclib_global(const std::string& path);

/// Writes a global problem, M and H by compressed columns, in the group for its block. Reading it gives the same bits.
/// Throws std::invalid_argument where sizes don't agree.
void write_fclib(const std::string& path, const FclibGlobalContent& content);

}  // namespace galet::cd
