// One row per listed pair: the forces that the contact pass writes and the histories that the law needs.
#pragma once

#include <cstdint>

#include "common/core/archive_columns.hpp"
#include "common/core/column.hpp"
#include "common/core/layout.hpp"
#include "common/core/types.hpp"
#include "common/neighbour/verlet_list.hpp"

namespace galet::md {

template <Layout Y>
struct Contacts {
  static constexpr int D = Y.dim;
  static constexpr bool transported = Y.friction && Y.dim == 3;

  Column<Vec<D>> force;  ///< F on j; zero when the pair does not touch
  Column<std::uint8_t> touching;
  Column<double> damping;              ///< alpha of the pair (mass / time)
  Column<Spin<D>, Y.friction> twist;   ///< |b|/(R_i+R_j) n x F: the torque on grain k of the pair is -R_k twist
  Column<Spin<D>, Y.friction> spring;  ///< stored elongation (a scalar in 2D), see laws/tangential_linear.hpp
  Column<Vec<D>, transported> normal;  ///< n when the spring was last updated

  std::size_t size() const { return touching.size(); }

  void resize(std::size_t rows) {
    force.resize(rows, Vec<D>::Zero());
    touching.resize(rows, 0);
    damping.resize(rows, 0);
    if constexpr (Y.friction) twist.resize(rows, zero_spin<D>()), spring.resize(rows, zero_spin<D>());
    if constexpr (transported) normal.resize(rows, Vec<D>::Zero());
  }

  /// Takes over the rows of `old` that the rebuilt list still has; forces are computed anew by the next pass.
  void carry(const Contacts& old, const VerletList<D>& list) {
    const std::size_t rows = list.size();
    refill(force, rows, Vec<D>::Zero());
    refill(touching, rows, std::uint8_t{0});
    refill(damping, rows, 0.0);
    if constexpr (Y.friction) refill(twist, rows, zero_spin<D>()), refill(spring, rows, zero_spin<D>());
    if constexpr (transported) refill(normal, rows, Vec<D>::Zero());
    for (std::size_t row = 0; row < rows; ++row) {
      const int from = list.origin()[row];
      if (from < 0) continue;
      touching[row] = old.touching[from];
      // The scalar spring of a disk contact does not change when i and j change places; vectors do.
      if constexpr (Y.friction) spring[row] = old.spring[from];
      if constexpr (transported) {
        const double sign = list.flipped(row) ? -1 : 1;
        spring[row] = sign * old.spring[from];
        normal[row] = sign * old.normal[from];
      }
    }
  }

  void save(Archive& archive) const {
    put_column(archive, "contacts.force", force);
    put_column(archive, "contacts.damping", damping);
    archive.integers["contacts.touching"].assign(touching.begin(), touching.end());
    if constexpr (Y.friction) {
      put_column(archive, "contacts.twist", twist);
      put_column(archive, "contacts.spring", spring);
    }
    if constexpr (transported) put_column(archive, "contacts.normal", normal);
  }

  void restore(const Archive& archive, std::size_t rows) {
    resize(rows);
    take_column(archive, "contacts.force", force);
    take_column(archive, "contacts.damping", damping);
    const auto& flags = integer_column(archive, "contacts.touching");
    if (flags.size() != rows) throw InputError("column 'contacts.touching' of the checkpoint has the wrong length");
    touching.assign(flags.begin(), flags.end());
    if constexpr (Y.friction) {
      take_column(archive, "contacts.twist", twist);
      take_column(archive, "contacts.spring", spring);
    }
    if constexpr (transported) take_column(archive, "contacts.normal", normal);
  }
};

}  // namespace galet::md
