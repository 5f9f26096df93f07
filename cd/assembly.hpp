// From pairs to a contact problem: which pairs take part in a step, and the problem's columns in coloured order.
#pragma once

#include <array>
#include <climits>
#include <cstdint>

#include "cd/laws/restitution.hpp"
#include "cd/problem.hpp"
#include "common/core/error.hpp"
#include "common/core/parallel.hpp"
#include "common/engine/bodies.hpp"
#include "common/geometry/contact_frame.hpp"
#include "common/graph/colouring.hpp"
#include "common/neighbour/verlet_list.hpp"
#include "common/scene/pair_law.hpp"

namespace galet::cd {

template <Layout Y>
ContactFrame<Y.dim> frame_of(const Bodies<Y>& bodies, const PairColumns<Y.dim>& pairs, std::size_t row) {
  constexpr int D = Y.dim;
  const int i = pairs.i[row], j = pairs.j[row];
  if (j >= bodies.grains())
    return plane_frame<D>(bodies.position[i], bodies.radius[i], bodies.planes[j - bodies.grains()]);
  const Vec<D> branch = bodies.position[j] - bodies.position[i] + lattice<D>(bodies.cell.box, pairs.image[row]);
  return grain_frame<D>(branch, branch.squaredNorm(), bodies.radius[i], bodies.radius[j]);
}

/// Index of a listed pair's law in a table of that many materials.
template <Layout Y>
int law_index(const Bodies<Y>& bodies, const PairColumns<Y.dim>& pairs, std::size_t row, int materials) {
  const int i = pairs.i[row], j = pairs.j[row];
  const int other = j >= bodies.grains() ? bodies.plane_material[j - bodies.grains()] : bodies.material[j];
  return bodies.material[i] * materials + other;
}

/// The body of the contact problem that member `index` of a pair belongs to: itself, or its wall.
template <Layout Y>
int body_of(const Bodies<Y>& bodies, int index) {
  if (bodies.wall_of.empty() || index >= bodies.grains() || bodies.wall_of[index] < 0) return index;
  return bodies.grains() + static_cast<int>(bodies.planes.size()) + bodies.wall_of[index];
}

/// Whether nothing can change a pair's distance: grains of one wall, of two that forces don't move.
template <Layout Y>
bool held_apart(const Bodies<Y>& bodies, int i, int j) {
  if (bodies.wall_of.empty()) return false;
  return i != j && body_of(bodies, i) == body_of(bodies, j);
}

/// How a step goes forward in time: velocities count theta at its end and 1 - theta at its start.
struct StepRule {
  double dt;
  double theta = 1;
};

template <Layout Y>
class Assembly {
 public:
  static constexpr int D = Y.dim;

  /// Frames of all listed pairs at the bodies' positions, and their normal velocities at the start of the step.
  void measure(const Bodies<Y>& bodies, const VerletList<D>& list) {
    frames_.resize(list.size());
    opening_.resize(list.size());
    refill(active_, list.size(), std::uint8_t{0});
    const PairColumns<D>& pairs = list.pairs();
    parallel_ranges(list.size(), [&](std::size_t begin, std::size_t end) {
      for (std::size_t row = begin; row < end; ++row) {
        frames_[row] = frame_of(bodies, pairs, row);
        opening_[row] = frames_[row].normal.dot(centre_velocity(bodies, pairs, row, bodies.velocity));
      }
    });
  }

  /// Marks the pairs that could close within the step: gap below `margin` plus twice what the free velocities cover.
  void activate(const Bodies<Y>& bodies, const VerletList<D>& list, const Column<Vec<D>>& free_velocity, double dt,
                double margin) {
    const PairColumns<D>& pairs = list.pairs();
    for (std::size_t row = 0; row < list.size(); ++row) {
      if (held_apart(bodies, pairs.i[row], pairs.j[row])) continue;
      const double approach = free_velocity[pairs.i[row]].norm() + free_velocity[pairs.j[row]].norm();
      if (frames_[row].gap <= margin + 2 * dt * (approach + std::abs(opening_[row]))) active_[row] = 1;
    }
  }

