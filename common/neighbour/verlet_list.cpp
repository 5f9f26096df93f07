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
void VerletList<D>::Reference::set(std::span<const Vec<D>> positions, std::span<const Plane<D>> planes,
                                   const Mat<D>& box_then) {
  position.assign(positions.begin(), positions.end());
  box = box_then;
  plane.clear();
  for (const Plane<D>& boundary : planes) plane.push_back(boundary.point);
}

template <int D>
void VerletList<D>::configure(double range, double skin, double outer) {
  require(range >= 0 && skin > 0, "a neighbour list needs range >= 0 and skin > 0");
  require(outer == 0 || outer >= skin, "the outer list of a neighbour list has the wider skin");
  range_ = range;
  skin_ = skin;
  wanted_outer_skin_ = outer;
}

/// Largest 2 |s_i| for which a list of that skin certainly holds in the cell (planes apart).
template <int D>
double VerletList<D>::room(const Reference& then, double skin, const Cell<D>& cell) const {
  if (cell.box == then.box) return skin;
  const double shrink = std::min(0.0, least_singular_value<D>(Mat<D>(cell.box * then.box.inverse())) - 1);
  return skin + shrink * (2 * largest_radius_ + range_ + skin);
}

template <int D>
double VerletList<D>::allowance(const Cell<D>& cell) const {
  return 0.5 * room(reference_, skin_, cell);
}

template <int D>
typename VerletList<D>::Moves VerletList<D>::moves_since(const Reference& then, std::span<const Vec<D>> position,
                                                         const Cell<D>& cell, std::span<const Plane<D>> planes) {
  const Mat<D> deformation = cell.box * then.box.inverse();
  const bool rigid_cell = cell.box == then.box;
  Moves moves;
  for (std::size_t i = 0; i < position.size(); ++i) {
    const Vec<D> affine = rigid_cell ? then.position[i] : Vec<D>(deformation * then.position[i]);
    const double moved = (position[i] - affine).squaredNorm();
    if (moved != moved) {  // the build says which grain is lost
      moves.apart = moved;
      return moves;
    }
    moves.apart = std::max(moves.apart, moved);
    if (!planes.empty()) moves.grain = std::max(moves.grain, (position[i] - then.position[i]).squaredNorm());
  }
  moves.apart = std::sqrt(moves.apart), moves.grain = std::sqrt(moves.grain);
  for (std::size_t p = 0; p < planes.size(); ++p)
    moves.plane = std::max(moves.plane, (planes[p].point - then.plane[p]).norm());
  return moves;
}

template <int D>
bool VerletList<D>::holds(const Reference& then, double skin, const Moves& moved, const Cell<D>& cell,
                          double reserve) const {
  if (!(room(then, skin, cell) >= 2 * moved.apart + reserve)) return false;
  return then.plane.empty() || skin >= moved.grain + moved.plane + reserve;
}

template <int D>
bool VerletList<D>::expired(std::span<const Vec<D>> position, const Cell<D>& cell, std::span<const Plane<D>> planes,
                            double reserve) const {
  if (builds_ == 0) return true;
  const Moves moved = moves_since(reference_, position, cell, planes);
  largest_move_ = moved.apart;
  return !holds(reference_, skin_, moved, cell, reserve);
}

/// Pairs of the outer list whose gap is within range + skin now: calls take(k) for each, k its place among the outer
/// ones, in their order.
template <int D>
template <class Take>
void VerletList<D>::take_near(std::span<const Vec<D>> position, std::span<const double> radius, const Cell<D>& cell,
                              std::span<const Plane<D>> planes, std::span<const int> number, Take take) {
  const double limit = range_ + skin_;
  const int grains = static_cast<int>(position.size());
  const PairSight<D> sight{position, radius, planes, number};
  for (std::size_t k = 0; k < outer_.size(); ++k) {
    const int i = outer_.i[k], j = outer_.j[k];
    const auto shift = [&] { return Vec<D>(lattice<D>(cell.box, outer_.image[k]) - position[i]); };
    if (j >= grains ? sight.near_plane(i, j - grains, limit) : sight.near(i, j, shift(), limit)) take(k);
  }
}

