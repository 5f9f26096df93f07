// What a measured number says about a published one.
//   equal      agrees within the stated uncertainty u: |ours - value| <= u; else within two standard errors of ours:
//              |ours - value| <= 2 error (then a longer run could still tell them apart); else it differs
//   at_least   agrees when ours - 2 error >= value; within two errors when ours + 2 error >= value; else it differs
//   at_most    the mirror image of at_least
// A number without a value (NaN) leaves the question open.
#pragma once

#include <string>
#include <string_view>

#include "common/measure/block_average.hpp"

namespace galet {

enum class Claim { equal, at_least, at_most };

/// A published number. `basis`: where its uncertainty comes from, when the source states none.
struct Published {
  std::string_view key;
  Claim claim = Claim::equal;
  double value = 0;
  double uncertainty = 0;
  std::string_view source;
  std::string_view basis;
};

enum class Verdict { agrees, within_errors, differs, open };

Verdict judge(const Estimate& ours, const Published& published);

/// "yes", "yes (2 errors)", "NO", "-".
std::string to_string(Verdict verdict);

/// "0.26 ±0.01", ">= 0", "<= 0".
std::string claim_text(const Published& published);

}  // namespace galet
