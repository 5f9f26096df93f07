// The compliance of a step's contacts (laws/compliance.hpp), and Newton's iteration on Hertz' law: contacts are
// linearised at the overlap they have, solved, and linearised again at the one that was found, until the forces of the
// law and of its linearisation agree. A linear law needs one round.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "cd/assembly.hpp"
#include "cd/laws/compliance.hpp"
#include "cd/problem.hpp"

namespace galet::cd {

template <Layout Y>
class ElasticContacts {
 public:
  static constexpr int D = Y.dim;
  static constexpr int most_rounds = 30;

  /// Deflections at the start of a step; below `least` a Hertz contact counts as one of that deflection, since without
  /// stiffness there is nothing to linearise.
  void start(const Assembly<Y>& assembly, std::size_t rows, double least) {
    least_ = least;
    rounds_ = 0;
    refill(deflection_, rows, 0.0);
    for (std::size_t row = 0; row < rows; ++row) deflection_[row] = std::max(-assembly.frame(row).gap, least);
  }

  /// Adds the compliance to an assembled problem; `before`: impulses of the last step, by row.
  void apply(const Bodies<Y>& bodies, const LawTable& laws, const PairColumns<D>& pairs, const Assembly<Y>& assembly,
             const Column<Reaction<Y>>& before, double dt, Problem<Y>& problem) const {
    for (std::size_t k = 0; k < problem.size(); ++k) {
      const int row = assembly.row_of()[k];
      const PairLaw& law = laws.pairs[law_index(bodies, pairs, row, laws.materials)];
      const double gap = assembly.frame(row).gap;
      const ImplicitContact contact =
          implicit_contact(law, coefficient(bodies, law, pairs, row), bodies.reduced_mass(pairs.i[row], pairs.j[row]),
                           gap, deflection_[row], dt);
      problem.compliance[k] = contact.compliance;
      problem.offset[k] = contact.offset;
      problem.wn[k] += contact.compliance.normal;
      problem.inverse_wn[k] = 1 / problem.wn[k];
      if constexpr (Y.friction) {
        const Compliance& c = contact.compliance;
        problem.inverse_wt[k] = 1 / (1 / problem.inverse_wt[k] + c.tangential);
        if (problem.turns(k)) {
          auto diagonal = problem.bent[k - problem.first_turning].w.diagonal();
          diagonal[0] += c.normal;
          diagonal.template segment<D - 1>(1).array() += c.tangential;
          if constexpr (Y.rolling) diagonal.template segment<D - 1>(D).array() += c.rolling;
          if constexpr (Y.rolling && D == 3) diagonal[5] += c.pivoting;
        }
        Components<Y> parts = components<Y>(problem.normal[k], before[row]);
        const double kept = kept_elastic(law, -gap, deflection_[row]);
        parts.tangential *= -c.tangential * kept;
        if constexpr (Y.rolling) {
          problem.wr[k] += c.rolling, problem.wp[k] += c.pivoting;
          parts.rolling *= -c.rolling * kept, parts.pivoting *= -c.pivoting * kept;
        }
        problem.lag[k] = composed<Y>(problem.normal[k], parts);
      }
    }
  }

  /// Whether the solved forces are those of the law within `tolerance`; takes the deflections found for the next round.
  bool agrees(const Bodies<Y>& bodies, const LawTable& laws, const PairColumns<D>& pairs, const Assembly<Y>& assembly,
              const Problem<Y>& problem, const Iterate<Y>& iterate, double dt, double tolerance) {
    if (laws.pairs[0].normal_law == NormalLaw::linear) return true;
    double miss = 0, scale = 0;
    for (std::size_t k = 0; k < problem.size(); ++k) {
      const int row = assembly.row_of()[k];
      const PairLaw& law = laws.pairs[law_index(bodies, pairs, row, laws.materials)];
      const double c = coefficient(bodies, law, pairs, row);
      const double u_n = problem.normal[k].dot(relative_velocity(problem, iterate, iterate.gradient, k));
      const double found = std::max(-(assembly.frame(row).gap + dt * u_n), 0.0);
      const ElasticPoint at = elastic_point(law, c, deflection_[row]);
      if (problem.normal[k].dot(impulse_vector<Y>(problem.normal[k], iterate.reaction[k])) > 0) {
        const double exact = elastic_point(law, c, found).force;
        const double linear = at.force + at.stiffness * (found - deflection_[row]);
        miss += (exact - linear) * (exact - linear);
        scale += exact * exact;
      }
      deflection_[row] = std::max(found, least_);
    }
    return miss <= tolerance * tolerance * scale || ++rounds_ >= most_rounds;
  }
  bool gave_up() const { return rounds_ >= most_rounds; }

  /// Adds the elastic energy of the contacts at the present positions.
  static void add_energy(const Bodies<Y>& bodies, const LawTable& laws, const PairColumns<D>& pairs,
                         const Column<Reaction<Y>>& reaction, double dt, EnergyParts& parts) {
    for (std::size_t row = 0; row < pairs.size(); ++row) {
      if (reaction[row].isZero(0)) continue;
      const ContactFrame<D> frame = frame_of(bodies, pairs, row);
      if (frame.gap >= 0) continue;
      const PairLaw& law = laws.pairs[law_index(bodies, pairs, row, laws.materials)];
      const ElasticPoint at = elastic_point(law, coefficient(bodies, law, pairs, row), -frame.gap);
      parts.elastic_normal += at.force * -frame.gap / (law.normal_law == NormalLaw::linear ? 2 : 2.5);
      if constexpr (Y.friction) {
        const Components<Y> r = components<Y>(frame.normal, reaction[row]);
        const auto stored = [&](double squared_impulse, double stiffness) {
          return stiffness > 0 ? squared_impulse / (2 * stiffness * dt * dt) : 0;
        };
        parts.elastic_tangential += stored(squared(r.tangential), law.tangential_ratio * at.stiffness);
        if constexpr (Y.rolling) {
          const double turning = law.rolling_ratio * at.stiffness;
          parts.elastic_rolling +=
              stored(squared(r.rolling), turning * law.rolling_friction * law.rolling_friction) +
              stored(r.pivoting * r.pivoting, turning * law.pivoting_friction * law.pivoting_friction);
        }
      }
    }
  }

 private:
  static double coefficient(const Bodies<Y>& bodies, const PairLaw& law, const PairColumns<D>& pairs, std::size_t row) {
    const int j = pairs.j[row], grains = bodies.grains();
    const double radius = bodies.radius[pairs.i[row]];
    return normal_coefficient(law, j < grains ? reduced_radius(radius, bodies.radius[j])
                                              : reduced_radius_at(bodies.planes[j - grains], radius));
  }

  std::vector<double> deflection_;  ///< h*, by row
  double least_ = 0;
  int rounds_ = 0;
};

}  // namespace galet::cd
