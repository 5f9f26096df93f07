#include "common/neighbour/verlet_list.hpp"

#include <algorithm>
#include <numeric>
#include <tuple>

#include <Eigen/Eigenvalues>
#include <fmt/format.h>

#include "common/core/column.hpp"
#include "common/core/error.hpp"
#include "common/neighbour/image.hpp"

namespace galet {

namespace {

template <int D>
double least_singular_value(const Mat<D>& matrix) {
  Eigen::SelfAdjointEigenSolver<Mat<D>> squares;
  squares.computeDirect(matrix.transpose() * matrix, Eigen::EigenvaluesOnly);
  return std::sqrt(std::max(0.0, squares.eigenvalues()[0]));
}

}  // namespace

template <int D>
void VerletList<D>::configure(double range, double skin) {
  require(range >= 0 && skin > 0, "a neighbour list needs range >= 0 and skin > 0");
  range_ = range;
  skin_ = skin;
}

template <int D>
double VerletList<D>::allowance(const Cell<D>& cell) const {
  if (cell.box == box_reference_) return 0.5 * skin_;
  const double shrink = std::min(0.0, least_singular_value<D>(Mat<D>(cell.box * box_reference_.inverse())) - 1);
  return 0.5 * (skin_ + shrink * (2 * largest_radius_ + range_ + skin_));
}

template <int D>
bool VerletList<D>::expired(std::span<const Vec<D>> position, const Cell<D>& cell, std::span<const Plane<D>> planes,
                            double reserve) const {
  if (builds_ == 0) return true;
  const Mat<D> deformation = cell.box * box_reference_.inverse();
  const bool rigid_cell = cell.box == box_reference_;
  double largest = 0, largest_true = 0;
  for (std::size_t i = 0; i < position.size(); ++i) {
    const Vec<D> affine = rigid_cell ? reference_[i] : Vec<D>(deformation * reference_[i]);
    const double moved = (position[i] - affine).squaredNorm();
    if (moved != moved) {  // the build says which grain is lost
      largest_move_ = moved;
      return true;
    }
    largest = std::max(largest, moved);
    if (!planes.empty()) largest_true = std::max(largest_true, (position[i] - reference_[i]).squaredNorm());
  }
  largest_move_ = std::sqrt(largest);
  if (!(2 * allowance(cell) >= 2 * largest_move_ + reserve)) return true;
  double plane_moved = 0;
  for (std::size_t p = 0; p < planes.size(); ++p)
    plane_moved = std::max(plane_moved, (planes[p].point - plane_reference_[p]).norm());
  return !planes.empty() && skin_ < std::sqrt(largest_true) + plane_moved + reserve;
}

template <int D>
void VerletList<D>::wrap(std::span<Vec<D>> position, Cell<D>& cell, std::span<const int> number) {
  const auto name = [&](std::size_t i) { return number.empty() ? static_cast<int>(i) : number[i]; };
  Eigen::Matrix<int, D, D> remap = tilt_reduction(cell);
  const Eigen::Matrix<int, D, D> identity = Eigen::Matrix<int, D, D>::Identity();
  Eigen::Matrix<int, D, D> inverse_remap = identity;
  if (remap != identity) {
    cell.box = cell.box * remap.template cast<double>();
    const Mat<D> inverse = remap.template cast<double>().inverse();
    for (int a = 0; a < D; ++a)
      for (int b = 0; b < D; ++b) inverse_remap(a, b) = static_cast<int>(std::lround(inverse(a, b)));
  }
  const Mat<D> to_fraction = cell.box.inverse();
  wraps_.assign(position.size(), Image<D>{});
  for (std::size_t i = 0; i < position.size(); ++i) {
    if (!position[i].allFinite()) throw RunError(fmt::format("the position of grain {} is not finite", name(i)));
    const Vec<D> fraction = to_fraction * position[i];
    if (!(fraction.cwiseAbs().maxCoeff() < farthest_image))
      throw RunError(fmt::format("grain {} is lost, far from the others", name(i)));
    for (int a = 0; a < D; ++a)
      if (cell.periodic[a]) wraps_[i][a] = -static_cast<int>(std::floor(fraction[a]));
    position[i] += lattice<D>(cell.box, wraps_[i]);
  }
  carry_rows(inverse_remap);
}

/// The present pairs become the old ones.
template <int D>
void VerletList<D>::keep_rows() {
  copy_with_room(pairs_.i, old_pairs_.i);
  copy_with_room(pairs_.j, old_pairs_.j);
  copy_with_room(pairs_.image, old_pairs_.image);
  refill(old_flipped_, old_pairs_.size(), std::uint8_t{0});
}

/// The one of the two ways to write an old pair of grains that lists have: i < j, or first lattice coordinate positive.
template <int D>
void VerletList<D>::put_in_order(std::size_t row) {
  int &i = old_pairs_.i[row], &j = old_pairs_.j[row];
  Image<D>& image = old_pairs_.image[row];
  if (i < j || (i == j && first_nonzero_positive<D>(image))) return;
  std::swap(i, j);
  image = negative<D>(image);
  old_flipped_[row] = 1;
}

/// Rewrites the images of the present pairs for the remapped cell and the wrapped grains, and finds the order in
/// which they are sorted again: x_j + box image = x_j' + box' image' with x' = x + box' wrap.
template <int D>
void VerletList<D>::carry_rows(const Eigen::Matrix<int, D, D>& inverse_remap) {
  keep_rows();
  const int grains = static_cast<int>(wraps_.size());
  for (std::size_t row = 0; row < old_pairs_.size(); ++row) {
    const int i = old_pairs_.i[row], j = old_pairs_.j[row];
    if (j >= grains) continue;
    Image<D>& image = old_pairs_.image[row];
    Image<D> remapped{};
    for (int a = 0; a < D; ++a)
      for (int b = 0; b < D; ++b) remapped[a] += inverse_remap(a, b) * image[b];
    image = add<D>(add<D>(remapped, wraps_[i]), negative<D>(wraps_[j]));
    put_in_order(row);
  }
  sort_old_rows(grains);
}

/// The order of the old rows by (i, j, image).
template <int D>
void VerletList<D>::sort_old_rows(int grains) {
  old_order_.resize(old_pairs_.size());
  std::iota(old_order_.begin(), old_order_.end(), 0);
  const auto before = [this](int a, int b) {
    if (old_pairs_.i[a] != old_pairs_.i[b]) return old_pairs_.i[a] < old_pairs_.i[b];
    if (old_pairs_.j[a] != old_pairs_.j[b]) return old_pairs_.j[a] < old_pairs_.j[b];
    return old_pairs_.image[a] < old_pairs_.image[b];
  };
  // As a rule only several images of one pair can have changed places, which is rare.
  if (std::is_sorted(old_order_.begin(), old_order_.end(), before)) return;
  first_.assign(grains + 1, 0);
  for (const int i : old_pairs_.i) ++first_[i + 1];
  std::partial_sum(first_.begin(), first_.end(), first_.begin());
  cursor_.assign(first_.begin(), first_.end() - 1);
  for (std::size_t row = 0; row < old_pairs_.size(); ++row)
    old_order_[cursor_[old_pairs_.i[row]]++] = static_cast<int>(row);
  for (int i = 0; i < grains; ++i)
    std::sort(old_order_.begin() + first_[i], old_order_.begin() + first_[i + 1], before);
}

/// The list of the old rows in their order.
template <int D>
void VerletList<D>::take_old_rows(int grains) {
  for (std::size_t row = 0; row < old_pairs_.size(); ++row) {
    const int old = old_order_[row];
    pairs_.i[row] = old_pairs_.i[old], pairs_.j[row] = old_pairs_.j[old], pairs_.image[row] = old_pairs_.image[old];
  }
  index_rows(grains);
}

template <int D>
void VerletList<D>::renumber(const Permutation& step) {
  const int grains = static_cast<int>(step.size());
  keep_rows();
  for (std::size_t row = 0; row < old_pairs_.size(); ++row) {
    int &i = old_pairs_.i[row], &j = old_pairs_.j[row];
    i = step.to(i);
    if (j >= grains) continue;
    j = step.to(j);
    put_in_order(row);
  }
  sort_old_rows(grains);
  take_old_rows(grains);
  if (!reference_.empty()) step.apply(reference_);
}

template <int D>
void VerletList<D>::build(std::span<Vec<D>> position, std::span<const double> radius, Cell<D>& cell,
                          std::span<const Plane<D>> planes, std::span<const int> group, std::span<const int> number) {
  try {
    wrap(position, cell, number);
    largest_radius_ = radius.empty() ? 0 : *std::max_element(radius.begin(), radius.end());
    search_.find(position, radius, cell, planes, group, number, range_ + skin_, pairs_);
  } catch (const RunError&) {
    // Rows that no longer match what their owner keeps about them must not be read.
    forget_pairs(static_cast<int>(position.size()));
    throw;
  }
  index_rows(static_cast<int>(position.size()));
  reference_.assign(position.begin(), position.end());
  box_reference_ = cell.box;
  plane_reference_.clear();
  for (const Plane<D>& plane : planes) plane_reference_.push_back(plane.point);
  ++builds_;
}

template <int D>
void VerletList<D>::forget_pairs(int grains) {
  pairs_.i.clear(), pairs_.j.clear(), pairs_.image.clear();
  first_.assign(grains + 1, 0);
  second_.assign(grains + 1, 0);
  rows_of_second_.clear(), origin_.clear(), flipped_.clear();
}

/// Row indices by grain, and the match between new and old rows (both sorted by (i, j, image)).
template <int D>
void VerletList<D>::index_rows(int grains) {
  const std::size_t rows = pairs_.size();
  first_.assign(grains + 1, 0);
  second_.assign(grains + 1, 0);
  for (std::size_t row = 0; row < rows; ++row) {
    ++first_[pairs_.i[row] + 1];
    if (pairs_.j[row] < grains) ++second_[pairs_.j[row] + 1];
  }
  std::partial_sum(first_.begin(), first_.end(), first_.begin());
  std::partial_sum(second_.begin(), second_.end(), second_.begin());
  rows_of_second_.resize(second_.back());
  cursor_.assign(second_.begin(), second_.end() - 1);
  for (std::size_t row = 0; row < rows; ++row)
    if (pairs_.j[row] < grains) rows_of_second_[cursor_[pairs_.j[row]]++] = static_cast<int>(row);

  refill(origin_, rows, -1);
  refill(flipped_, rows, std::uint8_t{0});
  std::size_t k = 0;
  for (std::size_t row = 0; row < rows; ++row) {
    const auto key = std::tie(pairs_.i[row], pairs_.j[row], pairs_.image[row]);
    const auto old_key = [&](std::size_t at) {
      const int old = old_order_[at];
      return std::tie(old_pairs_.i[old], old_pairs_.j[old], old_pairs_.image[old]);
    };
    while (k < old_order_.size() && old_key(k) < key) ++k;
    if (k < old_order_.size() && old_key(k) == key) {
      origin_[row] = old_order_[k];
      flipped_[row] = old_flipped_[old_order_[k]];
    }
    GALET_ENSURE(row == 0 || std::tie(pairs_.i[row - 1], pairs_.j[row - 1], pairs_.image[row - 1]) < key,
                 "listed pairs are sorted and each stands once");
  }
}

template <int D>
MemoryUse VerletList<D>::memory() const {
  MemoryUse use = search_.memory();
  use.grains += bytes_of(first_, second_, reference_, wraps_, cursor_);
  use.pairs += bytes_of(pairs_.i, pairs_.j, pairs_.image, old_pairs_.i, old_pairs_.j, old_pairs_.image);
  use.pairs += bytes_of(rows_of_second_, origin_, flipped_, old_flipped_, old_order_);
  use.listed = size();
  return use;
}

template <int D>
void VerletList<D>::save(Archive& archive, std::span<const int> number) const {
  const std::size_t grains = reference_.size();
  const auto name = [&](int i) { return number.empty() || i >= static_cast<int>(grains) ? i : number[i]; };
  auto& pairs = archive.integers["neighbours.pairs"];
  pairs.clear();
  for (std::size_t row = 0; row < pairs_.size(); ++row) {
    pairs.push_back(name(pairs_.i[row]));
    pairs.push_back(name(pairs_.j[row]));
    for (int a = 0; a < D; ++a) pairs.push_back(pairs_.image[row][a]);
  }
  archive.integers["neighbours.builds"] = {builds_};
  auto& reals = archive.reals["neighbours.reference"];
  reals.assign({range_, skin_, largest_radius_});
  reals.resize(3 + grains * D);
  for (std::size_t i = 0; i < grains; ++i)
    std::copy_n(reference_[i].data(), D, reals.data() + 3 + static_cast<std::size_t>(name(static_cast<int>(i))) * D);
  for (const Vec<D>& x : plane_reference_) reals.insert(reals.end(), x.begin(), x.end());
  reals.insert(reals.end(), box_reference_.data(), box_reference_.data() + D * D);
}

template <int D>
void VerletList<D>::restore(const Archive& archive, int grains) {
  const auto& pairs = integer_column(archive, "neighbours.pairs");
  const auto& reals = real_column(archive, "neighbours.reference");
  const std::size_t rows = pairs.size() / (2 + D);
  if (reals.size() < 3 + static_cast<std::size_t>(grains) * D + D * D || pairs.size() % (2 + D) != 0)
    throw InputError("the checkpoint's neighbour list does not fit its grains");
  pairs_.i.resize(rows), pairs_.j.resize(rows), pairs_.image.resize(rows);
  for (std::size_t row = 0; row < rows; ++row) {
    const std::int64_t* entry = pairs.data() + row * (2 + D);
    pairs_.i[row] = static_cast<int>(entry[0]);
    pairs_.j[row] = static_cast<int>(entry[1]);
    if (pairs_.i[row] < 0 || pairs_.i[row] >= grains || pairs_.j[row] < 0)
      throw InputError("the checkpoint's neighbour list names a grain that does not exist");
    for (int a = 0; a < D; ++a) pairs_.image[row][a] = static_cast<int>(entry[2 + a]);
  }
  builds_ = integer_column(archive, "neighbours.builds").at(0);
  range_ = reals[0], skin_ = reals[1], largest_radius_ = reals[2];
  const std::size_t planes = (reals.size() - 3 - D * D) / D - grains;
  const double* from = reals.data() + 3;
  reference_.resize(grains), plane_reference_.resize(planes);
  for (Vec<D>& x : reference_) x = Eigen::Map<const Vec<D>>(from), from += D;
  for (Vec<D>& x : plane_reference_) x = Eigen::Map<const Vec<D>>(from), from += D;
  box_reference_ = Eigen::Map<const Mat<D>>(from);
  keep_rows();
  for (std::size_t row = 0; row < rows; ++row)
    if (old_pairs_.j[row] < grains) put_in_order(row);
  sort_old_rows(grains);
  take_old_rows(grains);
}

template class VerletList<2>;
template class VerletList<3>;

}  // namespace galet
