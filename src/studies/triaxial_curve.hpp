// Stress against strain of the triaxial stage of a run that kept its series.
#pragma once

#include <vector>

#include "src/studies/study.hpp"

namespace galet {

/// Axial strain, volume strain and deviator over lateral pressure, each counted from the start of the stage.
struct TriaxialCurve {
  std::vector<double> strain, volume, deviator;
};

/// Of the stage called "triaxial"; empty without one, and when no stage is before it.
TriaxialCurve triaxial_curve(const StudyRow& row);

/// q/P at an axial strain, by linear interpolation; NaN beyond the curve.
double deviator_at(const TriaxialCurve& curve, double strain);

/// Axial strain at which q/P is first reached, by linear interpolation; NaN where it is not.
double strain_at(const TriaxialCurve& curve, double deviator);

/// Axial strain between q/P = 0.1 and 0.4, where the contacts of a well coordinated packing carry what is added (type
/// I). The first tenth is left out: packings assembled without friction settle a little more when they are first loaded
/// with it.
double type_I_strain(const TriaxialCurve& curve);

/// Mean of q/P over the rows with least <= strain <= most; NaN without any.
double mean_deviator(const TriaxialCurve& curve, double least, double most);

}  // namespace galet
