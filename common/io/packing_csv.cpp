#include "common/io/packing_csv.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "common/core/error.hpp"
#include "common/io/csv.hpp"
#include "common/io/files.hpp"

namespace galet {

namespace {

using Names = std::vector<std::string>;

template <int D>
Names position_names() {
  return D == 2 ? Names{"x", "y"} : Names{"x", "y", "z"};
}
template <int D>
Names velocity_names() {
  return D == 2 ? Names{"vx", "vy"} : Names{"vx", "vy", "vz"};
}
template <int D>
Names spin_names() {
  return D == 2 ? Names{"wz"} : Names{"wx", "wy", "wz"};
}

/// The numbers after "key:" in the first comment that starts so. `count` of them must be there.
std::optional<std::vector<double>> numbers_of_comment(const NumberTable& table, const std::string& file,
                                                      std::string_view key, int count) {
  for (const std::string& comment : table.comments) {
    if (!comment.starts_with(key) || !comment.substr(key.size()).starts_with(':')) continue;
    std::vector<double> values;
    for (const Word& word : split_words(std::string_view(comment).substr(key.size() + 1)))
      if (const std::optional<double> value = parse_real(word.text)) values.push_back(*value);
    if (static_cast<int>(values.size()) != count)
      throw InputError(
          {Mistake{file, 0, 0, fmt::format("the comment '{}' must hold {} numbers after '{}:'", comment, count, key)}});
    return values;
  }
  return std::nullopt;
}

template <int D>
void read_cell(const NumberTable& table, const std::string& file, PackingFile<D>& packing) {
  packing.sample.cell.periodic.fill(true);
  if (const auto flags = numbers_of_comment(table, file, "periodic", D))
    for (int a = 0; a < D; ++a) packing.sample.cell.periodic[a] = (*flags)[a] != 0;
  const auto box = numbers_of_comment(table, file, "cell", D * D);
  if (!box) return;
  packing.has_cell = true;
  for (int a = 0; a < D; ++a)
    for (int b = 0; b < D; ++b) packing.sample.cell.box(a, b) = (*box)[a * D + b];
  const double volume = packing.sample.cell.volume();
  if (!(volume > 0 && std::isfinite(volume)))
    throw InputError({Mistake{file, 0, 0, "the cell vectors must span a volume above 0 (right-handed)"}});
}

/// Which column of the table holds what; -1 when it is absent.
template <int D>
class Header {
 public:
  explicit Header(const NumberTable& table, const std::string& file, std::vector<Mistake>& mistakes) : table_(table) {
    const auto indices = [&](const Names& names) {
      std::vector<int> columns;
      for (const std::string& name : names) columns.push_back(table.find(name).value_or(-1));
      known_.insert(known_.end(), names.begin(), names.end());
      return columns;
    };
    position = indices(position_names<D>());
    velocity = indices(velocity_names<D>());
    spin = indices(spin_names<D>());
    diameter = indices({"diameter"})[0];
    mass = indices({"mass"})[0];
    material = indices({"material"})[0];
    for (int needed : {position[0], position[1], position[D - 1], diameter}) {
      if (needed >= 0) continue;
      mistakes.push_back(
          {file, 0, 0,
           fmt::format("a packing in {}D needs the columns {},diameter", D, fmt::join(position_names<D>(), ","))});
      break;
    }
    for (const Names& group : {velocity_names<D>(), spin_names<D>()}) check_group(group, file, mistakes);
    for (int column = 0; column < static_cast<int>(table.columns.size()); ++column) {
      const std::string& name = table.columns[column].name;
      if (std::find(known_.begin(), known_.end(), name) == known_.end())
        mistakes.push_back(table.mistake(
            column, fmt::format("unknown column '{}'; known in {}D: {}", name, D, fmt::join(known_, ", "))));
    }
  }

  std::vector<int> position, velocity, spin;
  int diameter = -1, mass = -1, material = -1;

 private:
  /// The components of a vector are all there or none is.
  void check_group(const Names& names, const std::string& file, std::vector<Mistake>& mistakes) const {
    std::size_t present = 0;
    for (const std::string& name : names) present += table_.find(name).has_value() ? 1 : 0;
    if (present != 0 && present != names.size())
      mistakes.push_back({file, 0, 0, fmt::format("the columns {} go together", fmt::join(names, ", "))});
  }

