// What contacts remember, by row of the neighbour list: the repulsive impulse of the last step, that of the present one
// while it is being solved, and the attraction of the present one. Impulses start the solver, tell which pairs are in
// contact, and are the state of elastic contacts.
#pragma once

#include "cd/assembly.hpp"
#include "cd/laws/attraction.hpp"
#include "cd/problem.hpp"
#include "common/core/archive_columns.hpp"
#include "common/neighbour/verlet_list.hpp"

namespace galet::cd {

template <Layout Y>
class ContactHistory {
 public:
  static constexpr int D = Y.dim;

  Column<Reaction<Y>> before;     ///< at the end of the last step
  Column<Reaction<Y>> present;    ///< of this step, solved so far
  std::vector<double> attracted;  ///< impulse F_a dt of the last step; empty without cohesion

  /// Follows the list to its new rows.
  void carry(const VerletList<D>& list) {
    std::swap(before, carried_);
    refill(before, list.size(), Reaction<Y>::Zero());
    for (std::size_t row = 0; row < list.size(); ++row) {
      const int from = list.origin()[row];
      if (from < 0) continue;
      // Impulses kept as vectors change sign with the order of the pair; components of disks do not.
      const bool sign_changes = Y.friction && D == 3 && list.flipped(row);
      before[row] = sign_changes ? Reaction<Y>(-carried_[from]) : carried_[from];
    }
    if (!attracted.empty()) refill(attracted, list.size(), 0.0);
  }

  /// Impulses follow the length of the step.
  void rescale(double ratio) {
    if (ratio == 1) return;
    for (Reaction<Y>& reaction : before) reaction *= ratio;
  }

  /// Attraction of all pairs at the start of a step.
  void attract(const Bodies<Y>& bodies, const VerletList<D>& list, const LawTable& laws, const Assembly<Y>& assembly,
               double dt) {
    refill(attracted, list.size(), 0.0);
    for (std::size_t row = 0; row < list.size(); ++row) {
      const PairLaw& law = laws.pairs[law_index(bodies, list.pairs(), row, laws.materials)];
      attracted[row] = dt * attraction(law, assembly.frame(row).gap, !before[row].isZero(0));
    }
  }

  /// The impulse at which the solver starts: that of the step before, within the bounds of the present normal.
  Reaction<Y> warm_start(const Problem<Y>& problem, std::size_t k, const Reaction<Y>& reaction) const {
    if constexpr (!Y.friction) {
      return reaction;
    } else {
      Components<Y> parts = components<Y>(problem.normal[k], reaction);
      if (!(parts.normal > 0)) return Reaction<Y>::Zero();
      const ContactLaw& law = problem.laws[problem.law[k]];
      parts.tangential = bounded(parts.tangential, law.friction * parts.normal);
      if constexpr (Y.rolling) {
        parts.rolling = bounded(parts.rolling, law.rolling * parts.normal);
        parts.pivoting = bounded(parts.pivoting, law.pivoting * parts.normal);
      }
      return composed<Y>(problem.normal[k], parts);
    }
  }

  void store(const std::vector<int>& row_of, const Iterate<Y>& iterate) {
    refill(present, before.size(), Reaction<Y>::Zero());
    for (std::size_t k = 0; k < row_of.size(); ++k) present[row_of[k]] = iterate.reaction[k];
  }

  /// The step is over. Impulses kept as vectors turn with their contacts to the positions at its end, and about the
  /// normal by the mean spin; components of disks need no turning.
  void accept(const Bodies<Y>& bodies, const VerletList<D>& list, const Problem<Y>& problem,
              const std::vector<int>& row_of, double dt) {
    std::swap(before, present);
    if constexpr (Y.friction && D == 3) {
      for (std::size_t k = 0; k < row_of.size(); ++k) {
        Reaction<Y>& reaction = before[row_of[k]];
        if (reaction.isZero(0)) continue;
        const Vec<3>& old_normal = problem.normal[k];
        const Vec<3> normal = frame_of(bodies, list.pairs(), row_of[k]).normal;
        const int i = list.pairs().i[row_of[k]], j = list.pairs().j[row_of[k]];
        Vec<3> spin = bodies.spin[i];
        if (j < bodies.grains()) spin = 0.5 * (spin + bodies.spin[j]);
        const double angle = spin.dot(normal) * dt, cosine = std::cos(angle), sine = std::sin(angle);
        const auto turned = [&](const Vec<3>& value) {
          const Vec<3> moved = carried(value, old_normal, normal);
          return Vec<3>(cosine * moved + sine * normal.cross(moved));
        };
        Components<Y> parts = components<Y>(old_normal, reaction);
        parts.tangential = turned(parts.tangential);
        if constexpr (Y.rolling) parts.rolling = turned(parts.rolling);
        reaction = composed<Y>(normal, parts);
      }
    }
  }

  void save(Archive& archive) const {
    put_column(archive, "contacts.reaction", before);
    put_column(archive, "contacts.attraction", attracted);
  }
  void restore(const Archive& archive, std::size_t rows) {
    before.resize(rows);
    take_column(archive, "contacts.reaction", before);
    attracted.resize(real_column(archive, "contacts.attraction").size());
    take_column(archive, "contacts.attraction", attracted);
  }

 private:
  Column<Reaction<Y>> carried_;
};

}  // namespace galet::cd
