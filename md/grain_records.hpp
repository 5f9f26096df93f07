// What contacts see of the grains: positions, and velocities predicted for the time of the positions, in the order in
// which the kernels read them (kernel/view.hpp).
#pragma once

#include <vector>

#include "common/core/layout.hpp"
#include "common/core/memory_use.hpp"
#include "common/core/permutation.hpp"
#include "common/core/types.hpp"
#include "md/contacts.hpp"

namespace galet::md {

template <Layout Y>
class GrainRecords {
 public:
  static constexpr int D = Y.dim;

  /// Room for `grains` and the two records that rows without a pair refer to.
  void resize(int grains) {
    lines_.clear();
    make_room(grains + 2);
    put_position(grains + 1, Vec<D>(filler_distance * Vec<D>::UnitX()));
  }

  /// Room for more records; keeps those that are there.
  void make_room(int records) {
    const std::size_t lines = (static_cast<std::size_t>(records) * record_size(Y) + 7) / 8;
    if (lines > lines_.size()) lines_.resize(lines + lines / 8, Line{});
  }

  /// Another order of the grains; the records behind them stay.
  void rearrange(const Permutation& step) { step.apply(data(), record_size(Y)); }

  std::size_t bytes() const { return bytes_of(lines_); }
  double* data() { return doubles(lines_); }
  const double* data() const { return doubles(lines_); }

  void put_position(int i, const Vec<D>& position) {
    double* to = record(i);
    for (int a = 0; a < D; ++a) to[a] = position[a];
  }
  void put_velocity(int i, const Vec<D>& velocity) {
    double* to = record(i) + (D == 2 ? 2 : 4);
    for (int a = 0; a < D; ++a) to[a] = velocity[a];
  }
  void put_spin(int i, const Spin<D>& spin, double radius) requires(Y.friction) {
    double* to = record(i);
    if constexpr (D == 2) {
      to[4] = radius * spin, to[5] = spin;
    } else {
      for (int a = 0; a < 3; ++a) to[4 * a + 3] = spin[a], to[8 + a] = radius * spin[a];
      if constexpr (Y.rolling) to[12] = spin[0], to[13] = spin[1], to[14] = spin[2];
    }
  }
  Vec<D> position(int i) const { return Eigen::Map<const Vec<D>>(record(i)); }
  Vec<D> velocity(int i) const { return Eigen::Map<const Vec<D>>(record(i) + (D == 2 ? 2 : 4)); }
  Spin<D> spin(int i) const requires(Y.friction) {
    const double* from = record(i);
    if constexpr (D == 2)
      return from[5];
    else
      return {from[3], from[7], from[11]};
  }

 private:
  double* record(int i) { return doubles(lines_) + static_cast<std::size_t>(i) * record_size(Y); }
  const double* record(int i) const { return doubles(lines_) + static_cast<std::size_t>(i) * record_size(Y); }

  StepArray<Line> lines_;
};

/// The motion that contacts see.
template <Layout Y>
struct Seen {
  GrainRecords<Y> grains;
  Mat<Y.dim> gradient = Mat<Y.dim>::Zero();  ///< L
};

}  // namespace galet::md
