// One row per listed pair, in blocks of eight: what the contact pass works on (kernel/view.hpp).
#pragma once

#include <algorithm>
#include <array>
#include <bit>

#include "common/core/archive_columns.hpp"
#include "common/core/column.hpp"
#include "common/core/large_pages.hpp"
#include "common/core/layout.hpp"
#include "common/core/memory_use.hpp"
#include "common/core/parallel.hpp"
#include "common/core/types.hpp"
#include "common/neighbour/verlet_list.hpp"
#include "md/kernel/view.hpp"

namespace galet::md {

/// A cache line of doubles: what aligns the memory of the lanes.
struct alignas(64) Line {
  double value[8] = {};
};

/// Arrays that each step goes through.
template <class T>
using StepArray = std::vector<T, LargePages<T>>;

/// Lines one after the other as one array of doubles.
inline double* doubles(StepArray<Line>& lines) { return reinterpret_cast<double*>(lines.data()); }
inline const double* doubles(const StepArray<Line>& lines) { return reinterpret_cast<const double*>(lines.data()); }

/// What the pair of a row is doing.
enum class RowState : std::uint8_t { apart, touching, attracted /**< across a gap, by a cohesion of range D0 */ };

/// A row of a grain and a plane, and the record that stands for the plane.
struct PlaneRow {
  int row, grain, plane, record;
};

template <Layout Y>
class Contacts {
 public:
  static constexpr int D = Y.dim;
  using C = RowColumns<Y>;

  bool varying_stiffness = false;  ///< whether rows remember their stiffness

  std::size_t size() const { return rows_; }
  std::size_t block_count() const { return blocks_.size(); }
  RowBlock* blocks() { return blocks_.data(); }
  double* columns() { return doubles(columns_); }
  /// Of each block.
  std::size_t column_count() const { return static_cast<std::size_t>(C::count(varying_stiffness)); }
  const RowConstants* constants() const { return constants_.data(); }
  /// Whether the first block of constants serves all rows.
  bool equal_pairs() const { return equal_pairs_; }
  double* out() { return doubles(out_); }
  const double* out() const { return doubles(out_); }

  double& at(std::size_t row, int column) {
    return columns_[row / block_rows * column_count() + column].value[row % block_rows];
  }
  double at(std::size_t row, int column) const {
    return columns_[row / block_rows * column_count() + column].value[row % block_rows];
  }
  RowBlock& block_of(std::size_t row) { return blocks_[row / block_rows]; }
  double reach(std::size_t row) const { return constants_of(row).reach[row % block_rows]; }
  double coefficient(std::size_t row) const { return constants_of(row).coefficient[row % block_rows]; }

  /// Takes the constants of the rows from constants_of_row(row) -> {reach, coefficient, critical}; with `equal`, those
  /// of row 0 for all.
  template <class Constants>
  void set_constants(bool equal, Constants constants_of_row) {
    equal_pairs_ = equal;
    refill(constants_, equal ? 1 : blocks_.size(), RowConstants{});
    for (std::size_t row = 0; row < (equal ? std::min<std::size_t>(1, rows_) : rows_); ++row) {
      const std::array<double, 3> values = constants_of_row(row);
      RowConstants& block = constants_[row / block_rows];
      const auto put = [&](int k) {
        block.reach[k] = values[0], block.inverse_reach[k] = 1 / values[0];
        block.coefficient[k] = values[1], block.critical[k] = values[2];
      };
      if (equal)
        for (int k = 0; k < block_rows; ++k) put(k);
      else
        put(row % block_rows);
    }
  }
  int law(std::size_t row) const { return blocks_[row / block_rows].law[row % block_rows]; }

  RowState state(std::size_t row) const {
    const RowBlock& block = blocks_[row / block_rows];
    if (block.touching >> row % block_rows & 1) return RowState::touching;
    return block.attracted >> row % block_rows & 1 ? RowState::attracted : RowState::apart;
  }
  /// Number of touching pairs.
  std::size_t touching() const {
    std::size_t count = 0;
    for (const RowBlock& block : blocks_) count += static_cast<std::size_t>(std::popcount(block.touching));
    return count;
  }
  bool touches(std::size_t row) const { return state(row) == RowState::touching; }
  bool acts(std::size_t row) const { return state(row) != RowState::apart; }

