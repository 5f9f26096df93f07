#include "src/text_table.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "common/core/error.hpp"

namespace galet {

namespace {

/// Letters that a UTF-8 text shows.
std::size_t width(const std::string& text) {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char byte) { return (byte & 0xC0) != 0x80; }));
}

}  // namespace

std::string with_error(const Estimate& estimate) {
  if (!std::isfinite(estimate.value)) return "-";
  if (!(estimate.error > 0) || !std::isfinite(estimate.error)) return fmt::format("{:.4f}", estimate.value);
  // An error far below the value: six digits of the value, and the error as it is.
  if (estimate.error < 1e-6 * std::abs(estimate.value))
    return fmt::format("{:.6g} ±{:.1g}", estimate.value, estimate.error);
  const int decimals = std::clamp(1 - static_cast<int>(std::floor(std::log10(estimate.error))), 0, 9);
  return fmt::format("{:.{}f} ±{:.{}f}", estimate.value, decimals, estimate.error, decimals);
}

std::string short_number(double value, int digits) {
  return std::isnan(value) ? "-" : fmt::format("{:.{}g}", value, digits);
}

std::string duration_text(double seconds) {
  const long whole = std::lround(std::max(0.0, seconds));
  if (whole < 60) return fmt::format("{} s", whole);
  if (whole < 3600) return fmt::format("{} min {} s", whole / 60, whole % 60);
  if (whole < 48 * 3600) return fmt::format("{} h {} min", whole / 3600, whole / 60 % 60);
  return fmt::format("{} days", whole / 86400);
}

void TextTable::add(std::vector<std::string> row) {
  require(row.size() == rows_[0].size(), "a table's rows are as long as its header");
  rows_.push_back(std::move(row));
}

std::string TextTable::text(const std::string& indent) const {
  std::vector<std::size_t> widths(rows_[0].size(), 0);
  for (const auto& row : rows_)
    for (std::size_t k = 0; k < row.size(); ++k) widths[k] = std::max(widths[k], width(row[k]));
  std::string text;
  for (const auto& row : rows_) {
    std::string line = indent;
    for (std::size_t k = 0; k < row.size(); ++k) {
      const std::string padding(widths[k] - width(row[k]), ' ');
      line += k == 0 ? row[k] + padding : "  " + padding + row[k];
    }
    line.erase(line.find_last_not_of(' ') + 1);
    text += line + '\n';
  }
  return text;
}

}  // namespace galet
