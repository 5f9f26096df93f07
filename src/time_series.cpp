#include "src/time_series.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "common/core/error.hpp"

namespace galet {

void RowAverager::add(const Measurement& sample) {
  for (int k = 0; k < observable_count; ++k) {
    switch (observable_table[k].reduction) {
      case Reduction::mean: sums_.values[k] += sample.values[k]; break;
      case Reduction::latest: sums_.values[k] = sample.values[k]; break;
      case Reduction::largest: sums_.values[k] = std::max(sums_.values[k], sample.values[k]); break;
      case Reduction::derived: break;
    }
  }
  ++samples_;
}

Measurement RowAverager::finish(const MeasureScale& scale) {
  require(samples_ > 0, "a row needs at least one sample");
  Measurement row = sums_;
  for (int k = 0; k < observable_count; ++k)
    if (observable_table[k].reduction == Reduction::mean) row.values[k] /= samples_;
  complete(row, scale);
  *this = RowAverager{};
  return row;
}

void RowAverager::save(Archive& archive) const {
  archive.reals["run.row_sums"].assign(sums_.values.begin(), sums_.values.end());
  archive.integers["run.row_samples"] = {samples_};
}

void RowAverager::restore(const Archive& archive) {
  const auto& sums = real_column(archive, "run.row_sums");
  if (sums.size() != observable_count) throw InputError("the checkpoint measures other observables than this version");
  std::copy(sums.begin(), sums.end(), sums_.values.begin());
  samples_ = static_cast<int>(integer_column(archive, "run.row_samples").at(0));
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

Averages averages(const TimeSeries& series, double average_from) {
  Averages result;
  if (series.rows.empty()) return result;
  require(average_from >= 0 && average_from < 1, "averages start at a fraction of the run below 1");
  result.from = average_from * series.rows.back()[Observable::time];
  for (int k = 0; k < observable_count; ++k) {
    const auto observable = static_cast<Observable>(k);
    const std::vector<double> values = series.column(observable, result.from);
    result.rows = static_cast<int>(values.size());
    if (observable == Observable::mu_star)
      result.values[k] = ratio_of_means(series.column(Observable::sigma_xy, result.from),
                                        series.column(Observable::sigma_yy, result.from));
    else if (info(observable).reduction == Reduction::largest)
      result.values[k] = {*std::max_element(values.begin(), values.end()), 0};
    else
      result.values[k] = block_average(values);
  }
  return result;
}

CsvTable to_table(const TimeSeries& series) {
  CsvTable table;
  for (int k = 0; k < observable_count; ++k) {
    if (!shown(static_cast<Observable>(k), series.dimension)) continue;
    table.comments.push_back(fmt::format("{}: {}", observable_table[k].name, observable_table[k].meaning));
    table.columns.push_back({std::string(observable_table[k].name), ""});
  }
  for (const Measurement& row : series.rows) {
    std::vector<CsvCell>& cells = table.rows.emplace_back();
    for (int k = 0; k < observable_count; ++k)
      if (shown(static_cast<Observable>(k), series.dimension))
        cells.push_back(std::isnan(row.values[k]) ? CsvCell() : CsvCell(row.values[k]));
  }
  return table;
}

}  // namespace galet