  /// Marks the pairs that are not in the problem and would overlap by the end of the step; returns how many.
  int activate_missed(const Bodies<Y>& bodies, const VerletList<D>& list, const Iterate<Y>& iterate,
                      const StepRule& rule) {
    int missed = 0;
    const PairColumns<D>& pairs = list.pairs();
    for (std::size_t row = 0; row < list.size(); ++row) {
      if (active_[row] || held_apart(bodies, pairs.i[row], pairs.j[row])) continue;
      const ContactFrame<D>& frame = frames_[row];
      Vec<D> u = iterate.velocity[body_of(bodies, pairs.j[row])] - iterate.velocity[body_of(bodies, pairs.i[row])];
      if (pairs.j[row] < bodies.grains()) u += iterate.gradient * frame.branch;
      const double opening = rule.theta * frame.normal.dot(u) + (1 - rule.theta) * opening_[row];
      if (frame.gap + rule.dt * opening < 0) active_[row] = 1, ++missed;
    }
    return missed;
  }

  /// Fills the contact columns from the active rows, grouped by colour. `row_of` tells each contact's row.
  /// `start`: velocities at the start of the step (asked for only if tangential motions rebound).
  void fill(const Bodies<Y>& bodies, const VerletList<D>& list, const LawTable& laws, const StepRule& rule,
            const Iterate<Y>& start, Problem<Y>& problem) {
    const PairColumns<D>& pairs = list.pairs();
    make_room(list.size(), problem);
    rows_.clear(), body_i_.clear(), body_j_.clear();
    for (std::size_t row = 0; row < list.size(); ++row) {
      if (!active_[row]) continue;
      rows_.push_back(static_cast<int>(row));
      body_i_.push_back(colouring_index(problem, body_of(bodies, pairs.i[row])));
      body_j_.push_back(colouring_index(problem, body_of(bodies, pairs.j[row])));
    }
    colouring_.colour(body_i_, body_j_, bodies.grains() + static_cast<int>(problem.mobility.size()), rows_.capacity());
    problem.resize(rows_.size());
    problem.group = colouring_.start;
    problem.sequential_tail = colouring_.overflow;
    row_of_.resize(rows_.size());
    for (std::size_t k = 0; k < rows_.size(); ++k) {
      const int row = rows_[colouring_.order[k]];
      row_of_[k] = row;
      const ContactFrame<D>& frame = frames_[row];
      problem.i[k] = body_of(bodies, pairs.i[row]);
      problem.j[k] = body_of(bodies, pairs.j[row]);
      problem.normal[k] = frame.normal;
      problem.distance[k] = frame.distance;
      const int law = law_index(bodies, pairs, row, laws.materials);
      problem.offset[k] = impact_offset(frame.gap, opening_[row], laws.pairs[law].restitution, rule.dt, rule.theta);
      fill_block(bodies, frame, {pairs.i[row], pairs.j[row]}, k, problem);
      if constexpr (Y.friction) {
        problem.law[k] = static_cast<std::uint8_t>(law);
        if (problem.lagged) fill_lag(laws.pairs[law].tangential_restitution, start, k, problem);
      }
    }
    GALET_ENSURE(no_grain_twice(problem, bodies.grains()), "the contacts of a colour share no grain");
  }

  const std::vector<int>& row_of() const { return row_of_; }
  const ContactFrame<D>& frame(std::size_t row) const { return frames_[row]; }
  std::size_t size() const { return frames_.size(); }

 private:
  /// Bodies that forces move share their contacts; the others don't count.
  static int colouring_index(const Problem<Y>& problem, int body) {
    if (body < problem.grains) return body;
    return problem.mobile(body) && !problem.mobility[body - problem.grains].isZero(0) ? body : INT_MAX;
  }

  /// Memory for all listed pairs and some more: the number of active ones wanders from step to step.
  void make_room(std::size_t listed, Problem<Y>& problem) {
    if (rows_.capacity() >= listed) return;
    const std::size_t room = listed + listed / 2;
    rows_.reserve(room), body_i_.reserve(room), body_j_.reserve(room), row_of_.reserve(room);
    problem.reserve(room);
    problem.group.reserve(Colouring::most_colours + 2);
  }

