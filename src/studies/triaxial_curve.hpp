// Stress against strain of the triaxial stage of a run that kept its series.
#pragma once

#include <vector>

#include "src/studies/study.hpp"

namespace galet {

/// Axial strain, volume strain and deviator over lateral pressure, each counted from the start of the stage.
struct TriaxialCurve {
  std::vector<double> strain, volume, deviator;
};

/// Of the last stage, if it is called "triaxial"; empty otherwise.
TriaxialCurve triaxial_curve(const StudyRow& row);

/// Mean of q/P over the rows with least <= strain <= most; NaN without any.
double mean_deviator(const TriaxialCurve& curve, double least, double most);

}  // namespace galet
