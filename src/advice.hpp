// Which engine to take, and with which settings, for a wanted error of a comparison's judged quantity (mu* in shear,
// Phi without), and on what evidence.
//
// A row reaches the relative error x when it lies within x of the rigid limit of its state, and its noise lets that be
// said: |q - limit| <= x |limit|, two standard errors of the difference <= x |limit|. The cheapest such row of each
// engine counts. An engine of which no row does, but whose rows lie on a line with a slope above its noise, is
// extrapolated by that line and the law of its cost (rigid_limit.hpp; md: cost ~ sqrt(kappa), cd: ~ 1/dt):
//   md  kappa = |slope| / (x |limit|)        cd  dt = x |limit| / |slope|
// where that is finer than all its rows. Costs are the processor time per unit strain (or time) of a run, whatever its
// noise; how long a run must be is a matter of x alone, and the same for both.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "src/compare.hpp"

namespace galet {

/// What one engine needs for the wanted error.
struct Offer {
  EngineKind engine = EngineKind::md;
  const CompareRow* row = nullptr;  ///< the row that reaches it, or from which the law of cost starts
  double parameter = 0;             ///< kappa (md) or dt (cd)
  double cost = 0;                  ///< as CompareRow::cost
  bool extrapolated = false;        ///< no run with this parameter was made
};

/// The advice for one state.
struct Advice {
  const StateLimit* state = nullptr;
  double error = 0;             ///< x
  std::optional<Offer> md, cd;  ///< absent: no row reaches the error, and none can be extrapolated
  double least_noise = 0;       ///< two standard errors of the quietest row over |limit|
  const Offer* chosen() const;  ///< the cheaper one; null without any
};

/// Refers to `comparison`. Throws InputError unless 0 < error < 1.
std::vector<Advice> advise(const Comparison& comparison, double error);

std::string advice_text(const std::vector<Advice>& all, const Comparison& comparison);

}  // namespace galet
