// Picture of a 2D sample with its force chains: grains as disks, contact forces as lines whose width grows with the
// normal force, the cell, a scale and a legend.
#pragma once

#include <string>

#include "common/engine/snapshot.hpp"

namespace galet {

struct SvgOptions {
  std::string title;
  double width = 900;  ///< pixels
};

std::string force_chain_svg(const Snapshot<2>& snapshot, const SvgOptions& options);

}  // namespace galet
