#include "src/time_series.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include <fmt/format.h>

#include "common/core/error.hpp"
#include "common/measure/autocorrelation.hpp"

namespace galet {

void RowAverager::add(const Measurement& sample) {
  for (int k = 0; k < observable_count; ++k) {
    switch (observable_table[k].reduction) {
      case Reduction::mean:
        // A measure may have no meaning in some states: the mean is that of the others.
        if (std::isnan(sample.values[k])) break;
        sums_.values[k] += sample.values[k];
        ++counts_[k];
        break;
      case Reduction::latest:
        sums_.values[k] = sample.values[k];
        break;
      case Reduction::largest:
        sums_.values[k] = std::max(sums_.values[k], sample.values[k]);
        break;
      case Reduction::derived:
        break;
    }
  }
  ++samples_;
}

Measurement RowAverager::finish(const MeasureScale& scale) {
  require(samples_ > 0, "a row needs at least one sample");
  Measurement row = sums_;
  for (int k = 0; k < observable_count; ++k)
    if (observable_table[k].reduction == Reduction::mean)
      row.values[k] = counts_[k] > 0 ? row.values[k] / counts_[k] : std::numeric_limits<double>::quiet_NaN();
  complete(row, scale);
  *this = RowAverager{};
  return row;
}

void RowAverager::save(Archive& archive) const {
  archive.reals["run.row_sums"].assign(sums_.values.begin(), sums_.values.end());
  archive.integers["run.row_samples"] = {samples_};
  archive.integers["run.row_counts"].assign(counts_.begin(), counts_.end());
}

void RowAverager::restore(const Archive& archive) {
  const auto& sums = real_column(archive, "run.row_sums");
  if (sums.size() != observable_count) throw InputError("the checkpoint measures other observables than this version");
  std::copy(sums.begin(), sums.end(), sums_.values.begin());
  samples_ = static_cast<int>(integer_column(archive, "run.row_samples").at(0));
  const auto& counts = integer_column(archive, "run.row_counts");
  if (counts.size() != observable_count)
    throw InputError("the checkpoint measures other observables than this version");
  for (int k = 0; k < observable_count; ++k) counts_[k] = static_cast<int>(counts[k]);
}

std::vector<double> TimeSeries::column(Observable observable, double from) const {
  std::vector<double> values;
  for (const Measurement& row : rows)
    if (row[Observable::time] > from) values.push_back(row[observable]);
  return values;
}

void TimeSeries::save(Archive& archive) const {
  std::vector<double>& flat = archive.reals["run.rows"];
  flat.clear();
  flat.reserve(rows.size() * observable_count);
  for (const Measurement& row : rows) flat.insert(flat.end(), row.values.begin(), row.values.end());
}

void TimeSeries::restore(const Archive& archive) {
  const auto& flat = real_column(archive, "run.rows");
  if (flat.size() % observable_count != 0)
    throw InputError("the checkpoint measures other observables than this version");
  rows.assign(flat.size() / observable_count, {});
  for (std::size_t r = 0; r < rows.size(); ++r)
    std::copy_n(flat.begin() + static_cast<std::ptrdiff_t>(r * observable_count), observable_count,
                rows[r].values.begin());
}

Estimate ratio_of_means(const std::vector<double>& numerator, const std::vector<double>& denominator) {
  require(numerator.size() == denominator.size(), "a ratio needs as many numerators as denominators");
  const auto mean = [](const std::vector<double>& values) {
    return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
  };
  if (numerator.empty() || !(mean(denominator) > 0)) return {std::numeric_limits<double>::quiet_NaN(), 0};
  const double below = mean(denominator), ratio = mean(numerator) / below;
  std::vector<double> residual(numerator.size());
  for (std::size_t k = 0; k < residual.size(); ++k) residual[k] = (numerator[k] - ratio * denominator[k]) / below;
  return {std::abs(ratio), block_average(residual).error};
}

namespace {

/// The columns that follow from the stress, from its mean, and their errors: those of their own fluctuations for the
/// pressure and mu*, and those of the pressure that they are divided by for I ~ P^(-1/2) and kappa ~ P^(-1).
void average_derived(Averages& result, const TimeSeries& series, const MeasureScale& scale) {
  Measurement mean;
  for (int k = 0; k < observable_count; ++k) mean.values[k] = result.values[k].value;
  complete(mean, scale);
  const auto put = [&](Observable observable, double error) {
    result.values[static_cast<int>(observable)] = {mean[observable], error};
  };
  put(Observable::pressure, result[Observable::pressure].error);
  put(Observable::mu_star,
      ratio_of_means(series.column(Observable::sigma_xy, result.from), series.column(Observable::sigma_yy, result.from))
          .error);
  const Estimate& reference = result[scale.shear_rate != 0 ? Observable::sigma_yy : Observable::pressure];
  const double relative = reference.value > 0 ? reference.error / reference.value : 0;
  put(Observable::inertial_number, 0.5 * relative * mean[Observable::inertial_number]);
  const double power = scale.law && scale.law->normal_law == NormalLaw::hertz ? 2.0 / 3 : 1;  // kappa ~ P^-power
  put(Observable::stiffness_level, power * relative * mean[Observable::stiffness_level]);
}

}  // namespace

Averages averages(const TimeSeries& series, const MeasureScale& scale, double average_from, double start) {
  Averages result;
  result.correlation_time.fill(std::numeric_limits<double>::quiet_NaN());
  result.from = start;
  // A part of the run that has only begun has no rows yet.
  if (series.rows.empty() || !(series.rows.back()[Observable::time] > start)) return result;
  require(average_from >= 0 && average_from < 1, "averages start at a fraction of the run below 1");
  result.from = start + average_from * (series.rows.back()[Observable::time] - start);
  for (int k = 0; k < observable_count; ++k) {
    std::vector<double> values = series.column(static_cast<Observable>(k), result.from);
    result.rows = static_cast<int>(values.size());
    const std::vector<double> times = series.column(Observable::time, result.from);
    std::erase_if(values, [](double value) { return std::isnan(value); });
    if (values.empty())
      result.values[k] = {std::numeric_limits<double>::quiet_NaN(), 0};
    else if (observable_table[k].reduction == Reduction::largest)
      result.values[k] = {*std::max_element(values.begin(), values.end()), 0};
    else
      result.values[k] = block_average(values);
    // Rows without a value leave gaps, whose lengths the correlation would not see.
    if (observable_table[k].reduction != Reduction::largest && values.size() == times.size() && times.size() > 1)
      result.correlation_time[k] =
          autocorrelation_time(values) * (times.back() - times.front()) / static_cast<double>(times.size() - 1);
  }
  average_derived(result, series, scale);
  return result;
}

bool shown(Observable observable, const TimeSeries& series) {
  switch (info(observable).shown) {
    case Shown::always:
      return true;
    case Shown::in_3d:
      return series.dimension == 3;
    case Shown::with_budget:
      return series.budget;
    case Shown::with_fabric:
      return series.asked.has(MeasureKind::fabric);
    case Shown::with_friction:
      return series.asked.has(MeasureKind::friction);
    case Shown::with_temperature:
      return series.asked.has(MeasureKind::temperature);
    case Shown::with_balance:
      return series.asked.has(MeasureKind::balance);
  }
  return false;
}

std::string si_unit(Observable observable, int dimension) {
  const auto within = [observable](Observable first, Observable last) {
    return first <= observable && observable <= last;
  };
  if (observable == Observable::time) return "s";
  if (within(Observable::sigma_xx, Observable::sigma_yz) || observable == Observable::pressure)
    return dimension == 2 ? "N/m" : "Pa";
  if (within(Observable::kinetic_per_grain, Observable::energy_residual) ||
      within(Observable::temperature, Observable::rotational_temperature))
    return "J";
  return "";
}

CsvTable to_table(const TimeSeries& series) {
  CsvTable table;
  if (!series.si) table.comments.emplace_back("in the scene's own (reduced) units");
  for (int k = 0; k < observable_count; ++k) {
    if (!shown(static_cast<Observable>(k), series)) continue;
    table.comments.push_back(fmt::format("{}: {}", observable_table[k].name, observable_table[k].meaning));
    table.columns.push_back({std::string(observable_table[k].name),
                             series.si ? si_unit(static_cast<Observable>(k), series.dimension) : std::string()});
  }
  for (const Measurement& row : series.rows) {
    std::vector<CsvCell>& cells = table.rows.emplace_back();
    for (int k = 0; k < observable_count; ++k) {
      if (!shown(static_cast<Observable>(k), series)) continue;
      cells.emplace_back();
      if (!std::isnan(row.values[k])) cells.back() = row.values[k];
    }
  }
  return table;
}

}  // namespace galet
