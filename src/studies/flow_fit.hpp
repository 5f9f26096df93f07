// The linear laws of dense flow (chapter, eq. loisdilfrot; da Cruz et al. 2005):
//   mu*(I) = mu*_min + b I      Phi(I) = Phi_max - a I      for least <= I <= most
// fitted by weighted least squares to the realised I; errors widened by the scatter about the line, because the laws
// are an approximation and precise runs do not lie on them.
#pragma once

#include <vector>

#include "common/io/figure.hpp"
#include "src/line_fit.hpp"
#include "src/studies/study.hpp"

namespace galet {

struct FlowFit {
  Estimate mu_min, b, solid_fraction_max, a;
  int points = 0;  ///< with fewer than 2 all is NaN
};

/// The window in which the published laws are linear.
inline constexpr double linear_from = 0.009, linear_to = 0.21;

FlowFit fit_flow(const std::vector<const StudyRow*>& rows, double least = linear_from, double most = linear_to);

/// A published line value + slope x on [least, most] with the band that its uncertainties allow at each x:
/// u(x)^2 = u_value^2 + (u_slope x)^2.
Series published_line(const std::string& label, const Estimate& value, const Estimate& slope, double least,
                      double most);

}  // namespace galet
