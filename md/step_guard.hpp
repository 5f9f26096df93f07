// Whether the time step still suits the packing: it was derived for contacts of some stiffness and for the neighbours
// that a grain has in a crystal (common/scene/md_step.hpp). Hertz contacts stiffen as they are pressed, and soft grains
// pressed together meet more neighbours. Beyond what the step is stable for the run stops and names the culprit.
#pragma once

#include <cmath>
#include <span>
#include <vector>

#include <fmt/format.h>

#include "common/core/column.hpp"
#include "common/core/error.hpp"
#include "common/engine/bodies.hpp"
#include "common/geometry/contact_frame.hpp"
#include "common/neighbour/verlet_list.hpp"
#include "common/scene/derive.hpp"
#include "common/scene/pair_law.hpp"
#include "common/scene/scene.hpp"
#include "md/contacts.hpp"

namespace galet::md {

template <Layout Y>
class StepGuard {
 public:
  static constexpr int D = Y.dim;

  /// Without a bound of the step, or where the scene allows any, nothing is looked at.
  StepGuard(const Scene& scene, const Derived& derived, bool hertz) : dt_(*derived.md_dt) {
    if (!derived.md_dt_stable || scene.md.allow_unsafe_dt) return;
    if (hertz) stiffest_ = derived.md_stiffest * std::pow(*derived.md_dt_stable / dt_, 2);
    most_neighbours_ = derived.md_most_neighbours;
    least_mass_ = derived.grains.least_mass;
  }

  /// Whether stiffness() has something to look at.
  bool watches_stiffness() const { return stiffest_ > 0; }

  /// Hertz contacts. frame_of(row): of the pair. O(pairs).
  template <class FrameOf>
  void stiffness(const Contacts<Y>& contacts, const VerletList<D>& list, std::span<const int> number, double time,
                 FrameOf frame_of) const {
    const int grains = static_cast<int>(number.size());
    for (std::size_t row = 0; row < list.size(); ++row) {
      if (!contacts.touches(row)) continue;
      const double deflection = -frame_of(row).gap;
      const double stiffness = tangent_stiffness(NormalLaw::hertz, contacts.coefficient(row), deflection);
      if (!(stiffness > stiffest_)) continue;
      const int i = list.pairs().i[row], j = list.pairs().j[row];
      throw RunError(
          fmt::format("at time {:.6g} the contact of grain {} and {} {} is deflected by {:.3g}: so stiff a contact "
                      "needs md.dt <= {:.4g}, it is {:.4g}",
                      time, number[i], j < grains ? "grain" : "plane", j < grains ? number[j] : j - grains, deflection,
                      dt_ * std::sqrt(stiffest_ / stiffness), dt_));
    }
  }

  /// Touching neighbours of each free grain, by its mass. O(pairs).
  void neighbours(const Contacts<Y>& contacts, const VerletList<D>& list, const Bodies<Y>& bodies,
                  std::span<const int> number, double time) {
    if (!(most_neighbours_ > 0)) return;
    const int grains = bodies.grains();
    refill(count_, static_cast<std::size_t>(grains), 0);
    for (std::size_t row = 0; row < list.size(); ++row) {
      if (!contacts.touches(row)) continue;
      ++count_[list.pairs().i[row]];
      if (list.pairs().j[row] < grains) ++count_[list.pairs().j[row]];
    }
    for (int i = 0; i < grains; ++i) {
      const double as_lightest = count_[i] * least_mass_ / bodies.mass[i];
      if (!(as_lightest > most_neighbours_) || !bodies.rigid.free(i)) continue;
      throw RunError(fmt::format(
          "at time {:.6g} grain {} touches {} others: so many contacts need md.dt below about {:.4g}, it is "
          "{:.4g}",
          time, number[i], count_[i], dt_ * std::sqrt(most_neighbours_ / as_lightest), dt_));
    }
  }

 private:
  double dt_;
  double stiffest_ = 0;         ///< hertz: K_N that the step allows; 0: any
  double most_neighbours_ = 0;  ///< of a grain of the least mass; 0: any
  double least_mass_ = 0;
  std::vector<int> count_;
};

}  // namespace galet::md
