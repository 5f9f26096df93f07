// Numbers and tables as text for a terminal.
#pragma once

#include <string>
#include <vector>

#include "common/measure/block_average.hpp"

namespace galet {

/// "0.3871 ±0.0012": two digits of the error; without a known error four digits of the value. "-" for NaN.
std::string with_error(const Estimate& estimate);

/// A number in the shortest common form with `digits` significant digits; "-" for NaN.
std::string short_number(double value, int digits = 4);

/// "35 s", "4 min 10 s", "2 h 5 min".
std::string duration_text(double seconds);

/// Columns aligned on the right, two blanks apart, the first on the left.
class TextTable {
 public:
  explicit TextTable(std::vector<std::string> header) : rows_{std::move(header)} {}
  void add(std::vector<std::string> row);
  std::string text(const std::string& indent = "") const;

 private:
  std::vector<std::vector<std::string>> rows_;
};

}  // namespace galet