  /// Whether no grain stands twice in a colour (the sequential tail excepted): what threads rely on.
  bool no_grain_twice(const Problem<Y>& problem, int grains) {
    colour_of_.assign(grains, -1);
    const int colours = static_cast<int>(problem.group.size()) - 1 - (problem.sequential_tail ? 1 : 0);
    for (int colour = 0; colour < colours; ++colour)
      for (int k = problem.group[colour]; k < problem.group[colour + 1]; ++k)
        for (const int grain : {problem.i[k], problem.j[k] == problem.i[k] ? grains : problem.j[k]}) {
          if (grain >= grains) continue;
          if (colour_of_[grain] == colour) return false;
          colour_of_[grain] = colour;
        }
    return true;
  }

  /// Relative velocity of the centres of a pair (of grain and plane), without spins.
  static Vec<D> centre_velocity(const Bodies<Y>& bodies, const PairColumns<D>& pairs, std::size_t row,
                                const Column<Vec<D>>& velocity) {
    const int i = pairs.i[row], j = pairs.j[row];
    if (j >= bodies.grains()) return bodies.planes[j - bodies.grains()].velocity - velocity[i];
    const Vec<D> branch = bodies.position[j] - bodies.position[i] + lattice<D>(bodies.cell.box, pairs.image[row]);
    return velocity[j] - velocity[i] + bodies.cell.rate * branch;
  }

  /// Diagonal of the contact's block of W. The hub's share is bounded by that of its strongest direction, which keeps
  /// the block a multiple of the identity in the tangent plane; the solution does not depend on it.
  /// `grains`: members of the pair, whose radii give the lever arms.
  static void fill_block(const Bodies<Y>& bodies, const ContactFrame<D>& frame, const std::array<int, 2>& grains,
                         std::size_t k, Problem<Y>& problem) {
    const int i = problem.i[k], j = problem.j[k];
    double hub = 0;
    for (const HubMode<D>& mode : problem.hub)
      hub += mode.inverse_inertia * (mode.direction * frame.branch).squaredNorm();
    // A grain that meets its own image moves with it: only the cell can part them.
    const double masses = i == j ? 0 : problem.inverse_mass[i] + problem.inverse_mass[j];
    const Vec<D>& n = frame.normal;
    double w_n = masses + hub, w_t = w_n;
    for (const int body : {i, j}) {
      if (!problem.mobile(body)) continue;
      const Mat<D>& mobility = problem.mobility[body - problem.grains];
      w_n += n.dot(mobility * n);
      w_t += (mobility - (mobility * n) * n.transpose()).norm();  // bounds the tangential part
    }
    problem.wn[k] = w_n;
    problem.inverse_wn[k] = w_n > 0 ? 1 / w_n : 0;
    if constexpr (Y.friction) {
      const bool grain_j = grains[1] < bodies.grains();
      problem.arm_i[k] = frame.stretch * bodies.radius[grains[0]];
      problem.arm_j[k] = grain_j ? frame.stretch * bodies.radius[grains[1]] : 0;
      const double arm_i = problem.arm_i[k], arm_j = problem.arm_j[k];
      const double turning =
          i == j ? (arm_i + arm_j) * (arm_i + arm_j) * problem.inverse_inertia[i]
                 : arm_i * arm_i * problem.inverse_inertia[i] + arm_j * arm_j * problem.inverse_inertia[j];
      problem.inverse_wt[k] = 1 / (w_t + turning);
      if constexpr (Y.rolling) {
        const double inverse_i = problem.inverse_inertia[i], inverse_j = problem.inverse_inertia[j];
        problem.wr[k] = problem.wp[k] = i == j ? 0 : inverse_i + inverse_j;
        problem.coupling[k] = i == j ? 0 : arm_i * inverse_i - arm_j * inverse_j;
      }
    }
  }

  /// Tangential motions rebound: lag = e_T times the motion at the start of the step.
  static void fill_lag(double restitution, const Iterate<Y>& start, std::size_t k, Problem<Y>& problem) {
    Components<Y> motion = relative_motion(problem, start, start.gradient, k);
    motion.normal = 0, motion.tangential *= restitution, motion.rolling *= restitution, motion.pivoting *= restitution;
    problem.lag[k] = composed<Y>(problem.normal[k], motion);
  }

  std::vector<ContactFrame<D>> frames_;
  std::vector<double> opening_;
  std::vector<std::uint8_t> active_;
  std::vector<int> rows_, body_i_, body_j_, row_of_;
  Colouring colouring_;
  std::vector<int> colour_of_;  ///< scratch of the invariant check
};

}  // namespace galet::cd