/// The list from the outer one; row_of_outer_ says where each pair stands in it.
template <int D>
void VerletList<D>::take_all_near(std::span<const Vec<D>> position, std::span<const double> radius, const Cell<D>& cell,
                                  std::span<const Plane<D>> planes, std::span<const int> number) {
  // Each pair keeps its former row until it is looked at: origin_ is filled in on the way.
  const std::size_t outer = outer_.size();
  for (auto* column : {&pairs_.i, &pairs_.j, &origin_})
    if (column->size() < outer) refill(*column, outer, 0);
  if (pairs_.image.size() < outer) refill(pairs_.image, outer, Image<D>{});
  std::size_t rows = 0, seen = 0;
  take_near(position, radius, cell, planes, number, [&](std::size_t k) {
    for (; seen < k; ++seen) row_of_outer_[seen] = -1;
    pairs_.i[rows] = outer_.i[k], pairs_.j[rows] = outer_.j[k], pairs_.image[rows] = outer_.image[k];
    origin_[rows] = row_of_outer_[k];
    row_of_outer_[k] = static_cast<int>(rows++);
    ++seen;
  });
  for (; seen < outer; ++seen) row_of_outer_[seen] = -1;
  pairs_.i.resize(rows), pairs_.j.resize(rows), pairs_.image.resize(rows), origin_.resize(rows);
}

/// The outer list again from what it was made of.
template <int D>
void VerletList<D>::find_outer(std::span<const double> radius, const Cell<D>& cell, std::span<const Plane<D>> planes,
                               std::span<const int> group, std::span<const int> number) {
  Cell<D> then = cell;
  then.box = outer_reference_.box;
  std::vector<Plane<D>> boundaries(planes.begin(), planes.end());
  for (std::size_t p = 0; p < boundaries.size(); ++p) boundaries[p].point = outer_reference_.plane[p];
  search_.find(outer_reference_.position, radius, then, boundaries, group, number, range_ + outer_skin_, outer_);
  outer_known_ = true;
  match_outer_rows();
}

/// Where each outer pair stands in the list (both are sorted).
template <int D>
void VerletList<D>::match_outer_rows() {
  refill(row_of_outer_, outer_.size(), -1);
  std::size_t k = 0;
  for (std::size_t row = 0; row < pairs_.size(); ++row) {
    const auto key = std::tie(pairs_.i[row], pairs_.j[row], pairs_.image[row]);
    while (k < outer_.size() && std::tie(outer_.i[k], outer_.j[k], outer_.image[k]) < key) ++k;
    if (k < outer_.size() && std::tie(outer_.i[k], outer_.j[k], outer_.image[k]) == key)
      row_of_outer_[k] = static_cast<int>(row);
  }
}

template <int D>
bool VerletList<D>::narrow(std::span<const Vec<D>> position, std::span<const double> radius, const Cell<D>& cell,
                           std::span<const Plane<D>> planes, std::span<const int> group, std::span<const int> number) {
  if (outer_skin_ == 0) return false;
  const Moves moved = moves_since(outer_reference_, position, cell, planes);
  if (!holds(outer_reference_, outer_skin_, moved, cell, skin_)) return false;
  try {
    if (!outer_known_) find_outer(radius, cell, planes, group, number);
    take_all_near(position, radius, cell, planes, number);
  } catch (const RunError&) {
    forget_pairs(static_cast<int>(position.size()));
    throw;
  }
  index_rows(static_cast<int>(position.size()));
  refill(flipped_, pairs_.size(), std::uint8_t{0});
  reference_.set(position, planes, cell.box);
  ++narrowings_;
  return true;
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
  match_old_rows();
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
  if (!reference_.position.empty()) step.apply(reference_.position);
  if (!outer_reference_.position.empty()) step.apply(outer_reference_.position);
  outer_known_ = false;
}

template <int D>
void VerletList<D>::build(std::span<Vec<D>> position, std::span<const double> radius, Cell<D>& cell,
                          std::span<const Plane<D>> planes, std::span<const int> group, std::span<const int> number) {
  try {
    wrap(position, cell, number);
    largest_radius_ = radius.empty() ? 0 : *std::max_element(radius.begin(), radius.end());
    outer_skin_ = wanted_outer_skin_;
    outer_known_ = outer_skin_ > 0;
    if (outer_known_) {
      search_.find(position, radius, cell, planes, group, number, range_ + outer_skin_, outer_);
      outer_reference_.set(position, planes, cell.box);
      refill(row_of_outer_, outer_.size(), -1);
      take_all_near(position, radius, cell, planes, number);
    } else {
      search_.find(position, radius, cell, planes, group, number, range_ + skin_, pairs_);
    }
  } catch (const RunError&) {
    // Rows that no longer match what their owner keeps about them must not be read.
    forget_pairs(static_cast<int>(position.size()));
    throw;
  }
  index_rows(static_cast<int>(position.size()));
  match_old_rows();
  reference_.set(position, planes, cell.box);
  ++builds_;
}

