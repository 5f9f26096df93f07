// Measures of a run that are too costly for each sample, or no single number: computed when it ends, and the profile, a
// mean over the rows of the series from run.average_from on. Only what output.measures asks for.
#pragma once

#include <optional>
#include <vector>

#include "common/core/archive.hpp"
#include "common/measure/elastic_moduli.hpp"
#include "common/measure/equilibrium_matrix.hpp"
#include "common/measure/force_distribution.hpp"
#include "common/measure/gap_distribution.hpp"
#include "common/measure/profile.hpp"
#include "common/scene/derive.hpp"
#include "common/scene/measure_names.hpp"
#include "common/scene/scene.hpp"

namespace galet {

/// The profile that the scene asks for: by layers, or by rings.
template <int D>
std::vector<ProfileRow> scene_profile(const Scene& scene, const Snapshot<D>& snapshot);

/// Sums of profiles taken at different times.
class ProfileAverage {
 public:
  void add(const std::vector<ProfileRow>& rows);
  long states() const { return states_; }
  /// Their mean; empty without any.
  std::vector<ProfileRow> mean() const;

  void save(Archive& archive) const;
  void restore(const Archive& archive);

 private:
  std::vector<ProfileRow> sums_;
  long states_ = 0;
};

struct FinalMeasures {
  std::optional<ForceDistribution> forces;
  std::vector<GapRow> gaps;  ///< gaps in units of d
  std::vector<ProfileRow> profile;
  long profile_states = 0;        ///< rows that the profile is a mean of; 0: it is that of the last state
  bool profile_by_rings = false;  ///< components are (r, theta, z), not (x, y, z)
  Vec<3> profile_normal = Vec<3>::UnitY();
  std::vector<double> local_solid_fraction;  ///< of each grain
  std::optional<Indeterminacy> indeterminacy;
  std::optional<ElasticModuli> moduli;
};

/// Largest gap of the distribution, and its step, in units of d.
inline constexpr double largest_gap = 0.5;
inline constexpr int gap_intervals = 100;

/// Of the last state. `sample` says what the grains are made of.
template <int D>
FinalMeasures final_measures(const Scene& scene, const Derived& derived, const Sample<D>& sample,
                             const Snapshot<D>& snapshot, const ProfileAverage& profile);

extern template FinalMeasures final_measures<2>(const Scene&, const Derived&, const Sample<2>&, const Snapshot<2>&,
                                                const ProfileAverage&);
extern template FinalMeasures final_measures<3>(const Scene&, const Derived&, const Sample<3>&, const Snapshot<3>&,
                                                const ProfileAverage&);

}  // namespace galet
