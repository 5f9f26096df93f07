// One row per listed pair: the forces that the contact pass writes and the histories that the laws need.
#pragma once

#include <cstdint>

#include "common/core/archive_columns.hpp"
#include "common/core/column.hpp"
#include "common/core/layout.hpp"
#include "common/core/types.hpp"
#include "common/neighbour/verlet_list.hpp"

namespace galet::md {

/// What the pair of a row is doing.
enum class RowState : std::uint8_t { apart, touching, attracted /**< across a gap, by a cohesion of range D0 */ };

template <Layout Y>
struct Contacts {
  static constexpr int D = Y.dim;
  static constexpr bool transported = Y.friction && Y.dim == 3;
  static constexpr bool pivots = Y.rolling && Y.dim == 3;

  Column<Vec<D>> force;  ///< F on j; zero when apart
  Column<std::uint8_t> state;
  Column<std::uint8_t> law;              ///< index of the pair of materials
  Column<double> coefficient, critical;  ///< of the pair, see laws/terms.hpp
  Column<Spin<D>, Y.friction> twist;     ///< |b|/(R_i+R_j) n x F: the torque on grain k of the pair is -R_k twist
  Column<Spin<D>, Y.friction> spring;    ///< stored elongation (a scalar in 2D), see laws/spring.hpp
  Column<double, Y.friction> stiffness_before;  ///< K_N at the last step; hertz only, else empty
  Column<Vec<D>, transported> normal;           ///< n when the springs were last updated
  Column<Spin<D>, Y.rolling> torque;            ///< rolling and pivoting torque on j
  Column<Spin<D>, Y.rolling> rolling;           ///< stored rotation of the rolling spring
  Column<double, pivots> pivoting;              ///< the same about the normal

  bool varying_stiffness = false;  ///< whether stiffness_before is needed

  std::size_t size() const { return state.size(); }
  bool touches(std::size_t row) const { return state[row] == static_cast<std::uint8_t>(RowState::touching); }
  bool acts(std::size_t row) const { return state[row] != static_cast<std::uint8_t>(RowState::apart); }
  void set(std::size_t row, RowState to) { state[row] = static_cast<std::uint8_t>(to); }

  /// Calls visit(name, column) for every column of histories and forces that this layout has.
  template <class Self, class Visit>
  static void each(Self& self, Visit visit) {
    visit("contacts.force", self.force);
    if constexpr (Y.friction) visit("contacts.twist", self.twist), visit("contacts.spring", self.spring);
    if constexpr (Y.friction)
      if (self.varying_stiffness) visit("contacts.stiffness", self.stiffness_before);
    if constexpr (transported) visit("contacts.normal", self.normal);
    if constexpr (Y.rolling) visit("contacts.torque", self.torque), visit("contacts.rolling", self.rolling);
    if constexpr (pivots) visit("contacts.pivoting", self.pivoting);
  }

  /// All rows apart and without history.
  void clear(std::size_t rows) {
    refill(state, rows, std::uint8_t{0});
    refill(law, rows, std::uint8_t{0});
    refill(coefficient, rows, 0.0);
    refill(critical, rows, 0.0);
    each(*this, [&](const char*, auto& column) { zero(column, rows); });
  }

  /// Takes over the rows of `old` that the rebuilt list still has; forces are computed anew by the next pass.
  void carry(const Contacts& old, const VerletList<D>& list) {
    clear(list.size());
    for (std::size_t row = 0; row < list.size(); ++row) {
      const int from = list.origin()[row];
      if (from < 0) continue;
      state[row] = old.state[from];
      // When i and j change places, vectors and relative rotations change sign; the scalar spring of a disk contact and
      // a rotation about the normal do not.
      const double sign = list.flipped(row) ? -1 : 1;
      if constexpr (Y.friction) spring[row] = (D == 3 ? sign : 1) * old.spring[from];
      if constexpr (Y.friction)
        if (varying_stiffness) stiffness_before[row] = old.stiffness_before[from];
      if constexpr (transported) normal[row] = sign * old.normal[from];
      if constexpr (Y.rolling) rolling[row] = sign * old.rolling[from];
      if constexpr (pivots) pivoting[row] = old.pivoting[from];
    }
  }

  void save(Archive& archive) const {
    archive.integers["contacts.state"].assign(state.begin(), state.end());
    each(*this, [&](const char* name, const auto& column) { put_column(archive, name, column); });
  }

  void restore(const Archive& archive, std::size_t rows) {
    clear(rows);
    const auto& states = integer_column(archive, "contacts.state");
    if (states.size() != rows) throw InputError("column 'contacts.state' of the checkpoint has the wrong length");
    state.assign(states.begin(), states.end());
    each(*this, [&](const char* name, auto& column) { take_column(archive, name, column); });
  }

 private:
  static void zero(Column<double>& column, std::size_t rows) { refill(column, rows, 0.0); }
  template <int Size>
  static void zero(Column<Eigen::Matrix<double, Size, 1>>& column, std::size_t rows) {
    refill(column, rows, Eigen::Matrix<double, Size, 1>::Zero());
  }
};

}  // namespace galet::md
