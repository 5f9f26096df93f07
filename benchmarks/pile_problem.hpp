// Contact problems of single steps of sphere packings under gravity, for benchmarks of the contact solver, and the two
// errors that FCLIB solvers are compared by.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <string>
#include <vector>

#include "cd/problem.hpp"
#include "cd/residual.hpp"
#include "common/core/error.hpp"
#include "common/core/random.hpp"
#include "common/graph/colouring.hpp"
#include "common/neighbour/verlet_list.hpp"
#include "common/scene/sample.hpp"

namespace galet::bench {

struct Pile {
  static constexpr Layout Y{3, true};
  cd::Problem<Y> problem;
  cd::Iterate<Y> free;  ///< velocities without reactions
};

/// A contact before it is coloured; j < 0: with something that doesn't move.
struct PileContact {
  int i, j;
  Vec<3> normal;
  double arm_i, arm_j, offset;
};

/// Adds contacts, grouped by colour, to a pile whose grains and free velocities are set. Everything that rests is one
/// body more.
inline void set_contacts(const std::vector<PileContact>& contacts, double friction, Pile& pile) {
  auto& problem = pile.problem;
  const int fixed = problem.grains;
  problem.inverse_mass.push_back(0), problem.inverse_inertia.push_back(0);
  pile.free.velocity.push_back(Vec<3>::Zero()), pile.free.spin.push_back(Vec<3>::Zero());
  problem.laws = {{friction, 0, 0}};
  std::vector<int> i, j;
  for (const PileContact& contact : contacts) i.push_back(contact.i), j.push_back(contact.j < 0 ? fixed : contact.j);
  Colouring colouring;
  colouring.colour(i, j, fixed);
  require(!colouring.overflow, "a grain of the pile has too many contacts");
  problem.resize(contacts.size());
  problem.group = colouring.start;
  pile.free.reaction.assign(contacts.size(), cd::Reaction<Pile::Y>::Zero());
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    const PileContact& contact = contacts[colouring.order[k]];
    problem.i[k] = i[colouring.order[k]], problem.j[k] = j[colouring.order[k]];
    problem.normal[k] = contact.normal;
    problem.arm_i[k] = contact.arm_i, problem.arm_j[k] = contact.arm_j;
    problem.distance[k] = contact.arm_i + contact.arm_j;
    problem.offset[k] = contact.offset;
    const double w = problem.wn[k] = problem.inverse_mass[problem.i[k]] + problem.inverse_mass[problem.j[k]];
    problem.inverse_wn[k] = 1 / w;
    problem.inverse_wt[k] = 1 / (w + contact.arm_i * contact.arm_i * problem.inverse_inertia[problem.i[k]] +
                                 contact.arm_j * contact.arm_j * problem.inverse_inertia[problem.j[k]]);
  }
}

/// One step of the grains of a cell of rigid spheres at rest under gravity along -z, from a packing that is repeated
/// to fill it: a cube of `side` (in units of the mean diameter), in which grains within one diameter of the sides and
/// of the bottom are held. Contacts are the pairs that overlap in the packing. `gravity_dt`: g dt.
inline Pile pile_of_packing(const Sample<3>& packing, double side, double friction, double gravity_dt) {
  const Vec<3> box = packing.cell.box.diagonal();
  const double d = 2 * packing.radius[0];
  std::vector<Vec<3>> position;
  std::vector<double> radius, mass;
  const Vec<3> copies = (side * d * box.cwiseInverse()).array().ceil();
  for (int a = 0; a < copies[0]; ++a)
    for (int b = 0; b < copies[1]; ++b)
      for (int c = 0; c < copies[2]; ++c)
        for (int k = 0; k < packing.count(); ++k) {
          const Vec<3> x = packing.position[k] + Vec<3>(a, b, c).cwiseProduct(box);
          if (x.maxCoeff() > side * d || x.minCoeff() < 0) continue;
          position.push_back(x), radius.push_back(packing.radius[k]), mass.push_back(packing.mass[k]);
        }
  Cell<3> cell = packing.cell;
  cell.box = Mat<3>(Vec<3>::Constant((side + 2) * d).asDiagonal());
  cell.periodic = {false, false, false};
  cell.rate.setZero();
  VerletList<3> list;
  list.configure(0, 0.01 * d);
  list.build(position, radius, cell, {});
  const auto held = [&](const Vec<3>& x) {
    return x.z() < d || std::min(x.x(), x.y()) < d || std::max(x.x(), x.y()) > (side - 1) * d;
  };
  Pile pile;
  std::vector<int> body(position.size(), -1);
  for (std::size_t k = 0; k < position.size(); ++k) {
    if (held(position[k])) continue;
    body[k] = pile.problem.grains++;
    pile.problem.inverse_mass.push_back(1 / mass[k]);
    pile.problem.inverse_inertia.push_back(1 / (inertia_ratio<3> * mass[k] * radius[k] * radius[k]));
    pile.free.velocity.push_back(Vec<3>(0, 0, -gravity_dt)), pile.free.spin.push_back(Vec<3>::Zero());
  }
  std::vector<PileContact> contacts;
  for (std::size_t row = 0; row < list.size(); ++row) {
    int i = list.pairs().i[row], j = list.pairs().j[row];
    if (body[i] < 0) std::swap(i, j);
    const Vec<3> branch = position[j] - position[i];
    if (body[i] < 0 || branch.norm() > radius[i] + radius[j]) continue;
    contacts.push_back({body[i], body[j], branch.normalized(), radius[i], radius[j], 0});
  }
  set_contacts(contacts, friction, pile);
  return pile;
}

