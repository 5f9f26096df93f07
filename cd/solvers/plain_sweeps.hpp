// Sweeps of Gauss-Seidel over rigid contacts of grains that roll freely, in records and groups of four contacts
// (cd/kernel/view.hpp) that are filled when a solve begins and read back when it ends.
//
// A sweep starts from r + beta (r - r before) without a pass of its own over the impulses: contacts extrapolate when
// they are visited, bodies and hub (whose velocities are affine in the impulses) at the start of the sweep.
// Bits depend neither on the number of threads nor on the width of the lanes: contacts are visited in chunks of fixed
// size, sums are kept lane by lane and added chunk by chunk.
// Cost: loading about two sweeps, the residual about one; no allocation once the arrays have grown.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "cd/kernel/dispatch.hpp"
#include "cd/problem.hpp"
#include "cd/residual.hpp"
#include "common/core/parallel.hpp"
#include "common/graph/colouring.hpp"

namespace galet::cd {

/// Doubles in cache lines.
class LineVector {
 public:
  void reserve(std::size_t doubles) { lines_.reserve((doubles + 7) / 8); }
  void resize(std::size_t doubles) { lines_.resize((doubles + 7) / 8); }
  std::size_t size() const { return 8 * lines_.size(); }
  double* data() { return lines_.empty() ? nullptr : lines_[0].value; }
  const double* data() const { return lines_.empty() ? nullptr : lines_[0].value; }
  void copy(const LineVector& other) { lines_.assign(other.lines_.begin(), other.lines_.end()); }

 private:
  struct alignas(64) Line {
    double value[8];
  };
  std::vector<Line> lines_;
};

template <Layout Y>
class PlainSweeps {
 public:
  static constexpr int D = Y.dim;
  static constexpr int R = reaction_size(Y), record = record_size(Y);
  using C = SweepColumns<Y>;

  /// Takes over the problem and where to start; false (and nothing done) where it holds what kernels don't know.
  /// `hub_block`: contacts between two answers of the hub.
  bool load(const Problem<Y>& problem, const Iterate<Y>& iterate, std::size_t hub_block) {
    if (problem.compliant || problem.lagged || !problem.mobility.empty()) return false;
    if (!problem.hub.empty() && hub_block < group_lanes) return false;
    if (problem.first_turning < problem.size()) return false;
    for (std::size_t k = 0; k < problem.size(); ++k)
      if (problem.i[k] == problem.j[k]) return false;  // a grain and its own image
    problem_ = &problem;
    cell_ = !problem.hub.empty() || !iterate.gradient.isZero(0);
    functions_ = sweep_functions<Y>(instructions(), cell_);
    lay_out(problem, hub_block);
    load_bodies(problem, iterate);
    load_contacts(problem, iterate);
    hub_rate_.assign(iterate.hub_rate.begin(), iterate.hub_rate.end());
    gradient_ = iterate.gradient;
    restart();
    return true;
  }

  void unload(Iterate<Y>& iterate) const {
    const double* from = bodies_.data();
    for (std::size_t b = 0; b < iterate.velocity.size(); ++b, from += record) {
      for (int a = 0; a < D; ++a) iterate.velocity[b][a] = from[a];
      if constexpr (Y.friction && D == 2) iterate.spin[b] = from[2];
      if constexpr (Y.friction && D == 3) iterate.spin[b] = {from[4], from[5], from[6]};
    }
    for (std::size_t g = 0; g < groups(); ++g)
      for (int lane = 0; lane < group_lanes; ++lane)
        if (const int k = contact_[group_lanes * g + lane]; k >= 0)
          for (int a = 0; a < R; ++a) iterate.reaction[k][a] = reactions_.data()[reaction_at(g, a) + lane];
    std::copy(hub_rate_.begin(), hub_rate_.end(), iterate.hub_rate.begin());
    iterate.gradient = gradient_;
  }

  /// One sweep from r + beta (r - r before). Returns the squared change and the squared impulses, in energy units.
  ResidualParts sweep(double beta) {
    extrapolate(beta);
    return visit_all(beta);
  }

  /// One sweep from r + beta p, p the last step from start to start (conjugate directions).
  ResidualParts sweep_along(double beta) {
    if (!directed_) begin_directions();
    step_along(beta);
    return visit_all(0);
  }

