// The contact pass over blocks of rows, compiled once per width of the lanes.
#pragma once

#include "md/kernel/rows.hpp"

namespace galet::md {

/// The work on W rows is one long chain of operations of which each waits for the last. So three groups of rows are on
/// their way at a time, each a stage behind the next: where the grains are, how they move and what the spring has
/// become in their frame, the laws. The processor finds work in all three. Past the end of the range its last block is
/// looked at again in vain: the next one may be written by another thread.
template <Layout Y, Kernel K, int W>
class Stages {
 public:
  GALET_INLINE Stages(const PassView& view, std::size_t begin, std::size_t end, LaneSums& sums)
      : view_(view), rows_(view, sums), group_(begin * groups), end_(end * groups) {
    present_ = rows_.meet(place(group_), block(group_), lane(group_));
    next_ = place(group_ + 1);
  }
  GALET_INLINE bool left() const { return group_ < end_; }
  GALET_INLINE void advance() {
    fetch(group_ + ahead);
    rows_.evaluate(present_, group_ / groups, lane(group_));
    ++group_;
    present_ = rows_.meet(next_, block(group_), lane(group_));
    next_ = place(group_ + 1);
  }

 private:
  static constexpr std::size_t groups = block_rows / W;  ///< of a block
  static constexpr std::size_t ahead = 6 * groups;       ///< measured; 4 to 12 blocks are alike

  GALET_INLINE std::size_t block(std::size_t group) const { return group < end_ ? group / groups : end_ / groups - 1; }
  GALET_INLINE static int lane(std::size_t group) { return static_cast<int>(group % groups) * W; }
  /// What is read some blocks later is asked for now: columns and blocks of rows, in whose stream the processor's own
  /// guesses fall behind in large samples, and records of second members, which lie anywhere in memory.
  GALET_INLINE void fetch(std::size_t group) const {
    if (groups == 1 || group % groups == 0) {
      const double* columns = view_.columns + block(group) * view_.column_count * block_rows;
      for (int line = 0; line < RowColumns<Y>::count(false); ++line) __builtin_prefetch(columns + line * block_rows);
      const RowBlock* later = view_.blocks + block(group + ahead);
      __builtin_prefetch(later), __builtin_prefetch(reinterpret_cast<const char*>(later) + 64);
      const double* out = view_.out + block(group) * block_rows * out_size(Y);
      for (int line = 0; line < out_size(Y); ++line) __builtin_prefetch(out + line * block_rows, 1);
    }
    const std::uint32_t* second = view_.blocks[block(group)].j + lane(group);
    for (int k = 0; k < W; ++k)
      for (int line = 0; line < record_size(Y); line += 8)
        __builtin_prefetch(at_bytes(view_.records, second[k]) + line);
  }
  GALET_INLINE Place<Y, W> place(std::size_t group) const {
    return place_of<Y, W>(view_, view_.blocks[block(group)], lane(group));
  }

  const PassView& view_;
  Rows<Y, K, W> rows_;
  typename Rows<Y, K, W>::Pair present_;
  Place<Y, W> next_;
  std::size_t group_, end_;
};

template <Layout Y, Kernel K, int W>
void evaluate_blocks(const PassView& given, std::size_t begin, std::size_t end, LaneSums& sums) {
  if (begin == end) return;
  const PassView view = given;  // a copy that nothing else can change: it stays in registers
  Stages<Y, K, W> stages(view, begin, end, sums);
  while (stages.left()) stages.advance();
}

/// The kernels of one layout.
template <Layout Y, int W>
PassFunction pass_of_width(Kernel kernel) {
  if (kernel.account) return evaluate_blocks<Y, Kernel{true, false, true}, W>;
  if (kernel.general) return evaluate_blocks<Y, Kernel{true, false, false}, W>;
  if (kernel.hertz) return evaluate_blocks<Y, Kernel{false, true, false}, W>;
  return evaluate_blocks<Y, Kernel{false, false, false}, W>;
}

}  // namespace galet::md