  /// F on j; zero when apart.
  Vec<D> force(std::size_t row) const { return out_vector(row, 0); }
  /// |b|/(R_i+R_j) n x F: the torque on grain k of the pair is -R_k twist.
  Spin<D> twist(std::size_t row) const requires(Y.friction) { return out_spin(row, twist_place(Y)); }
  /// Rolling and pivoting torque on j.
  Spin<D> torque(std::size_t row) const requires(Y.rolling) { return out_spin(row, torque_place(Y)); }
  /// Stored elongation of the tangential spring.
  Spin<D> spring(std::size_t row) const requires(Y.friction) {
    if constexpr (D == 2)
      return at(row, C::spring);
    else
      return {at(row, C::spring), at(row, C::spring + 1), at(row, C::spring + 2)};
  }

  /// Takes over the rows of `old` that the rebuilt list still has. The caller fills in the constants of the rows.
  void carry(const Contacts& old, const VerletList<D>& list, int grains) {
    list_rows(list, grains);
    parallel_ranges(
        blocks_.size(),
        [&](std::size_t begin, std::size_t end) {
          for (std::size_t block = begin; block < end; ++block) {
            forget(block);
            for (std::size_t row = block * block_rows; row < std::min(rows_, (block + 1) * block_rows); ++row)
              carry_row(old, list, row);
          }
        },
        least_blocks);
  }

  /// Rows of each grain, see GrainView.
  const std::uint32_t* slots() const { return slots_.data(); }

  /// Without `listed`: the list counts its pairs.
  MemoryUse memory() const { return {bytes_of(slots_), bytes_of(blocks_, constants_, columns_, out_, plane_rows_), 0}; }

  const std::vector<PlaneRow>& plane_rows() const { return plane_rows_; }
  /// Records that the rows refer to.
  int record_count(int grains) const { return grains + 2 + static_cast<int>(plane_rows_.size()); }

  /// Lattice coordinates of the images that rows refer to, in the order of their `shift`.
  const std::vector<Image<D>>& images() const { return images_; }

  void save(Archive& archive) const {
    std::vector<std::int64_t>& states = archive.integers["contacts.state"];
    states.resize(rows_);
    for (std::size_t row = 0; row < rows_; ++row) states[row] = static_cast<std::int64_t>(state(row));
    each_part([&](const char* name, int size, auto value) {
      std::vector<double>& column = archive.reals[name];
      column.resize(rows_ * size);
      for (std::size_t row = 0; row < rows_; ++row)
        for (int k = 0; k < size; ++k) column[row * size + k] = value(*this, row, k);
    });
  }

  void restore(const Archive& archive, const VerletList<D>& list, int grains) {
    list_rows(list, grains);
    for (std::size_t block = 0; block < blocks_.size(); ++block) forget(block);
    const auto& states = integer_column(archive, "contacts.state");
    if (states.size() != rows_) throw InputError("column 'contacts.state' of the checkpoint has the wrong length");
    for (std::size_t row = 0; row < rows_; ++row) set_state(row, static_cast<RowState>(states[row]));
    each_part([&](const char* name, int size, auto value) {
      const std::vector<double>& column = real_column(archive, name);
      if (column.size() != rows_ * size)
        throw InputError(std::string("column '") + name + "' of the checkpoint has the wrong length");
      for (std::size_t row = 0; row < rows_; ++row)
        for (int k = 0; k < size; ++k) value(*this, row, k) = column[row * size + k];
    });
  }

 private:
  Vec<D> out_vector(std::size_t row, int first) const {
    const double* from = out() + row * out_size(Y) + first;
    return Eigen::Map<const Vec<D>>(from);
  }
  Spin<D> out_spin(std::size_t row, int first) const {
    if constexpr (D == 2)
      return out()[row * out_size(Y) + first];
    else
      return out_vector(row, first);
  }

