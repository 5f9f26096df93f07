// Tables as CSV files: optional comment lines ("# ..."), one header line ("name [unit],..."), one line per row.
// Numbers are written in the shortest form that reads back to the same bits.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "common/core/error.hpp"

namespace galet {

struct CsvColumn {
  std::string name;
  std::string unit;  ///< empty: a pure number or a word

  bool operator==(const CsvColumn&) const = default;
};

/// monostate: an empty cell (no value).
using CsvCell = std::variant<std::monostate, double, std::int64_t, std::string>;

struct CsvTable {
  std::vector<std::string> comments;
  std::vector<CsvColumn> columns;
  std::vector<std::vector<CsvCell>> rows;
};

/// Writes the table whole or not at all (see write_file). Every row must have as many cells as there are columns.
void write_csv(const std::string& path, const CsvTable& table);

enum class EmptyCells {
  mistakes,     ///< a table that is input: each cell needs its number
  not_a_number  ///< a table that write_csv wrote: an empty cell is a value that has no meaning
};

/// A table of numbers as read, with the places where they stood.
class NumberTable {
 public:
  std::vector<std::string> comments;  ///< without the "#" and the blanks around
  std::vector<CsvColumn> columns;

  int rows() const { return static_cast<int>(line_.size()); }
  double at(int row, int column) const { return value_[index(row, column)]; }
  /// The column called `name`, or none.
  std::optional<int> find(std::string_view name) const;
  /// A mistake found in a cell, at its place in the file.
  Mistake mistake(int row, int column, const std::string& message) const;
  /// A mistake found in a column's name.
  Mistake mistake(int column, const std::string& message) const;

 private:
  friend NumberTable parse_csv(std::string_view, const std::string&, EmptyCells);
  std::size_t index(int row, int column) const { return row * columns.size() + column; }

  std::string file_;
  std::vector<double> value_;  ///< row by row
  std::vector<int> place_;     ///< of each value: where its text starts in its line
  std::vector<int> line_;      ///< of each row
  int header_line_ = 0;
  std::vector<int> header_place_;
};

/// Reads a table of numbers. Throws InputError with every mistake (the first 20 of them) at file:line:column.
NumberTable read_csv(const std::string& path, EmptyCells empty = EmptyCells::mistakes);

/// The same for a text; `name` stands for the file in messages.
NumberTable parse_csv(std::string_view text, const std::string& name, EmptyCells empty = EmptyCells::mistakes);

}  // namespace galet