template <int D>
void VerletList<D>::forget_pairs(int grains) {
  pairs_.i.clear(), pairs_.j.clear(), pairs_.image.clear();
  first_.assign(grains + 1, 0);
  second_.assign(grains + 1, 0);
  rows_of_second_.clear(), origin_.clear(), flipped_.clear();
  outer_skin_ = 0;
}

/// Row indices by grain.
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
}

/// The match between new and old rows (both sorted by (i, j, image)).
template <int D>
void VerletList<D>::match_old_rows() {
  const std::size_t rows = pairs_.size();
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
  use.grains += bytes_of(first_, second_, reference_.position, outer_reference_.position, wraps_, cursor_);
  use.pairs += bytes_of(outer_.i, outer_.j, outer_.image, row_of_outer_);
  use.pairs += bytes_of(pairs_.i, pairs_.j, pairs_.image, old_pairs_.i, old_pairs_.j, old_pairs_.image);
  use.pairs += bytes_of(rows_of_second_, origin_, flipped_, old_flipped_, old_order_);
  use.listed = size();
  return use;
}

template <int D>
void VerletList<D>::save(Archive& archive, std::span<const int> number) const {
  const std::size_t grains = reference_.position.size();
  const auto name = [&](int i) { return number.empty() || i >= static_cast<int>(grains) ? i : number[i]; };
  auto& pairs = archive.integers["neighbours.pairs"];
  pairs.clear();
  for (std::size_t row = 0; row < pairs_.size(); ++row) {
    pairs.push_back(name(pairs_.i[row]));
    pairs.push_back(name(pairs_.j[row]));
    for (int a = 0; a < D; ++a) pairs.push_back(pairs_.image[row][a]);
  }
  archive.integers["neighbours.builds"] = {builds_, narrowings_};
  const auto put = [&](const Reference& then, std::vector<double>& reals) {
    const std::size_t first = reals.size();
    reals.resize(first + grains * D);
    for (std::size_t i = 0; i < grains; ++i)
      std::copy_n(then.position[i].data(), D, &reals[first + static_cast<std::size_t>(name(static_cast<int>(i))) * D]);
    for (const Vec<D>& x : then.plane) reals.insert(reals.end(), x.begin(), x.end());
    reals.insert(reals.end(), then.box.data(), then.box.data() + D * D);
  };
  auto& reals = archive.reals["neighbours.reference"];
  reals.assign({range_, skin_, largest_radius_});
  put(reference_, reals);
  auto& outer = archive.reals["neighbours.outer"];
  outer.assign({outer_skin_});
  if (outer_skin_ > 0) put(outer_reference_, outer);
}

/// Reads what save() has put there.
template <int D>
void VerletList<D>::Reference::take(const double* from, std::size_t grains, std::size_t planes) {
  position.resize(grains), plane.resize(planes);
  for (Vec<D>& x : position) x = Eigen::Map<const Vec<D>>(from), from += D;
  for (Vec<D>& x : plane) x = Eigen::Map<const Vec<D>>(from), from += D;
  box = Eigen::Map<const Mat<D>>(from);
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
  narrowings_ = integer_column(archive, "neighbours.builds").at(1);
  range_ = reals[0], skin_ = reals[1], largest_radius_ = reals[2];
  const std::size_t planes = (reals.size() - 3 - D * D) / D - grains;
  reference_.take(reals.data() + 3, grains, planes);
  const auto& outer = real_column(archive, "neighbours.outer");
  outer_skin_ = outer.at(0);
  outer_known_ = false;
  if (outer_skin_ > 0) {
    if (outer.size() != reals.size() - 2) throw InputError("the checkpoint's outer list does not fit its grains");
    outer_reference_.take(outer.data() + 1, grains, planes);
  }
  keep_rows();
  for (std::size_t row = 0; row < rows; ++row)
    if (old_pairs_.j[row] < grains) put_in_order(row);
  sort_old_rows(grains);
  take_old_rows(grains);
}

template class VerletList<2>;
template class VerletList<3>;

}  // namespace galet
