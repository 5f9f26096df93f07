// The series of a run: rows in time, each the mean of the samples taken since the row before (an instantaneous
// stress is noisy, so a run samples more often than it writes), and the averages of a part of the run.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "common/core/archive.hpp"
#include "common/io/csv.hpp"
#include "common/measure/block_average.hpp"
#include "src/measure.hpp"
#include "src/observable.hpp"

namespace galet {

/// Collects the samples of one row.
class RowAverager {
 public:
  void add(const Measurement& sample);
  int samples() const { return samples_; }
  /// The row of the samples so far; starts the next row.
  Measurement finish(const MeasureScale& scale);

  void save(Archive& archive) const;
  void restore(const Archive& archive);

 private:
  Measurement sums_;
  int samples_ = 0;
  std::array<int, observable_count> counts_{};  ///< samples in which the observable had a value
};

struct TimeSeries {
  int dimension = 2;
  bool budget = false;  ///< whether energy was accounted for
  bool si = false;      ///< in SI units, else in the scene's own
  MeasureSet asked;     ///< measures beyond those of every run
  std::vector<Measurement> rows;

  /// Values of one observable in the rows whose time is above `from`.
  std::vector<double> column(Observable observable, double from = -1) const;

  void save(Archive& archive) const;
  void restore(const Archive& archive);
};

/// Averages over the rows whose time is above `from`, each with its standard error by blocking. Rows in which an
/// observable has no value don't count for it.
struct Averages {
  double from = 0;
  int rows = 0;
  std::array<Estimate, observable_count> values{};
  /// Integrated autocorrelation times (autocorrelation.hpp) of the rows; NaN where there is none. A row is a mean over
  /// its interval: memories shorter than half of that don't show.
  std::array<double, observable_count> correlation_time{};
  const Estimate& operator[](Observable observable) const { return values[static_cast<int>(observable)]; }
};

/// Takes the last part of the series, from the fraction `average_from` of its time (after `start`) on. What follows
/// from the stress (mu*, pressure, I, kappa) is computed from the mean stress: means of ratios are biased by
/// fluctuations of sigma_yy. peak_overlap is the largest, not a mean.
Averages averages(const TimeSeries& series, const MeasureScale& scale, double average_from, double start = 0);

/// Mean of |numerator| over mean of denominator, with the error of the ratio: the block average of
/// (n - R d) / <d>. Assumes one sign of the numerator's mean; NaN when <d> is not positive.
Estimate ratio_of_means(const std::vector<double>& numerator, const std::vector<double>& denominator);

/// Is the observable a column of tables of such a run?
bool shown(Observable observable, const TimeSeries& series);

/// The unit of an observable in a scene in SI units; empty for pure numbers. (2D: grains have no thickness, a stress is
/// a force per length.)
std::string si_unit(Observable observable, int dimension);

/// The series as a table: one column per observable, with its unit in SI, an empty cell where one has no meaning.
CsvTable to_table(const TimeSeries& series);

}  // namespace galet