  /// The residual of cd/residual.hpp of the last sweep's impulses.
  double residual() {
    SweepView view = view_of(0);
    const ResidualParts total = in_chunks(0, groups(), false, [&](std::size_t begin, std::size_t end, SweepSums& sums) {
      functions_.residual(view, begin, end, sums);
    });
    if (total.map == 0) return 0;
    return total.impulse > 0 ? std::sqrt(total.map / total.impulse) : std::numeric_limits<double>::infinity();
  }

  /// Forgets earlier sweeps.
  void restart() {
    for (std::size_t g = 0; g < groups(); ++g) {
      double* r = reactions_.data() + reaction_at(g, 0);
      std::copy(r, r + R * group_lanes, r + R * group_lanes);
    }
    bodies_before_.copy(bodies_);
    hub_before_ = hub_rate_, gradient_before_ = gradient_;
    directed_ = false;
  }

  /// Remembers the present impulses, and returns to them.
  void keep() {
    kept_reactions_.copy(reactions_), kept_bodies_.copy(bodies_);
    kept_hub_ = hub_rate_, kept_gradient_ = gradient_;
  }
  void return_to_kept() {
    reactions_.copy(kept_reactions_), bodies_.copy(kept_bodies_);
    hub_rate_ = kept_hub_, gradient_ = kept_gradient_;
    restart();
  }

 private:
  static constexpr std::size_t chunk_groups = chunk_size / group_lanes;

  /// Groups that are visited between two answers of the hub.
  struct Stretch {
    std::size_t begin, end;
    bool sequential;
  };

  /// No step has been taken yet.
  void begin_directions() {
    directed_ = true;
    direction_.resize(0), direction_.resize(groups() * R * group_lanes);
    body_direction_.resize(0), body_direction_.resize(bodies_.size());
    hub_direction_.assign(hub_rate_.size(), 0.0);
    gradient_direction_.setZero();
  }

  std::size_t groups() const { return contact_.size() / group_lanes; }
  static std::size_t reaction_at(std::size_t group, int component) { return (2 * R * group + component) * group_lanes; }

  /// Puts the contacts of each colour into groups; contacts that share bodies get one each.
  void lay_out(const Problem<Y>& problem, std::size_t hub_block) {
    contact_.clear(), stretches_.clear();
    const int colours = static_cast<int>(problem.group.size()) - 1;
    const std::size_t block = problem.hub.empty() ? std::numeric_limits<std::size_t>::max() : hub_block / group_lanes;
    make_room(problem, block);
    for (int c = 0; c < colours; ++c) {
      const bool shared = c == problem.shared[0] || c == problem.shared[1];
      const std::size_t first = groups();
      for (int k = problem.group[c]; k < problem.group[c + 1]; ++k) {
        contact_.push_back(k);
        if (shared) contact_.insert(contact_.end(), group_lanes - 1, -1);
      }
      while (contact_.size() % group_lanes != 0) contact_.push_back(-1);
      for (std::size_t g = first; g < groups(); g += std::min(block, groups() - g))
        stretches_.push_back({g, g + std::min(block, groups() - g), shared});
    }
  }

  /// Memory for as many contacts as the problem has room for, each colour's last group filled up: numbers of contacts
  /// wander from step to step. What few solves need is reserved too, so that no later step allocates.
  void make_room(const Problem<Y>& problem, std::size_t block) {
    constexpr std::size_t most_fillers = group_lanes * (Colouring::most_colours + 2);
    std::size_t room = problem.i.capacity() + most_fillers;
    for (const int c : problem.shared)
      if (c >= 0) room += group_lanes * (problem.group[c + 1] - problem.group[c]);
    contact_.reserve(room);
    stretches_.reserve(Colouring::most_colours + 2 + room / group_lanes / std::min(block, room));
    where_.reserve(2 * room);
    contacts_.reserve(room * C::count), reactions_.reserve(2 * R * room);
    kept_reactions_.reserve(2 * R * room), direction_.reserve(R * room);
    const std::size_t bodies = (problem.inverse_mass.size() + 1) * record;
    for (LineVector* values : {&bodies_, &bodies_before_, &kept_bodies_, &body_direction_}) values->reserve(bodies);
    kept_hub_.reserve(problem.hub.size()), hub_direction_.reserve(problem.hub.size());
    partial_.reserve(room / chunk_size + 2);
  }

