#include "common/neighbour/neighbour_search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include <fmt/format.h>

#include "common/core/column.hpp"
#include "common/core/error.hpp"
#include "common/core/parallel.hpp"
#include "common/neighbour/image.hpp"

namespace galet {

template <int D>
void PairSight<D>::refuse_overlap(int i, int j, double overlap) const {
  throw RunError(
      fmt::format("grains {} and {} overlap by {:.3g}, more than half of the smaller radius: the "
                  "contact is too soft or the time step too large",
                  std::min(name(i), name(j)), std::max(name(i), name(j)), overlap));
}

template <int D>
void PairSight<D>::refuse_behind(int i, std::size_t plane) const {
  throw RunError(fmt::format("grain {} is behind {}", name(i), boundary_name(planes, plane)));
}

template <int D>
void NeighbourSearch<D>::find(std::span<const Vec<D>> position, std::span<const double> radius, const Cell<D>& cell,
                              std::span<const Plane<D>> planes, std::span<const int> group, std::span<const int> number,
                              double limit, PairColumns<D>& pairs) {
  pairs.i.clear(), pairs.j.clear(), pairs.image.clear();
  if (position.empty()) return;
  const Sight sight{{position, radius, planes, number}, cell, group, cell.box.inverse(), limit};
  classify(radius);
  measure_extent(sight);
  fill_bins(sight);
  search(sight);
  if (classes_.size() > 1)
    list_from_both_sides(static_cast<int>(position.size()), pairs);
  else
    list_found(static_cast<int>(position.size()), pairs);
}

/// The classes of the present radii: class k holds those in (R_max / 2^(k+1), R_max / 2^k], without the empty ones.
template <int D>
void NeighbourSearch<D>::classify(std::span<const double> radius) {
  constexpr int most = 24;
  std::array<int, most> count{};
  std::array<double, most> largest_of{};
  const double largest = *std::max_element(radius.begin(), radius.end());
  class_of_.resize(radius.size());
  for (std::size_t i = 0; i < radius.size(); ++i) {
    const int k = std::min(most - 1, std::ilogb(largest / radius[i]));
    class_of_[i] = static_cast<std::uint8_t>(k);
    ++count[k];
    largest_of[k] = std::max(largest_of[k], radius[i]);
  }
  std::array<std::uint8_t, most> number{};
  std::size_t classes = 0;
  for (int k = 0; k < most; ++k) {
    if (count[k] == 0) continue;
    number[k] = static_cast<std::uint8_t>(classes++);
    if (classes_.size() < classes) classes_.emplace_back();
    classes_[classes - 1].largest_radius = largest_of[k];
    classes_[classes - 1].count = count[k];
  }
  classes_.resize(classes);
  for (std::uint8_t& k : class_of_) k = number[k];
}

/// Where the grains are, in fractional coordinates: the whole cell in periodic directions.
template <int D>
void NeighbourSearch<D>::measure_extent(const Sight& sight) {
  Vec<D> low = Vec<D>::Constant(std::numeric_limits<double>::max()), high = -low;
  for (const Vec<D>& x : sight.position) {
    const Vec<D> fraction = sight.to_fraction * x;
    low = low.cwiseMin(fraction);
    high = high.cwiseMax(fraction);
  }
  for (int a = 0; a < D; ++a) {
    origin_of_bins_[a] = sight.cell.periodic[a] ? 0 : low[a];
    extent_of_bins_[a] = sight.cell.periodic[a] ? 1 : std::max(1e-300, high[a] - low[a]);
  }
}

/// Bins as narrow as the reach of the class allows, but not many more than grains: empty ones only cost time (dilute
/// gases, grains far from the others).
template <int D>
void NeighbourSearch<D>::divide(SizeClass& size, const Sight& sight) const {
  constexpr double bins_per_grain = 2;
  const double cutoff = 2 * size.largest_radius + sight.limit;
  const Vec<D> extent = extent_of_bins_.cwiseProduct(face_distances<D>(sight.cell.box));
  Vec<D> wanted;
  for (int a = 0; a < D; ++a) wanted[a] = std::max(1.0, std::floor(std::min(extent[a] / cutoff, farthest_image)));
  for (int round = 0; round < D; ++round) {
    const double excess = wanted.prod() / std::max(8.0, bins_per_grain * static_cast<double>(sight.position.size()));
    const auto several = (wanted.array() > 1).count();
    if (excess <= 1 || several == 0) break;
    const double factor = std::pow(excess, -1.0 / static_cast<double>(several));
    for (int a = 0; a < D; ++a) wanted[a] = std::max(1.0, std::floor(wanted[a] * factor));
  }
  for (int a = 0; a < D; ++a) {
    size.bins[a] = static_cast<int>(wanted[a]);
    size.reach[a] = sight.cell.periodic[a] ? static_cast<int>(std::ceil(cutoff * size.bins[a] / extent[a])) : 1;
  }
}

template <int D>
std::array<int, D> NeighbourSearch<D>::place_of(const SizeClass& size, const Vec<D>& fraction) const {
  std::array<int, D> place;
  for (int a = 0; a < D; ++a) {
    const double along = (fraction[a] - origin_of_bins_[a]) / extent_of_bins_[a];
    place[a] = std::clamp(static_cast<int>(along * size.bins[a]), 0, size.bins[a] - 1);
  }
  return place;
}

template <int D>
void NeighbourSearch<D>::fill_bins(const Sight& sight) {
  const std::size_t grains = sight.position.size();
  for (SizeClass& size : classes_) {
    divide(size, sight);
    std::size_t total = 1;
    for (const int bins : size.bins) total *= static_cast<std::size_t>(bins);
    refill(size.start, total + 1, 0);
    size.grains.resize(static_cast<std::size_t>(size.count));
  }
  bin_of_.resize(grains);
  for (std::size_t i = 0; i < grains; ++i) {
    SizeClass& size = classes_[class_of_[i]];
    const std::array<int, D> place = place_of(size, sight.to_fraction * sight.position[i]);
    int bin = 0;
    for (int a = D - 1; a >= 0; --a) bin = bin * size.bins[a] + place[a];
    bin_of_[i] = bin;
    ++size.start[bin + 1];
  }
  for (SizeClass& size : classes_) std::partial_sum(size.start.begin(), size.start.end(), size.start.begin());
  // Grains are put in from the last one on, so that those of a bin are in ascending order: start[bin + 1] runs down
  // from the bin's end to its beginning, which is the end of the bin before.
  for (std::size_t i = grains; i-- > 0;) {
    SizeClass& size = classes_[class_of_[i]];
    size.grains[--size.start[bin_of_[i] + 1]] = static_cast<int>(i);
  }
  for (SizeClass& size : classes_) {
    std::copy(size.start.begin() + 1, size.start.end(), size.start.begin());
    size.start.back() = size.count;
  }
}

template <int D>
template <bool SameClass>
void NeighbourSearch<D>::search_bin(int i, const SizeClass& size, int bin, const Image<D>& image, const Sight& sight,
                                    Findings& findings) const {
  const Vec<D> shift = lattice<D>(sight.cell.box, image) - sight.position[i];
  for (int k = size.start[bin]; k < size.start[bin + 1]; ++k) {
    const int j = size.grains[k];
    if (SameClass && (j < i || (j == i && !first_nonzero_positive<D>(image)))) continue;
    if (!sight.group.empty() && sight.group[i] >= 0 && sight.group[i] == sight.group[j]) continue;
    if (!sight.near(i, j, shift, sight.limit)) continue;
    if (SameClass || j > i)
      findings.own.push_back({j, image});
    else
      findings.others.push_back({j, {i, negative<D>(image)}});
  }
}

/// Neighbours of grain i among the grains of one class: its own one or one of larger grains.
template <int D>
void NeighbourSearch<D>::search_class(int i, int number, const Sight& sight, Findings& findings) const {
  const SizeClass& size = classes_[number];
  const bool same = number == class_of_[i];
  std::array<int, D> home, offset;
  if (same)
    for (int a = 0, bin = bin_of_[i]; a < D; bin /= size.bins[a], ++a) home[a] = bin % size.bins[a];
  else
    home = place_of(size, sight.to_fraction * sight.position[i]);
  for (int a = 0; a < D; ++a) offset[a] = -size.reach[a];
  for (bool more = true; more;) {
    int bin = 0;
    bool inside = true;
    Image<D> image{};
    for (int a = D - 1; a >= 0; --a) {
      const int bins = size.bins[a];
      int place = home[a] + offset[a];
      if (place < 0 || place >= bins) {
        inside = inside && sight.cell.periodic[a];
        image[a] = place >= 0 ? place / bins : -((bins - 1 - place) / bins);
        place -= image[a] * bins;
      }
      bin = bin * bins + place;
    }
    if (inside && same)
      search_bin<true>(i, size, bin, image, sight, findings);
    else if (inside)
      search_bin<false>(i, size, bin, image, sight, findings);
    more = false;
    for (int a = 0; a < D && !more; ++a) {
      more = ++offset[a] <= size.reach[a];
      if (!more) offset[a] = -size.reach[a];
    }
  }
}

template <int D>
void NeighbourSearch<D>::search_grain(int i, const Sight& sight, Findings& findings) const {
  const std::size_t begin = findings.own.size();
  for (int size = 0; size <= class_of_[i]; ++size) search_class(i, size, sight, findings);
  std::sort(findings.own.begin() + static_cast<std::ptrdiff_t>(begin), findings.own.end());
  for (std::size_t p = 0; p < sight.planes.size(); ++p)
    if (sight.near_plane(i, p, sight.limit))
      findings.own.push_back({static_cast<int>(sight.position.size() + p), Image<D>{}});
}

template <int D>
void NeighbourSearch<D>::search(const Sight& sight) {
  const std::size_t grains = sight.position.size();
  chunk_found_.resize(chunk_count(grains));
  found_count_.assign(grains, 0);
  // An exception must not leave a parallel region: each chunk keeps its own first failure.
  failures_.assign(chunk_count(grains), std::string());
  parallel_chunks(grains, [&](std::size_t chunk, std::size_t begin, std::size_t end) {
    Findings& findings = chunk_found_[chunk];
    findings.own.clear(), findings.others.clear();
    try {
      for (std::size_t i = begin; i < end; ++i) {
        const std::size_t before = findings.own.size();
        search_grain(static_cast<int>(i), sight, findings);
        found_count_[i] = static_cast<int>(findings.own.size() - before);
      }
    } catch (const RunError& error) {
      failures_[chunk] = error.what();
    }
  });
  for (const std::string& message : failures_)
    if (!message.empty()) throw RunError(message);
}

/// The pairs in the order of the chunks, where each was found from its first grain.
template <int D>
void NeighbourSearch<D>::list_found(int grains, PairColumns<D>& pairs) const {
  std::size_t total = 0;
  for (const Findings& findings : chunk_found_) total += findings.own.size();
  pairs.i.resize(total), pairs.j.resize(total), pairs.image.resize(total);
  std::size_t row = 0;
  for (std::size_t chunk = 0, i = 0; chunk < chunk_found_.size(); ++chunk) {
    std::size_t taken = 0;
    for (const std::size_t end = std::min<std::size_t>(grains, (chunk + 1) * chunk_size); i < end; ++i) {
      for (int k = 0; k < found_count_[i]; ++k, ++row, ++taken) {
        pairs.i[row] = static_cast<int>(i);
        pairs.j[row] = chunk_found_[chunk].own[taken].j;
        pairs.image[row] = chunk_found_[chunk].own[taken].image;
      }
    }
  }
}

/// The same with pairs that were found from their second grain: each grain's are brought together and sorted.
template <int D>
void NeighbourSearch<D>::list_from_both_sides(int grains, PairColumns<D>& pairs) {
  for (const Findings& findings : chunk_found_)
    for (const Found& found : findings.others) ++found_count_[found.i];
  first_.assign(grains + 1, 0);
  std::partial_sum(found_count_.begin(), found_count_.end(), first_.begin() + 1);
  copy_with_room(first_, cursor_);
  const std::size_t total = static_cast<std::size_t>(first_.back());
  merged_.resize(total);
  // Each chunk's own pairs are in the order of its grains; what others have found of a grain is not counted in them.
  for (const Findings& findings : chunk_found_)
    for (const Found& found : findings.others) {
      --found_count_[found.i];
      merged_[cursor_[found.i]++] = found.neighbour;
    }
  for (std::size_t chunk = 0, i = 0; chunk < chunk_found_.size(); ++chunk) {
    auto own = chunk_found_[chunk].own.begin();
    for (const std::size_t end = std::min<std::size_t>(grains, (chunk + 1) * chunk_size); i < end; ++i) {
      std::copy(own, own + found_count_[i], merged_.begin() + cursor_[i]);
      own += found_count_[i];
    }
  }
  pairs.i.resize(total), pairs.j.resize(total), pairs.image.resize(total);
  parallel_chunks(static_cast<std::size_t>(grains), [&](std::size_t, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      std::sort(merged_.begin() + first_[i], merged_.begin() + first_[i + 1]);
      for (int row = first_[i]; row < first_[i + 1]; ++row) {
        pairs.i[row] = static_cast<int>(i);
        pairs.j[row] = merged_[row].j;
        pairs.image[row] = merged_[row].image;
      }
    }
  });
}

template <int D>
MemoryUse NeighbourSearch<D>::memory() const {
  MemoryUse use;
  use.grains = bytes_of(bin_of_, class_of_, found_count_, first_, cursor_);
  for (const SizeClass& size : classes_) use.grains += bytes_of(size.start, size.grains);
  use.pairs = bytes_of(merged_);
  for (const Findings& findings : chunk_found_) use.pairs += bytes_of(findings.own, findings.others);
  return use;
}

template struct PairSight<2>;
template struct PairSight<3>;
template class NeighbourSearch<2>;
template class NeighbourSearch<3>;

}  // namespace galet
