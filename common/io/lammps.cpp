#include "common/io/lammps.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <optional>

#include <fmt/format.h>

#include "common/core/error.hpp"
#include "common/geometry/wrap.hpp"
#include "common/io/files.hpp"

namespace galet {

namespace {

/// One grain as the file gives it.
struct Atom {
  long type = 1;
  double diameter = 0, density = 0;
  Vec<3> position = Vec<3>::Zero(), velocity = Vec<3>::Zero(), spin = Vec<3>::Zero();
};

/// Reads the file line by line into plain numbers; what they mean for a sample is decided afterwards.
class DataFile {
 public:
  DataFile(std::string_view text, const std::string& name) : name_(name), lines_(split_lines(text)) {
    if (lines_.empty()) fail(0, 0, "the file is empty");
    line_ = 1;  // the first line is a title, whatever it holds
    each_line([this](const Words& words) { read_head_line(words); });
    while (line_ < lines_.size()) read_section();
    finish();
  }

  const std::map<long, Atom>& atoms() const { return atoms_; }
  const Vec<3>& low() const { return low_; }
  const Mat<3>& box() const { return box_; }
  [[noreturn]] void fail(std::size_t line, int column, const std::string& message) const {
    throw InputError({Mistake{name_, static_cast<int>(line), column, message}});
  }

 private:
  using Words = std::vector<Word>;

  static std::string_view without_comment(std::string_view line) { return line.substr(0, line.find('#')); }
  /// Line number, from 1, of the line that was read last.
  std::size_t place() const { return line_; }
  [[noreturn]] void fail_at(const Word& word, const std::string& message) const { fail(place(), word.column, message); }

  double real(const Word& word) const {
    const std::optional<double> value = parse_real(word.text);
    if (!value || !std::isfinite(*value)) fail_at(word, fmt::format("expected a finite number, found '{}'", word.text));
    return *value;
  }
  long integer(const Word& word) const {
    const std::optional<long> value = parse_integer(word.text);
    if (!value) fail_at(word, fmt::format("expected a whole number, found '{}'", word.text));
    return *value;
  }
  static bool is_section(const Words& words) {
    return !words.empty() && std::isalpha(static_cast<unsigned char>(words[0].text[0])) != 0;
  }

  void read_head_line(const Words& words) {
    const auto ends_with = [&](std::size_t values, std::initializer_list<std::string_view> keys) {
      if (words.size() != values + keys.size()) return false;
      return std::equal(keys.begin(), keys.end(), words.begin() + static_cast<long>(values),
                        [](std::string_view key, const Word& word) { return key == word.text; });
    };
    constexpr std::array<std::array<std::string_view, 2>, 3> bounds = {
        {{"xlo", "xhi"}, {"ylo", "yhi"}, {"zlo", "zhi"}}};
    for (int a = 0; a < 3; ++a) {
      if (!ends_with(2, {bounds[a][0], bounds[a][1]})) continue;
      low_[a] = real(words[0]);
      box_(a, a) = real(words[1]) - low_[a];
      if (!(box_(a, a) > 0)) fail_at(words[1], fmt::format("{} must be above {}", bounds[a][1], bounds[a][0]));
      bounded_[a] = true;
      return;
    }
    if (ends_with(3, {"xy", "xz", "yz"})) {
      box_(0, 1) = real(words[0]), box_(0, 2) = real(words[1]), box_(1, 2) = real(words[2]);
    } else if (ends_with(1, {"atoms"})) {
      expected_ = integer(words[0]);
    } else {
      integer(words[0]);  // "1 atom types", "0 bonds": counts that a sample has no use for
    }
  }

  void read_section() {
    const std::string_view line = lines_[line_++];
    const Words words = split_words(without_comment(line));
    if (words.empty()) return;
    const std::string title(trim(without_comment(line)));
    constexpr std::array skipped = {"Masses", "Pair Coeffs", "PairIJ Coeffs", "Atom Type Labels"};
    if (title == "Atoms")
      read_atoms(line);
    else if (title == "Velocities")
      each_line([this](const Words& row) { read_velocity(row); });
    else if (std::find(skipped.begin(), skipped.end(), title) != skipped.end())
      each_line([](const Words&) {});
    else
      fail_at(words[0], fmt::format("the section '{}' is not supported: expected Atoms or Velocities", title));
  }