  const NumberTable& table_;
  Names known_;
};

template <int D>
void read_grain(const NumberTable& table, const Header<D>& header, int row, Sample<D>& sample) {
  for (int a = 0; a < D; ++a) {
    sample.position[row][a] = table.at(row, header.position[a]);
    if (header.velocity[0] >= 0) sample.velocity[row][a] = table.at(row, header.velocity[a]);
  }
  if (header.spin[0] >= 0) {
    if constexpr (D == 2)
      sample.spin[row] = table.at(row, header.spin[0]);
    else
      for (int a = 0; a < D; ++a) sample.spin[row][a] = table.at(row, header.spin[a]);
  }
  sample.radius[row] = table.at(row, header.diameter) / 2;
  if (header.mass >= 0) sample.mass[row] = table.at(row, header.mass);
  if (header.material >= 0) sample.material[row] = static_cast<int>(table.at(row, header.material));
}

/// Every value is finite; diameters and masses are above 0.
template <int D>
void check_values(const NumberTable& table, const Header<D>& header, std::vector<Mistake>& mistakes) {
  constexpr std::size_t most_mistakes = 20;
  for (int row = 0; row < table.rows(); ++row) {
    for (int column = 0; column < static_cast<int>(table.columns.size()); ++column) {
      if (mistakes.size() >= most_mistakes) return;
      const double value = table.at(row, column);
      const bool positive = column == header.diameter || column == header.mass;
      if (!std::isfinite(value))
        mistakes.push_back(table.mistake(row, column, "expected a finite number"));
      else if (positive && value <= 0)
        mistakes.push_back(
            table.mistake(row, column, fmt::format("the {} must be above 0", table.columns[column].name)));
      else if (column == header.material && !(value >= 0 && value == std::floor(value) && value < 1000))
        mistakes.push_back(table.mistake(row, column, "expected the number of a material: 0, 1, ..."));
    }
  }
}

}  // namespace

template <int D>
PackingFile<D> parse_packing_csv(std::string_view text, const std::string& name) {
  const NumberTable table = parse_csv(text, name);
  std::vector<Mistake> mistakes;
  const Header<D> header(table, name, mistakes);
  if (table.rows() == 0) mistakes.push_back({name, 0, 0, "the packing has no grains"});
  check_values<D>(table, header, mistakes);
  if (!mistakes.empty()) throw InputError(mistakes);

  PackingFile<D> packing;
  read_cell<D>(table, name, packing);
  packing.has_mass = header.mass >= 0;
  packing.sample.resize(table.rows());
  for (int row = 0; row < table.rows(); ++row) read_grain<D>(table, header, row, packing.sample);
  return packing;
}

template <int D>
PackingFile<D> read_packing_csv(const std::string& path) {
  return parse_packing_csv<D>(read_file(path), path);
}

template <int D>
void write_packing_csv(const std::string& path, const Sample<D>& sample) {
  CsvTable table;
  std::string cell = "cell:", periodic = "periodic:";
  for (int a = 0; a < D; ++a) {
    for (int b = 0; b < D; ++b) cell += fmt::format(" {}", sample.cell.box(a, b));
    periodic += sample.cell.periodic[a] ? " 1" : " 0";
  }
  table.comments = {"packing written by galet; box matrix row by row, cell vectors are its columns", cell, periodic};
  for (const Names& names : {position_names<D>(), Names{"diameter", "mass"}, velocity_names<D>(), spin_names<D>()})
    for (const std::string& name : names) table.columns.push_back({name, ""});
  // Most packings are of one material: they do without the column.
  const bool mixed = std::any_of(sample.material.begin(), sample.material.end(), [](int k) { return k != 0; });
  if (mixed) table.columns.push_back({"material", ""});
  for (int i = 0; i < sample.count(); ++i) {
    std::vector<CsvCell> row(sample.position[i].begin(), sample.position[i].end());
    row.insert(row.end(), {CsvCell(2 * sample.radius[i]), CsvCell(sample.mass[i])});
    row.insert(row.end(), sample.velocity[i].begin(), sample.velocity[i].end());
    if constexpr (D == 2)
      row.emplace_back(sample.spin[i]);
    else
      row.insert(row.end(), sample.spin[i].begin(), sample.spin[i].end());
    if (mixed) row.emplace_back(static_cast<double>(sample.material[i]));
    table.rows.push_back(std::move(row));
  }
  write_csv(path, table);
}

template PackingFile<2> read_packing_csv<2>(const std::string&);
template PackingFile<3> read_packing_csv<3>(const std::string&);
template PackingFile<2> parse_packing_csv<2>(std::string_view, const std::string&);
template PackingFile<3> parse_packing_csv<3>(std::string_view, const std::string&);
template void write_packing_csv<2>(const std::string&, const Sample<2>&);
template void write_packing_csv<3>(const std::string&, const Sample<3>&);

}  // namespace galet
