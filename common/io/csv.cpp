#include "common/io/csv.hpp"

#include <algorithm>
#include <limits>

#include <fmt/format.h>

#include "common/io/files.hpp"

namespace galet {

namespace {

constexpr std::size_t most_mistakes = 20;

/// A word as a cell: in quotes when it holds what would end the cell or the line.
std::string quoted_cell(const std::string& text) {
  if (text.find_first_of(",\"\n\r") == std::string::npos && !text.starts_with('#')) return text;
  std::string result = "\"";
  for (char letter : text) {
    if (letter == '"') result += '"';
    result += letter;
  }
  return result + '"';
}

struct CellText {
  std::string operator()(std::monostate) const { return {}; }
  std::string operator()(double value) const { return fmt::format("{}", value); }
  std::string operator()(std::int64_t value) const { return fmt::format("{}", value); }
  std::string operator()(const std::string& text) const { return quoted_cell(text); }
};

/// One cell of a line: its text without quotes and blanks around, and the column (from 1) where it starts.
struct CellPlace {
  std::string text;
  int column = 1;
};

/// The cells of one line. A quoted cell may hold commas and doubled quotes, but must end on its line.
std::vector<CellPlace> split_cells(std::string_view line) {
  std::vector<CellPlace> cells;
  std::size_t k = 0;
  while (true) {
    while (k < line.size() && (line[k] == ' ' || line[k] == '\t')) ++k;
    CellPlace cell{{}, static_cast<int>(k) + 1};
    if (k < line.size() && line[k] == '"') {
      for (++k; k < line.size(); ++k) {
        if (line[k] == '"' && (++k >= line.size() || line[k] != '"')) break;
        cell.text += line[k];
      }
    }
    const std::size_t end = std::min(line.find(',', k), line.size());
    cell.text += trim(line.substr(std::min(k, end), end - std::min(k, end)));
    cells.push_back(cell);
    if (end == line.size()) return cells;
    k = end + 1;
  }
}

/// "name [unit]" -> {name, unit}
CsvColumn parse_column(const std::string& text) {
  const std::size_t open = text.rfind(" [");
  if (open == std::string::npos || !text.ends_with(']')) return {text, ""};
  return {std::string(trim(text.substr(0, open))), text.substr(open + 2, text.size() - open - 3)};
}

}  // namespace

void write_csv(const std::string& path, const CsvTable& table) {
  std::string text;
  for (const std::string& comment : table.comments)
    for (std::string_view line : split_lines(comment)) text += fmt::format("# {}\n", line);
  const auto separator = [](std::size_t k) { return k == 0 ? "" : ","; };
  for (std::size_t k = 0; k < table.columns.size(); ++k) {
    const CsvColumn& column = table.columns[k];
    text += separator(k);
    text += quoted_cell(column.unit.empty() ? column.name : fmt::format("{} [{}]", column.name, column.unit));
  }
  text += '\n';
  for (const std::vector<CsvCell>& row : table.rows) {
    require(row.size() == table.columns.size(), "every row of a table needs one cell per column");
    for (std::size_t k = 0; k < row.size(); ++k) {
      text += separator(k);
      text += std::visit(CellText{}, row[k]);
    }
    text += '\n';
  }
  write_file(path, text);
}

std::optional<int> NumberTable::find(std::string_view name) const {
  const auto found = std::find_if(columns.begin(), columns.end(), [&](const CsvColumn& c) { return c.name == name; });
  if (found == columns.end()) return std::nullopt;
  return static_cast<int>(found - columns.begin());
}

Mistake NumberTable::mistake(int row, int column, const std::string& message) const {
  return {file_, line_[row], place_[index(row, column)], message};
}

Mistake NumberTable::mistake(int column, const std::string& message) const {
  return {file_, header_line_, header_place_[column], message};
}

NumberTable parse_csv(std::string_view text, const std::string& name, EmptyCells empty) {
  NumberTable table;
  table.file_ = name;
  std::vector<Mistake> mistakes;
  int number = 0;
  const auto report = [&](int column, const std::string& message) {
    mistakes.push_back({name, number, column, message});
  };
  for (std::string_view line : split_lines(text)) {
    ++number;
    if (mistakes.size() >= most_mistakes) break;
    const std::string_view content = trim(line);
    if (content.empty()) continue;
    if (content.starts_with('#')) {
      table.comments.emplace_back(trim(content.substr(1)));
      continue;
    }
    const std::vector<CellPlace> cells = split_cells(line);
    if (table.columns.empty()) {
      table.header_line_ = number;
      for (const CellPlace& cell : cells) {
        const CsvColumn column = parse_column(cell.text);
        if (column.name.empty()) report(cell.column, "a column without a name");
        if (parse_real(column.name))
          report(cell.column, "expected the name of a column, found the number " + cell.text);
        if (table.find(column.name)) report(cell.column, "the column '" + column.name + "' appears twice");
        table.columns.push_back(column);
        table.header_place_.push_back(cell.column);
      }
      continue;
    }
    if (cells.size() != table.columns.size()) {
      report(1, fmt::format("expected {} cells as in the header, found {}", table.columns.size(), cells.size()));
      continue;
    }
    table.line_.push_back(number);
    for (const CellPlace& cell : cells) {
      std::optional<double> value = parse_real(cell.text);
      if (cell.text.empty() && empty == EmptyCells::not_a_number) value = std::numeric_limits<double>::quiet_NaN();
      if (!value) report(cell.column, "expected a number, found '" + cell.text + "'");
      table.value_.push_back(value.value_or(0));
      table.place_.push_back(cell.column);
    }
  }
  if (table.columns.empty()) mistakes.push_back({name, 0, 0, "the file has no header line"});
  if (!mistakes.empty()) throw InputError(mistakes);
  return table;
}

NumberTable read_csv(const std::string& path, EmptyCells empty) { return parse_csv(read_file(path), path, empty); }

}  // namespace galet