  static constexpr std::size_t least_blocks = 64;  ///< fewer are not worth a thread

  void carry_row(const Contacts& old, const VerletList<D>& list, std::size_t row) {
    const int from = list.origin()[row];
    if (from < 0) return;
    const double sign = list.flipped(row) ? -1 : 1;
    carry_result(old, from, row, sign);  // of pairs apart too: zeros have signs
    if (!old.acts(from)) return;
    set_state(row, old.state(from));
    if constexpr (Y.friction) carry_memory(old, from, row, sign);
  }

  /// The last step's forces: what ends before the next pass needs them (laws/crossing.hpp).
  void carry_result(const Contacts& old, std::size_t from, std::size_t row, double sign) {
    const double* source = old.out() + from * out_size(Y);
    double* target = out() + row * out_size(Y);
    for (int k = 0; k < out_size(Y); ++k) {
      const bool twist = Y.friction && k >= twist_place(Y) && k < torque_place(Y);
      target[k] = (twist ? 1 : sign) * source[k];
    }
  }

  /// When i and j change places (`sign` -1), vectors and relative rotations change sign; the scalar spring of a disk
  /// contact and a rotation about the normal do not.
  void carry_memory(const Contacts& old, std::size_t from, std::size_t row, double sign) {
    const auto take = [&](int first, int last, double factor) {
      for (int column = first; column < last; ++column) at(row, column) = factor * old.at(from, column);
    };
    take(C::spring, C::rolling, D == 3 ? sign : 1);
    if constexpr (Y.rolling) take(C::rolling, C::pivoting, sign), take(C::pivoting, C::stiffness, 1);
    if (varying_stiffness) take(C::stiffness, C::stiffness + 1, 1);
  }

  /// Calls visit(name, components, value) for each quantity of a row that a checkpoint holds; value(contacts, row, k).
  template <class Visit>
  void each_part(Visit visit) const {
    const auto result = [&](const char* name, int first, int size) {
      visit(
          name, size, [first](auto& self, std::size_t row, int k) -> auto& {
            return self.out()[row * out_size(Y) + first + k];
          });
    };
    const auto memory = [&](const char* name, int first, int last) {
      visit(name, last - first,
            [first](auto& self, std::size_t row, int k) -> decltype(auto) { return self.at(row, first + k); });
    };
    result("contacts.force", 0, D);
    if constexpr (Y.friction) {
      result("contacts.twist", twist_place(Y), D == 2 ? 1 : 3);
      memory("contacts.spring", C::spring, C::rolling);
      if (varying_stiffness) memory("contacts.stiffness", C::stiffness, C::stiffness + 1);
    }
    if constexpr (Y.rolling) {
      result("contacts.torque", torque_place(Y), D == 2 ? 1 : 3);
      memory("contacts.rolling", C::rolling, C::pivoting);
      if constexpr (D == 3) memory("contacts.pivoting", C::pivoting, C::stiffness);
    }
  }

  void set_state(std::size_t row, RowState to) {
    RowBlock& block = block_of(row);
    const auto bit = static_cast<std::uint8_t>(1u << row % block_rows);
    if (to == RowState::touching) block.touching |= bit;
    if (to == RowState::attracted) block.attracted |= bit;
  }

  /// values.resize(count) with room to spare when it must grow; what was there stays.
  template <class Values>
  static void resize_with_room(Values& values, std::size_t count) {
    if (count > values.capacity()) values.reserve(count + count / 2);
    values.resize(count);
  }

  /// The rows of a block have no history and no forces.
  void forget(std::size_t block) {
    std::fill_n(columns_.begin() + static_cast<std::ptrdiff_t>(block * column_count()), column_count(), Line{});
    std::fill_n(out_.begin() + static_cast<std::ptrdiff_t>(block * out_size(Y)), out_size(Y), Line{});
  }