  /// Calls read(words) on each line up to the next section's title or the end.
  template <class Read>
  void each_line(const Read& read) {
    while (line_ < lines_.size()) {
      const Words words = split_words(without_comment(lines_[line_]));
      if (is_section(words)) return;
      ++line_;
      if (!words.empty()) read(words);
    }
  }

  void read_atoms(std::string_view title) {
    const std::size_t mark = title.find('#');
    const std::string_view style = mark == std::string_view::npos ? "sphere" : trim(title.substr(mark + 1));
    if (style != "sphere")
      fail(place(), static_cast<int>(mark) + 1, fmt::format("the atom style '{}' is not supported: use sphere", style));
    has_atoms_ = true;
    each_line([this](const Words& words) { read_atom(words); });
  }

  void read_atom(const Words& words) {
    if (words.size() != 7 && words.size() != 10)
      fail_at(words[0],
              fmt::format("expected 'id type diameter density x y z [ix iy iz]', found {} values", words.size()));
    Atom atom;
    atom.type = integer(words[1]);
    if (atom.type < 1) fail_at(words[1], "an atom type must be at least 1");
    atom.diameter = real(words[2]);
    atom.density = real(words[3]);
    if (!(atom.diameter > 0)) fail_at(words[2], "a diameter must be above 0");
    if (!(atom.density > 0)) fail_at(words[3], "a density must be above 0");
    for (int a = 0; a < 3; ++a) atom.position[a] = real(words[4 + a]);
    if (!atoms_.emplace(integer(words[0]), atom).second)
      fail_at(words[0], fmt::format("the atom {} appears twice", words[0].text));
  }

  void read_velocity(const Words& words) {
    if (words.size() != 7)
      fail_at(words[0], fmt::format("expected 'id vx vy vz wx wy wz', found {} values", words.size()));
    Motion motion{place(), words[0].column, Vec<3>::Zero(), Vec<3>::Zero()};
    for (int a = 0; a < 3; ++a) motion.velocity[a] = real(words[1 + a]), motion.spin[a] = real(words[4 + a]);
    if (!motions_.emplace(integer(words[0]), motion).second)
      fail_at(words[0], fmt::format("the velocity of atom {} appears twice", words[0].text));
  }

  void finish() {
    if (!has_atoms_) fail(0, 0, "the file has no section 'Atoms'");
    for (int a = 0; a < 3; ++a)
      if (!bounded_[a]) fail(0, 0, fmt::format("the file does not give the box along {}", "xyz"[a]));
    if (!expected_) fail(0, 0, "the file does not say how many atoms it has ('N atoms')");
    if (*expected_ != static_cast<long>(atoms_.size()))
      fail(0, 0, fmt::format("the file announces {} atoms and has {}", *expected_, atoms_.size()));
    for (const auto& [id, motion] : motions_) {
      const auto atom = atoms_.find(id);
      if (atom == atoms_.end()) fail(motion.line, motion.column, fmt::format("there is no atom {}", id));
      atom->second.velocity = motion.velocity;
      atom->second.spin = motion.spin;
    }
  }

  struct Motion {
    std::size_t line;
    int column;
    Vec<3> velocity, spin;
  };

