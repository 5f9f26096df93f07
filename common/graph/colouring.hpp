// Colouring of the contacts so that contacts of one colour share no body: they may then be treated at the same time,
// or in SIMD lanes, with the same result in any order.
//
// Greedy, in the order of the contacts: each takes the lowest colour that neither of its bodies has used. Bodies that
// no contact can move (planes) and hubs (the cell, which every contact touches) take no part: a solver treats hubs
// between groups of contacts. Contacts that find no colour among `most_colours` go to an overflow group, to be
// treated one after the other. The result depends on the order of the contacts only, not on threads.
// Cost: one pass.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace galet {

struct Colouring {
  static constexpr int most_colours = 64;
  std::vector<int> order;  ///< contact indices, grouped by colour, ascending inside a colour
  std::vector<int> start;  ///< start[c] .. start[c + 1]: the entries of `order` with colour c
  bool overflow = false;   ///< the last group is no colour: its contacts share bodies
  int colours() const { return static_cast<int>(start.size()) - 1; }

  /// Colours the contacts (i[k], j[k]); bodies with index >= movable take no part. Memory is kept for `room` contacts.
  void colour(std::span<const int> i, std::span<const int> j, int movable, std::size_t room = 0);

 private:
  std::vector<std::uint64_t> used_;
  std::vector<int> colour_of_;
};

}  // namespace galet