/// The geometry of pile3d (native bytes): i4 N, nc; f8 m[N], I[N], R[N], v_free[N][6]; i4 pairs[nc][2] (second below
/// zero: a wall); f8 frames[nc][9] (n from j to i, two tangents); f8 gap_over_dt[nc].
inline Pile pile_of_file(const std::string& path, double friction) {
  std::ifstream file(path, std::ios::binary);
  const auto take = [&](auto& values) {
    file.read(reinterpret_cast<char*>(values.data()), static_cast<std::streamsize>(values.size() * sizeof(values[0])));
    if (!file) throw InputError(path + ": cannot be read, or is cut short");
  };
  std::vector<std::int32_t> counts(2);
  take(counts);
  const std::size_t grains = counts[0], count = counts[1];
  std::vector<double> mass(grains), inertia(grains), radius(grains), motion(6 * grains), frame(9 * count), gap(count);
  std::vector<std::int32_t> pair(2 * count);
  take(mass), take(inertia), take(radius), take(motion), take(pair), take(frame), take(gap);
  Pile pile;
  pile.problem.grains = static_cast<int>(grains);
  for (std::size_t b = 0; b < grains; ++b) {
    pile.problem.inverse_mass.push_back(1 / mass[b]), pile.problem.inverse_inertia.push_back(1 / inertia[b]);
    pile.free.velocity.push_back(Vec<3>::Map(&motion[6 * b])),
        pile.free.spin.push_back(Vec<3>::Map(&motion[6 * b + 3]));
  }
  std::vector<PileContact> contacts;
  for (std::size_t k = 0; k < count; ++k) {
    const int i = pair[2 * k], j = pair[2 * k + 1];
    contacts.push_back({i, j, -Vec<3>::Map(&frame[9 * k]), radius[i], j < 0 ? 0 : radius[j], gap[k]});
  }
  set_contacts(contacts, friction, pile);
  return pile;
}

/// errS and errP of cd/discrete/error.hpp, without a matrix: blocks of spheres are diagonal, so that no tangents are
/// needed.
struct PileErrors {
  double scaled, siconos;
};
inline PileErrors pile_errors(const Pile& pile, const cd::Iterate<Pile::Y>& at) {
  const auto& problem = pile.problem;
  double map[2] = {0, 0}, r_square[2] = {0, 0}, u_square[2] = {0, 0}, q_square[2] = {0, 0};
  for (std::size_t k = 0; k < problem.size(); ++k) {
    const auto r = cd::components<Pile::Y>(problem.normal[k], at.reaction[k]);
    const auto u = cd::law_motion(problem, at, at.gradient, k, r);
    const auto q = cd::law_motion(problem, pile.free, pile.free.gradient, k, cd::Components<Pile::Y>{});
    const double mu = problem.laws[0].friction;
    const auto square = [](const cd::Components<Pile::Y>& x) {
      return x.normal * x.normal + x.tangential.squaredNorm();
    };
    for (const int given : {0, 1}) {
      const double w = given ? 1 : (problem.wn[k] + 2 / problem.inverse_wt[k]) / 3;
      const double z = r.normal - (u.normal + mu * u.tangential.norm()) / w;
      const Vec<3> trial = r.tangential - u.tangential / w;
      const double norm = trial.norm(), s = cd::projected_normal<1>(z, {norm}, {mu});
      const double miss =
          (r.normal - s) * (r.normal - s) + (r.tangential - cd::kept(norm, mu * s) * trial).squaredNorm();
      map[given] += w * miss, r_square[given] += w * square(r);
      u_square[given] += square(u) / w, q_square[given] += square(q) / w;
    }
  }
  const auto error = [&](int k) { return std::sqrt(map[k] / std::max({r_square[k], u_square[k], q_square[k]})); };
  return {error(0), error(1)};
}

/// Where to start: no impulses, but for normal ones of `size` times a random number in [0, 1] (0: none at all).
inline cd::Iterate<Pile::Y> perturbed_start(const Pile& pile, double size, std::uint64_t seed) {
  cd::Iterate<Pile::Y> start = pile.free;
  RandomStream stream(seed, 1);
  Mat<3> virial = Mat<3>::Zero();
  for (std::size_t k = 0; k < pile.problem.size(); ++k) {
    start.reaction[k] = size * stream.uniform(0, 1) * pile.problem.normal[k];
    cd::add_reaction(pile.problem, start, k, start.reaction[k], virial);
  }
  return start;
}

}  // namespace galet::bench