  void load_bodies(const Problem<Y>& problem, const Iterate<Y>& iterate) {
    const std::size_t count = iterate.velocity.size();
    bodies_.resize((count + 1) * record);
    double* to = bodies_.data();
    for (std::size_t b = 0; b < count; ++b, to += record) {
      const bool grain = static_cast<int>(b) < problem.grains;
      for (int a = 0; a < D; ++a) to[a] = iterate.velocity[b][a];
      if constexpr (Y.friction && D == 2) to[2] = iterate.spin[b];
      if constexpr (!Y.friction && D == 2) to[2] = 0;
      to[3] = grain ? problem.inverse_mass[b] : 0;
      if constexpr (Y.friction && D == 3) {
        for (int a = 0; a < 3; ++a) to[4 + a] = iterate.spin[b][a];
        to[7] = grain ? problem.inverse_inertia[b] : 0;
      }
    }
    std::fill(to, to + record, 0.0);
    movable_ = static_cast<std::uint32_t>(problem.grains * record);
  }

  void load_contacts(const Problem<Y>& problem, const Iterate<Y>& iterate) {
    where_.resize(2 * contact_.size());
    contacts_.resize(groups() * C::count * group_lanes);
    reactions_.resize(groups() * 2 * R * group_lanes);
    const auto filler = static_cast<std::uint32_t>(iterate.velocity.size() * record);
    parallel_ranges(groups(), [&](std::size_t begin, std::size_t end) {
      for (std::size_t g = begin; g < end; ++g)
        for (int lane = 0; lane < group_lanes; ++lane) {
          const int k = contact_[group_lanes * g + lane];
          std::uint32_t* where = &where_[2 * group_lanes * g + lane];
          double* columns = contacts_.data() + g * C::count * group_lanes + lane;
          double* r = reactions_.data() + reaction_at(g, 0) + lane;
          if (k >= 0) {
            where[0] = static_cast<std::uint32_t>(problem.i[k] * record);
            where[group_lanes] = static_cast<std::uint32_t>(problem.j[k] * record);
            load_contact(problem, k, columns);
            for (int a = 0; a < R; ++a) r[a * group_lanes] = iterate.reaction[k][a];
          } else {
            where[0] = where[group_lanes] = filler;
            for (int a = 0; a < C::count; ++a) columns[a * group_lanes] = 0;
            for (int a = 0; a < R; ++a) r[a * group_lanes] = 0;
          }
        }
    });
  }

  static void load_contact(const Problem<Y>& problem, int k, double* columns) {
    const auto set = [&](int column, double value) { columns[column * group_lanes] = value; };
    for (int a = 0; a < D; ++a) set(C::normal + a, problem.normal[k][a]);
    set(C::offset, problem.offset[k]);
    set(C::inverse_wn, problem.inverse_wn[k]);
    set(C::distance, problem.distance[k]);
    if constexpr (Y.friction) {
      set(C::inverse_wt, problem.inverse_wn[k] > 0 ? problem.inverse_wt[k] : 0);
      set(C::arm_i, problem.arm_i[k]), set(C::arm_j, problem.arm_j[k]);
      set(C::friction, problem.laws[problem.law[k]].friction);
      if constexpr (D == 2) {
        set(C::turn_i, problem.arm_i[k] * problem.inverse_inertia[problem.i[k]]);
        set(C::turn_j, problem.arm_j[k] * problem.inverse_inertia[problem.j[k]]);
      }
    }
  }

  SweepView view_of(double beta) {
    SweepView view{where_.data(), contacts_.data(), reactions_.data(), bodies_.data(), movable_, beta, {}};
    for (int a = 0; a < D * D; ++a) view.gradient[a] = gradient_(a / D, a % D);
    return view;
  }

  ResidualParts visit_all(double beta) {
    ResidualParts total;
    for (const Stretch& stretch : stretches_) {
      const SweepView view = view_of(beta);
      virial_.setZero();
      total += in_chunks(stretch.begin, stretch.end, stretch.sequential,
                         [&](std::size_t begin, std::size_t end, SweepSums& sums) {
                           // The kernel begins a group before it has ended the one before.
                           const std::size_t at_once = stretch.sequential ? 1 : end - begin;
                           for (; begin < end; begin += at_once) functions_.sweep(view, begin, begin + at_once, sums);
                         });
      for (std::size_t m = 0; m < hub_rate_.size(); ++m) {
        const HubMode<D>& mode = problem_->hub[m];
        const double change = virial_.cwiseProduct(mode.direction).sum() * mode.inverse_inertia;
        hub_rate_[m] += change;
        gradient_ += change * mode.direction;
      }
    }
    return total;
  }

