#include "benchmarks/work_precision/rows.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

#include <fmt/format.h>

#include "common/core/error.hpp"
#include "common/io/files.hpp"
#include "src/engines.hpp"

namespace galet::precision {

namespace {

constexpr const char* header =
    "class,engine,kappa,steps_per_contact,dt,tolerance,seconds,steps,sweeps,missed,extent,quantities,quantity,noise,"
    "values";
constexpr std::size_t cells = 15;

std::vector<std::string> split(const std::string& text, char mark) {
  std::vector<std::string> parts;
  std::istringstream in(text);
  for (std::string part; std::getline(in, part, mark);) parts.push_back(part);
  return parts;
}

std::string lines_of(const Row& row) {
  const Setting& s = row.setting;
  std::string text;
  for (const Quantity& quantity : row.quantities)
    text +=
        fmt::format("{},{},{},{},{},{},{:.6g},{},{},{},{},{},{},{:.6g},{:.10g}\n", row.scene, engine_name(s.engine),
                    s.kappa, s.steps_per_contact, s.dt, s.tolerance, row.seconds, row.steps, row.sweeps, row.missed,
                    row.extent, row.quantities.size(), quantity.name, quantity.noise, fmt::join(quantity.values, ";"));
  return text;
}

Quantity quantity_of(const std::vector<std::string>& cell) {
  Quantity quantity{cell[12], {}, std::stod(cell[13])};
  for (const std::string& value : split(cell[14], ';')) quantity.values.push_back(std::stod(value));
  return quantity;
}

Row row_of(const std::vector<std::string>& cell) {
  return {
      .scene = cell[0],
      .setting = {engine_kind(cell[1]), std::stod(cell[2]), std::stod(cell[3]), std::stod(cell[4]), std::stod(cell[5])},
      .seconds = std::stod(cell[6]),
      .steps = std::stol(cell[7]),
      .sweeps = std::stol(cell[8]),
      .missed = std::stol(cell[9]),
      .extent = std::stod(cell[10]),
      .quantities = {}};
}

}  // namespace

Setting md_setting(double kappa, double steps_per_contact) { return {EngineKind::md, kappa, steps_per_contact, 0, 0}; }
Setting cd_setting(double dt, double tolerance) { return {EngineKind::cd, 0, 0, dt, tolerance}; }

RowFile::RowFile(std::string path) : path_(std::move(path)) {
  std::ifstream in(path_);
  std::string line;
  if (!std::getline(in, line)) return;
  if (line != header) throw InputError(fmt::format("{} has other columns than this program writes", path_));
  std::vector<std::size_t> expected;
  while (std::getline(in, line)) {
    const std::vector<std::string> cell = split(line, ',');
    if (cell.size() != cells || in.eof()) break;
    const Row row = row_of(cell);
    if (rows_.empty() || rows_.back().scene != row.scene || !(rows_.back().setting == row.setting)) {
      rows_.push_back(row);
      expected.push_back(std::stoul(cell[11]));
    }
    rows_.back().quantities.push_back(quantity_of(cell));
  }
  if (!rows_.empty() && rows_.back().quantities.size() != expected.back()) rows_.pop_back();
}

bool RowFile::has(const std::string& scene, const Setting& setting) const {
  return std::any_of(rows_.begin(), rows_.end(),
                     [&](const Row& row) { return row.scene == scene && row.setting == setting; });
}

void RowFile::add(const Row& row) {
  rows_.push_back(row);
  std::string text = std::string(header) + "\n";
  for (const Row& each : rows_) text += lines_of(each);
  write_file(path_, text);
}

}  // namespace galet::precision