  /// All rows apart; their memory is the caller's to fill in. Rows that only fill the last block refer to the two
  /// records after the grains.
  void list_rows(const VerletList<D>& list, int grains) {
    const PairColumns<D>& pairs = list.pairs();
    if (static_cast<std::size_t>(grains) > most_grains(Y)) throw RunError("too many grains for one sample of md");
    if (pairs.size() > most_rows(Y)) throw RunError("too many pairs of grains for one sample of md");
    rows_ = pairs.size();
    const std::size_t blocks = (rows_ + block_rows - 1) / block_rows;
    RowBlock empty{};
    for (int k = 0; k < block_rows; ++k) empty.i[k] = record_at(grains), empty.j[k] = record_at(grains + 1);
    refill(blocks_, blocks, empty);
    resize_with_room(columns_, std::max<std::size_t>(1, blocks * column_count()));
    resize_with_room(out_, (blocks + 1) * out_size(Y));
    std::fill_n(out_.end() - out_size(Y), out_size(Y), Line{});  // rows that stay zero
    plane_rows_.clear();
    images_.reserve(128);  // more than a usual cell has: no growth in the middle of a run
    images_.assign(1, Image<D>{});
    for (std::size_t row = 0; row < rows_; ++row) {
      RowBlock& block = block_of(row);
      const int k = static_cast<int>(row % block_rows);
      block.i[k] = record_at(pairs.i[row]);
      if (pairs.j[row] < grains) {
        block.j[k] = record_at(pairs.j[row]);
      } else {
        const int record = grains + 2 + static_cast<int>(plane_rows_.size());
        plane_rows_.push_back({static_cast<int>(row), pairs.i[row], pairs.j[row] - grains, record});
        block.j[k] = record_at(record);
      }
      block.shift[k] = static_cast<std::uint32_t>(shift_of(pairs.image[row]) * 4 * sizeof(double));
      if (block.shift[k] != 0) block.imaged = 1;
    }
    fill_slots(list, grains, blocks * block_rows);
  }

  void fill_slots(const VerletList<D>& list, int grains, std::size_t zero_row) {
    const auto place = [](std::size_t row) { return static_cast<std::uint32_t>(row * out_size(Y) * sizeof(double)); };
    refill(slots_, slots_per_grain * static_cast<std::size_t>(grains), place(zero_row));
    const auto first = list.first(), second = list.second(), rows_of_second = list.rows_of_second();
    for (int i = 0; i < grains; ++i) {
      std::uint32_t* slot = slots_.data() + slots_per_grain * static_cast<std::size_t>(i);
      for (int k = 0; k < 4 && second[i] + k < second[i + 1]; ++k) slot[k] = place(rows_of_second[second[i] + k]);
      for (int k = 0; k < 4 && first[i] + k < first[i + 1]; ++k) slot[4 + k] = place(first[i] + k);
      slot[8] = second[i + 1] - second[i] > 4 || first[i + 1] - first[i] > 4;
    }
  }

  /// Where the record of a grain begins, in bytes.
  static std::uint32_t record_at(int grain) {
    return static_cast<std::uint32_t>(grain) * static_cast<std::uint32_t>(record_size(Y) * sizeof(double));
  }

  /// The general comparison is a call.
  static bool same(const Image<D>& a, const Image<D>& b) {
    int difference = 0;
    for (int k = 0; k < D; ++k) difference |= a[k] ^ b[k];
    return difference == 0;
  }

  int shift_of(const Image<D>& image) {
    // There are few: the neighbours of the cell, as a rule.
    std::size_t k = 0;
    while (k < images_.size() && !same(images_[k], image)) ++k;
    if (k == images_.size()) images_.push_back(image);
    return static_cast<int>(k);
  }

  const RowConstants& constants_of(std::size_t row) const { return constants_[equal_pairs_ ? 0 : row / block_rows]; }

  std::size_t rows_ = 0;
  bool equal_pairs_ = false;
  StepArray<RowBlock> blocks_ = StepArray<RowBlock>(1);
  StepArray<RowConstants> constants_;
  StepArray<Line> columns_, out_;
  StepArray<std::uint32_t> slots_;
  std::vector<PlaneRow> plane_rows_;
  std::vector<Image<D>> images_ = std::vector<Image<D>>(1);
};

}  // namespace galet::md
