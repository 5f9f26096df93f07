// The measures that a scene may ask for by name (output.measures), beyond those of every run.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

namespace galet {

enum class MeasureKind {
  fabric,
  friction,
  temperature,
  balance,
  forces,
  gaps,
  directions,
  profile,
  voronoi,
  indeterminacy,
  moduli,
  count
};

struct MeasureInfo {
  std::string_view name;
  bool in_series;  ///< a column of the series, at each sample; else computed at the end (the profile: at each row)
  std::string_view meaning;
};

inline constexpr std::array<MeasureInfo, static_cast<int>(MeasureKind::count)> measure_table = {{
    {"fabric", true, "anisotropies of contacts and forces"},
    {"friction", true, "mobilised friction and share of sliding contacts"},
    {"temperature", true, "granular temperatures"},
    {"balance", true, "resultants on grains over contact forces"},
    {"forces", false, "distributions of normal and tangential forces"},
    {"gaps", false, "coordination by gap"},
    {"directions", false,
     "contacts and forces by direction, in the plane of the shear or through the axis of compression"},
    {"profile", false, "velocity, shear rate, solid fraction, temperature and stress by layers, averaged over rows"},
    {"voronoi", false, "solid fraction of each grain's Voronoi cell"},
    {"indeterminacy", false, "degree of force indeterminacy"},
    {"moduli", false, "elastic moduli of the contact network"},
}};

/// A set of measures.
class MeasureSet {
 public:
  MeasureSet() = default;
  /// Names that no measure has are passed over: scene files are checked when they are read.
  explicit MeasureSet(const std::vector<std::string>& names) {
    for (const std::string& name : names)
      for (std::size_t k = 0; k < measure_table.size(); ++k)
        if (measure_table[k].name == name) bits_ |= 1u << k;
  }
  bool has(MeasureKind kind) const { return (bits_ >> static_cast<int>(kind) & 1u) != 0; }
  void add(MeasureKind kind) { bits_ |= 1u << static_cast<int>(kind); }

 private:
  unsigned bits_ = 0;
};

}  // namespace galet