  /// Calls body for the groups [begin, end) in chunks; their sums, added in order.
  template <class Body>
  ResidualParts in_chunks(std::size_t begin, std::size_t end, bool sequential, const Body& body) {
    const std::size_t chunks = (end - begin + chunk_groups - 1) / chunk_groups;
    if (partial_.size() < chunks) partial_.resize(chunks);
    const auto work = [&](std::size_t first, std::size_t last) {
      for (std::size_t chunk = first; chunk < last; ++chunk) {
        partial_[chunk] = SweepSums{};
        const std::size_t from = begin + chunk * chunk_groups;
        body(from, std::min(from + chunk_groups, end), partial_[chunk]);
      }
    };
    if (sequential)
      work(0, chunks);
    else
      parallel_ranges(chunks, work, 2);
    ResidualParts total;
    const auto sum = [](const double(&lanes)[group_lanes]) { return (lanes[0] + lanes[1]) + (lanes[2] + lanes[3]); };
    for (std::size_t chunk = 0; chunk < chunks; ++chunk) {
      const SweepSums& part = partial_[chunk];
      total += {sum(part.map), sum(part.impulse)};
      if (cell_)
        for (int a = 0; a < D * D; ++a) virial_(a / D, a % D) += sum(part.virial[a]);
    }
    return total;
  }

  /// Bodies and hub: now += beta (now - before); before = now.
  void extrapolate(double beta) {
    double *now = bodies_.data(), *before = bodies_before_.data();
    parallel_ranges(
        bodies_.size(),
        [&](std::size_t begin, std::size_t end) {
          for (std::size_t k = begin; k < end; ++k) {
            const double here = now[k];
            now[k] = here + beta * (here - before[k]);
            before[k] = here;
          }
        },
        8192);
    for (std::size_t m = 0; m < hub_rate_.size(); ++m) {
      const double here = hub_rate_[m];
      hub_rate_[m] += beta * (here - hub_before_[m]);
      hub_before_[m] = here;
    }
    const Mat<D> gradient = gradient_;
    gradient_ += beta * (gradient - gradient_before_);
    gradient_before_ = gradient;
  }

  /// now += beta p; p = now - before; before = now. (Impulses: the kernel itself sets `before`.)
  static void step(double& now, double& before, double& direction, double beta) {
    now += beta * direction;
    direction = now - before;
    before = now;
  }
  void step_along(double beta) {
    parallel_ranges(groups(), [&](std::size_t begin, std::size_t end) {
      constexpr int width = R * group_lanes;
      for (std::size_t g = begin; g < end; ++g) {
        double* now = reactions_.data() + reaction_at(g, 0);
        for (int a = 0; a < width; ++a) step(now[a], now[width + a], direction_.data()[g * width + a], beta);
      }
    });
    for (std::size_t k = 0; k < bodies_.size(); ++k)
      step(bodies_.data()[k], bodies_before_.data()[k], body_direction_.data()[k], beta);
    for (std::size_t m = 0; m < hub_rate_.size(); ++m) step(hub_rate_[m], hub_before_[m], hub_direction_[m], beta);
    for (int a = 0; a < D * D; ++a)
      step(gradient_.data()[a], gradient_before_.data()[a], gradient_direction_.data()[a], beta);
  }

  std::vector<int> contact_;  ///< of each lane; -1: none
  std::vector<Stretch> stretches_;
  std::vector<std::uint32_t> where_;
  LineVector contacts_, reactions_, bodies_, bodies_before_;
  LineVector kept_reactions_, kept_bodies_, direction_, body_direction_;
  std::vector<double> hub_rate_, hub_before_, kept_hub_, hub_direction_;
  Mat<D> gradient_, gradient_before_, kept_gradient_, gradient_direction_, virial_;
  std::uint32_t movable_ = 0;
  bool cell_ = false, directed_ = false;
  SweepFunctions functions_{};
  const Problem<Y>* problem_ = nullptr;
  std::vector<SweepSums> partial_;
};

}  // namespace galet::cd