  std::string name_;
  std::vector<std::string_view> lines_;
  std::size_t line_ = 0;  ///< lines read so far
  std::map<long, Atom> atoms_;
  std::map<long, Motion> motions_;
  std::optional<long> expected_;
  Vec<3> low_ = Vec<3>::Zero();
  Mat<3> box_ = Mat<3>::Zero();
  std::array<bool, 3> bounded_{};
  bool has_atoms_ = false;
};

template <int D>
Sample<D> make_sample(const DataFile& file, const std::array<bool, D>& periodic) {
  Sample<D> sample;
  sample.cell.box = file.box().topLeftCorner<D, D>();
  sample.cell.periodic = periodic;
  sample.resize(static_cast<int>(file.atoms().size()));
  const Mat<D> inverse = sample.cell.box.inverse();
  int i = 0;
  for (const auto& [id, atom] : file.atoms()) {
    const Vec<D> inside = (atom.position - file.low()).template head<D>();
    sample.position[i] = wrapped_position<D>(sample.cell, inverse, inside);
    sample.velocity[i] = atom.velocity.template head<D>();
    if constexpr (D == 2)
      sample.spin[i] = atom.spin.z();
    else
      sample.spin[i] = atom.spin;
    sample.radius[i] = atom.diameter / 2;
    sample.material[i] = static_cast<int>(atom.type) - 1;
    sample.mass[i] = atom.density * grain_volume<D>(atom.diameter);
    ++i;
  }
  return sample;
}

template <int D>
Vec<3> in_space(const Vec<D>& v) {
  Vec<3> result = Vec<3>::Zero();
  result.template head<D>() = v;
  return result;
}

}  // namespace

template <int D>
Sample<D> parse_lammps_data(std::string_view text, const std::string& name, const std::array<bool, D>& periodic) {
  return make_sample<D>(DataFile(text, name), periodic);
}

template <int D>
Sample<D> read_lammps_data(const std::string& path, const std::array<bool, D>& periodic) {
  return parse_lammps_data<D>(read_file(path), path, periodic);
}

template <int D>
void write_lammps_data(const std::string& path, const Sample<D>& sample) {
  Mat<3> box = Mat<3>::Zero();
  // A 2D run of LAMMPS wants a thin box around z = 0.
  const double thickness = sample.count() == 0 ? 1 : 2 * *std::max_element(sample.radius.begin(), sample.radius.end());
  box(2, 2) = thickness;
  box.topLeftCorner<D, D>() = sample.cell.box;
  for (int a = 1; a < D; ++a)
    for (int b = 0; b < a; ++b)
      require(box(a, b) == 0, "a LAMMPS data file needs an upper triangular cell: rotate the sample first");
  const double low_z = D == 2 ? -thickness / 2 : 0;

  const int types = sample.count() == 0 ? 1 : 1 + *std::max_element(sample.material.begin(), sample.material.end());
  std::string text =
      fmt::format("LAMMPS data file written by galet\n\n{} atoms\n{} atom types\n\n", sample.count(), types);
  text += fmt::format("0 {} xlo xhi\n0 {} ylo yhi\n{} {} zlo zhi\n", box(0, 0), box(1, 1), low_z, low_z + box(2, 2));
  if (box(0, 1) != 0 || box(0, 2) != 0 || box(1, 2) != 0)
    text += fmt::format("{} {} {} xy xz yz\n", box(0, 1), box(0, 2), box(1, 2));
  text += "\nAtoms # sphere\n\n";
  for (int i = 0; i < sample.count(); ++i) {
    const double diameter = 2 * sample.radius[i];
    const Vec<3> x = in_space<D>(sample.position[i]);
    text += fmt::format("{} {} {} {} {} {} {}\n", i + 1, sample.material[i] + 1, diameter,
                        sample.mass[i] / grain_volume<D>(diameter), x.x(), x.y(), x.z());
  }
  text += "\nVelocities\n\n";
  for (int i = 0; i < sample.count(); ++i) {
    const Vec<3> v = in_space<D>(sample.velocity[i]);
    Vec<3> w = Vec<3>::Zero();
    if constexpr (D == 2)
      w.z() = sample.spin[i];
    else
      w = sample.spin[i];
    text += fmt::format("{} {} {} {} {} {} {}\n", i + 1, v.x(), v.y(), v.z(), w.x(), w.y(), w.z());
  }
  write_file(path, text);
}

template Sample<2> read_lammps_data<2>(const std::string&, const std::array<bool, 2>&);
template Sample<3> read_lammps_data<3>(const std::string&, const std::array<bool, 3>&);
template Sample<2> parse_lammps_data<2>(std::string_view, const std::string&, const std::array<bool, 2>&);
template Sample<3> parse_lammps_data<3>(std::string_view, const std::string&, const std::array<bool, 3>&);
template void write_lammps_data<2>(const std::string&, const Sample<2>&);
template void write_lammps_data<3>(const std::string&, const Sample<3>&);

}  // namespace galet
