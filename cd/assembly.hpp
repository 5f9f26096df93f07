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

/// The body of the contact problem that member `index` of a pair belongs to: itself, or its rigid body.
template <Layout Y>
int body_of(const Bodies<Y>& bodies, int index) {
  if (index >= bodies.grains() || bodies.rigid.free(index)) return index;
  return bodies.grains() + static_cast<int>(bodies.planes.size()) + bodies.rigid.of[index];
}

/// Velocity of a grain's centre, or of a plane.
template <Layout Y>
Vec<Y.dim> velocity_of(const Bodies<Y>& bodies, const Iterate<Y>& iterate, int index) {
  const int body = body_of(bodies, index);
  if constexpr (Y.friction)
    if (body != index)
      return iterate.velocity[body] + cross(iterate.spin[body], bodies.arm[index]) -
             iterate.gradient * bodies.arm[index];
  return iterate.velocity[body];
}

/// Whether member `index` of a pair is part of a rigid body that turns.
template <Layout Y>
bool on_turning_body(const Bodies<Y>& bodies, int index) {
  return index < bodies.grains() && !bodies.rigid.free(index) && bodies.rigid.body[bodies.rigid.of[index]].turns;
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
  void activate(const VerletList<D>& list, const Column<Vec<D>>& free_velocity, double dt, double margin) {
    const PairColumns<D>& pairs = list.pairs();
    for (std::size_t row = 0; row < list.size(); ++row) {
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
      if (active_[row]) continue;
      const ContactFrame<D>& frame = frames_[row];
      Vec<D> u = velocity_of(bodies, iterate, pairs.j[row]) - velocity_of(bodies, iterate, pairs.i[row]);
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
    make_room(list.size(), bodies.rigid.any_turning, problem);
    order_contacts(bodies, list, problem);
    for (std::size_t k = 0; k < row_of_.size(); ++k) {
      const int row = row_of_[k];
      const ContactFrame<D>& frame = frames_[row];
      problem.i[k] = body_of(bodies, pairs.i[row]);
      problem.j[k] = body_of(bodies, pairs.j[row]);
      problem.normal[k] = frame.normal;
      problem.distance[k] = frame.distance;
      const int law = law_index(bodies, pairs, row, laws.materials);
      problem.offset[k] = impact_offset(frame.gap, opening_[row], laws.pairs[law].restitution, rule.dt, rule.theta);
      if (problem.turns(k))
        fill_turning_block(bodies, frame, {pairs.i[row], pairs.j[row]}, k, problem);
      else
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
    if (problem.mobile(body) && !problem.mobility[body - problem.grains].isZero(0)) return body;
    return problem.spun(body) && !is_zero(problem.turning[body - problem.grains]) ? body : INT_MAX;
  }

  /// Rows of the contacts by colour, those of bodies that turn after the others; sizes and groups of the problem.
  void order_contacts(const Bodies<Y>& bodies, const VerletList<D>& list, Problem<Y>& problem) {
    row_of_.clear();
    problem.group.assign(1, 0);
    problem.shared = {-1, -1};
    colour(bodies, list, false, problem);
    problem.first_turning = row_of_.size();
    if (bodies.rigid.any_turning) colour(bodies, list, true, problem);
    problem.resize(row_of_.size());
    if constexpr (Y.friction) problem.bent.resize(row_of_.size() - problem.first_turning);
  }

  void colour(const Bodies<Y>& bodies, const VerletList<D>& list, bool turning, Problem<Y>& problem) {
    const PairColumns<D>& pairs = list.pairs();
    rows_.clear(), body_i_.clear(), body_j_.clear();
    for (std::size_t row = 0; row < list.size(); ++row) {
      if (!active_[row]) continue;
      if (bodies.rigid.any_turning &&
          turning != (on_turning_body(bodies, pairs.i[row]) || on_turning_body(bodies, pairs.j[row])))
        continue;
      rows_.push_back(static_cast<int>(row));
      body_i_.push_back(colouring_index(problem, body_of(bodies, pairs.i[row])));
      body_j_.push_back(colouring_index(problem, body_of(bodies, pairs.j[row])));
    }
    const auto movable = bodies.grains() + static_cast<int>(std::max(problem.mobility.size(), problem.turning.size()));
    colouring_.colour(body_i_, body_j_, movable, rows_.capacity());
    const int before = static_cast<int>(row_of_.size());
    for (const int k : colouring_.order) row_of_.push_back(rows_[k]);
    for (int c = 0; c < colouring_.colours(); ++c) problem.group.push_back(before + colouring_.start[c + 1]);
    if (colouring_.overflow) problem.shared[turning ? 1 : 0] = static_cast<int>(problem.group.size()) - 2;
  }

  /// Memory for all listed pairs and some more: the number of active ones wanders from step to step.
  void make_room(std::size_t listed, bool rigid_contacts, Problem<Y>& problem) {
    if (rows_.capacity() >= listed) return;
    const std::size_t room = listed + listed / 2;
    rows_.reserve(room), body_i_.reserve(room), body_j_.reserve(room), row_of_.reserve(room);
    problem.reserve(room);
    if (rigid_contacts) problem.bent.reserve(room);
    problem.group.reserve(2 * Colouring::most_colours + 3);
  }

  /// Whether no grain stands twice in a colour (the sequential tail excepted): what threads rely on.
  bool no_grain_twice(const Problem<Y>& problem, int grains) {
    colour_of_.assign(grains, -1);
    const int groups = static_cast<int>(problem.group.size()) - 1;
    for (int colour = 0; colour < groups; ++colour)
      if (colour != problem.shared[0] && colour != problem.shared[1])
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
      problem.arm_j[k] = grain_j ? frame.stretch * bodies.radius[grains[1]] : surface_arm(bodies, grains[1]);
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

  /// l_j of a boundary, which tells the velocity of its surface from its spin.
  static double surface_arm(const Bodies<Y>& bodies, int member) {
    const Plane<D>& boundary = bodies.planes[member - bodies.grains()];
    return boundary.curved() ? boundary.lever() : 0;
  }

  /// The same for a contact of a body that turns: its levers, and the whole block.
  static void fill_turning_block(const Bodies<Y>& bodies, const ContactFrame<D>& frame,
                                 const std::array<int, 2>& grains, std::size_t k, Problem<Y>& problem) {
    if constexpr (Y.friction) {
      TurningContact<Y>& bent = problem.bent[k - problem.first_turning];
      bent = {};
      bent.branch = frame.branch + bodies.arm[grains[0]];
      if (grains[1] < bodies.grains()) bent.branch -= bodies.arm[grains[1]];
      bent.lever_i = lever_of(bodies, frame, grains[0], 1);
      bent.lever_j = lever_of(bodies, frame, grains[1], -1);
      Mat<D> directions;
      directions.col(0) = frame.normal;
      directions.template rightCols<D - 1>() = across<D>(frame.normal);
      const BlockSide own = block_side(directions, bent.lever_i), other = block_side(directions, bent.lever_j);
      const int i = problem.i[k], j = problem.j[k];
      if (i == j)  // a body that meets its own image
        add_side({other.force - own.force, other.torque - own.torque}, i, problem, bent.w);
      else
        add_side(own, i, problem, bent.w), add_side(other, j, problem, bent.w);
      for (const HubMode<D>& mode : problem.hub) {
        const Vec<D> answer = directions.transpose() * (mode.direction * bent.branch);
        bent.w.template topLeftCorner<D, D>() += mode.inverse_inertia * answer * answer.transpose();
      }
      const double w_n = bent.w(0, 0), w_t = bent.w.diagonal().template segment<D - 1>(1).mean();
      // A normal through a fixed axis: what is left is rounding of the lever.
      const bool held = !(w_n > 1e-14 * w_t);
      problem.wn[k] = held ? 0 : w_n;
      problem.inverse_wn[k] = held ? 0 : 1 / w_n;
      problem.inverse_wt[k] = 1 / w_t;
      problem.arm_i[k] = problem.arm_j[k] = 0;
      if constexpr (Y.rolling) {
        problem.wr[k] = bent.w.diagonal().template segment<D - 1>(D).mean();
        problem.wp[k] = D == 3 ? bent.w(block_size(Y) - 1, block_size(Y) - 1) : problem.wr[k];
        problem.coupling[k] = 0;
      }
    }
  }

  /// From the centre of the body to the contact point; `side` 1: the normal leaves that member, -1: it points there.
  static Vec<D> lever_of(const Bodies<Y>& bodies, const ContactFrame<D>& frame, int member, double side) {
    if (member >= bodies.grains()) return -surface_arm(bodies, member) * frame.normal;
    return bodies.arm[member] + side * frame.stretch * bodies.radius[member] * frame.normal;
  }

  /// What unit impulses of a contact give to one of its bodies, column by column of the block: a force through the
  /// centre and a torque.
  struct BlockSide {
    static constexpr int spins = D == 2 ? 1 : 3;
    Eigen::Matrix<double, D, block_size(Y)> force = Eigen::Matrix<double, D, block_size(Y)>::Zero();
    Eigen::Matrix<double, spins, block_size(Y)> torque = Eigen::Matrix<double, spins, block_size(Y)>::Zero();
  };
  static BlockSide block_side(const Mat<D>& directions, const Vec<D>& lever) {
    BlockSide side;
    side.force.template leftCols<D>() = directions;
    for (int a = 0; a < D; ++a) {
      const Spin<D> moment = cross(lever, Vec<D>(directions.col(a)));
      if constexpr (D == 2)
        side.torque(0, a) = moment;
      else
        side.torque.col(a) = moment;
    }
    if constexpr (Y.rolling && D == 2) side.torque(0, 2) = 1;
    if constexpr (Y.rolling && D == 3) {
      side.torque.template middleCols<2>(3) = directions.template rightCols<2>();
      side.torque.col(5) = directions.col(0);
    }
    return side;
  }
  static void add_side(const BlockSide& side, int body, const Problem<Y>& problem,
                       typename TurningContact<Y>::Block& w) {
    if (body < problem.grains) {
      w += problem.inverse_mass[body] * side.force.transpose() * side.force;
      w += problem.inverse_inertia[body] * side.torque.transpose() * side.torque;
      return;
    }
    if (problem.mobile(body)) w += side.force.transpose() * problem.mobility[body - problem.grains] * side.force;
    if (problem.spun(body)) w += side.torque.transpose() * (problem.turning[body - problem.grains] * side.torque);
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
