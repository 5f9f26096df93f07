// One sweep of the md step: contacts, and grains as soon as all of their rows are there, the end of one step and the
// beginning of the next in one. A strip of grains at a time: its rows and records are then still in the cache, which
// saves a sixth of the time of samples that don't fit there. Each grain sums the same rows in the same order as after
// all contacts, so the result has the same bits.
//
// Rows are in the order of their first members, and the first member comes before the second: rows of the grains up to
// g are all that g waits for, and no later row reads its record. Each thread has a range of blocks and the grains whose
// rows begin there. Grains with rows in the blocks of another thread wait until all threads are done.
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "common/core/memory_use.hpp"
#include "common/core/parallel.hpp"
#include "common/core/profile.hpp"
#include "common/neighbour/verlet_list.hpp"
#include "md/kernel/view.hpp"

namespace galet::md {

class Sweep {
 public:
  /// The list has changed.
  void forget() { parts_.clear(); }

  std::size_t bytes() const { return bytes_of(parts_, runs_, waiting_); }

  /// Shares the work among the threads in use. Returns how many parts there are.
  template <int D>
  std::size_t plan(const VerletList<D>& list, std::size_t blocks) {
    const std::size_t most = std::max<std::size_t>(1, blocks / least_blocks);
    const std::size_t parts = std::min(static_cast<std::size_t>(thread_count()), most);
    if (parts_.size() != parts) share(list, blocks, parts);
    return parts;
  }

  /// rows(begin, end): evaluates blocks; grains(part, begin, end): steps grains. `first`: VerletList::first.
  template <class Rows, class Grains>
  void run(std::span<const int> first, const Rows& rows, const Grains& grains, Profile& profile) const {
    const std::size_t parts = parts_.size();
    const auto each_part = [&](const auto& work) {
      const auto range = [&](std::size_t begin, std::size_t end) {
        for (std::size_t part = begin; part < end; ++part) work(part);
      };
      parallel_ranges(parts, range, 1);
    };
    each_part([&](std::size_t part) { sweep(part, first, rows, grains, profile); });
    if (waiting_.empty()) return;
    StageTimer timer(profile, Stage::grains);
    each_part([&](std::size_t part) {
      for (std::size_t k = waiting_.size() * part / parts; k < waiting_.size() * (part + 1) / parts; ++k)
        grains(part, waiting_[k].begin, waiting_[k].end);
    });
  }

 private:
  /// Measured at 4096 to 900000 spheres and disks; 256 to 1024 are alike.
  static constexpr std::size_t strip = 512;
  /// Fewer blocks are not worth waking a thread.
  static constexpr std::size_t least_blocks = 64;

  /// Samples of fewer grains a thread fit in its own cache, and are better worked on in two goes.
  static constexpr std::size_t fitting = 8192;
  /// Those that wait are given to the threads in runs of so many.
  static constexpr std::size_t shared = 64;
  /// Grains that share lines of records: no thread reads what another one writes meanwhile.
  static constexpr std::size_t together = 2;

  struct Run {
    std::size_t begin, end;  ///< grains
  };
  struct Part {
    std::size_t block, block_end, grain, grain_end;
    std::size_t run, run_end;  ///< of grains that don't wait
  };

  /// Adds the time of one part's calls to the profile; that of the others passes meanwhile.
  template <class Call>
  static void timed(bool wanted, Profile& profile, Stage stage, const Call& call) {
    if (!wanted) return call();
    StageTimer timer(profile, stage);
    call();
  }

  template <class Rows, class Grains>
  void sweep(std::size_t index, std::span<const int> first, const Rows& rows, const Grains& grains,
             Profile& profile) const {
    const Part& part = parts_[index];
    std::size_t done = part.block, run = part.run;
    const auto evaluate = [&](std::size_t end) {
      if (end <= done) return;
      timed(index == 0, profile, Stage::contacts, [&] { rows(done, end); });
      done = end;
    };
    for (std::size_t begin = part.grain; begin < part.grain_end; begin += strip) {
      const std::size_t end = std::min(part.grain_end, begin + strip);
      evaluate(std::min(part.block_end, (static_cast<std::size_t>(first[end]) + block_rows - 1) / block_rows));
      timed(index == 0, profile, Stage::grains, [&] {
        for (; run < part.run_end && runs_[run].begin < end; ++run) {
          grains(index, std::max(begin, runs_[run].begin), std::min(end, runs_[run].end));
          if (runs_[run].end > end) break;
        }
      });
    }
    evaluate(part.block_end);
  }

  template <int D>
  void share(const VerletList<D>& list, std::size_t blocks, std::size_t parts) {
    const std::span<const int> first = list.first(), second = list.second(), of_second = list.rows_of_second();
    const std::size_t grains = first.size() - 1;
    parts_.clear(), runs_.clear(), waiting_.clear();
    if (parts > 1)  // no list of this sample needs more
      for (std::vector<Run>* runs : {&runs_, &waiting_}) runs->reserve(grains / together + parts);
    const bool all_wait = parts > 1 && grains < parts * fitting;
    std::size_t grain = 0;
    for (std::size_t k = 0; k < parts; ++k) {
      Part part{blocks * k / parts, blocks * (k + 1) / parts, grain, grains, runs_.size(), 0};
      const auto begin = static_cast<int>(part.block * block_rows), end = static_cast<int>(part.block_end * block_rows);
      const auto waits = [&](std::size_t g) {
        const int lowest = second[g] < second[g + 1] ? std::min(of_second[second[g]], first[g]) : first[g];
        return lowest < begin || first[g + 1] > end;
      };
      if (k + 1 < parts) {
        const auto from = first.begin() + static_cast<std::ptrdiff_t>(grain);
        part.grain_end = static_cast<std::size_t>(std::lower_bound(from, first.end() - 1, end) - first.begin());
        part.grain_end = std::min(grains, (part.grain_end + together - 1) / together * together);
      }
      while (grain < part.grain_end) {
        const std::size_t next = std::min(part.grain_end, grain + together);
        bool wait = all_wait;
        for (std::size_t g = grain; g < next; ++g) wait |= parts > 1 && waits(g);
        if (wait)
          append(waiting_, 0, shared, {grain, next});
        else
          append(runs_, part.run, grains, {grain, next});
        grain = next;
      }
      part.run_end = runs_.size();
      parts_.push_back(part);
    }
  }
  /// Makes the last run longer where the next is right behind it, if it is not before `from`; up to `most` grains.
  static void append(std::vector<Run>& runs, std::size_t from, std::size_t most, const Run& next) {
    if (runs.size() > from && runs.back().end == next.begin && next.end - runs.back().begin <= most)
      runs.back().end = next.end;
    else
      runs.push_back(next);
  }

  std::vector<Part> parts_;
  std::vector<Run> runs_, waiting_;
};

}  // namespace galet::md
