#include "src/final_measures.hpp"

#include "common/measure/radial_profile.hpp"
#include "common/measure/voronoi.hpp"

namespace galet {

namespace {

/// Every number of a profile's row but the count of grains, in one order.
template <class Row, class Visit>
void each_number(Row& row, const Visit& visit) {
  visit(row.position);
  for (int a = 0; a < 3; ++a) visit(row.velocity[a]);
  for (int a = 0; a < 3; ++a) visit(row.shear_rate[a]);
  visit(row.fluctuation), visit(row.temperature), visit(row.solid_fraction);
  for (int a = 0; a < 9; ++a) visit(row.stress.data()[a]);
}

}  // namespace

void ProfileAverage::add(const std::vector<ProfileRow>& rows) {
  if (sums_.size() != rows.size()) {
    sums_.assign(rows.size(), {});
    states_ = 0;
  }
  for (std::size_t k = 0; k < rows.size(); ++k) {
    std::vector<double> values;
    each_number(rows[k], [&](double value) { values.push_back(value); });
    std::size_t next = 0;
    each_number(sums_[k], [&](double& sum) { sum += values[next++]; });
    sums_[k].grains += rows[k].grains;
  }
  ++states_;
}

std::vector<ProfileRow> ProfileAverage::mean() const {
  if (states_ == 0) return {};
  std::vector<ProfileRow> rows = sums_;
  for (ProfileRow& row : rows) {
    each_number(row, [&](double& value) { value /= static_cast<double>(states_); });
    row.grains = static_cast<int>(row.grains / states_);
  }
  return rows;
}

void ProfileAverage::save(Archive& archive) const {
  std::vector<double>& flat = archive.reals["run.profile_sums"];
  std::vector<std::int64_t>& counts = archive.integers["run.profile_grains"];
  flat.clear(), counts.clear();
  for (const ProfileRow& row : sums_) {
    each_number(row, [&](double value) { flat.push_back(value); });
    counts.push_back(row.grains);
  }
  archive.integers["run.profile_states"] = {states_};
}

void ProfileAverage::restore(const Archive& archive) {
  const auto& counts = integer_column(archive, "run.profile_grains");
  const auto& flat = real_column(archive, "run.profile_sums");
  sums_.assign(counts.size(), {});
  std::size_t next = 0;
  for (std::size_t k = 0; k < sums_.size(); ++k) {
    each_number(sums_[k], [&](double& value) { value = flat.at(next++); });
    sums_[k].grains = static_cast<int>(counts[k]);
  }
  states_ = integer_column(archive, "run.profile_states").at(0);
}

template <int D>
std::vector<ProfileRow> scene_profile(const Scene& scene, const Snapshot<D>& snapshot) {
  const OutputSpec& output = scene.output;
  if (output.profile_centre.empty())
    return layer_profile(snapshot, output.profile_layers, static_cast<int>(output.profile_direction));
  const Vec<D> centre = Eigen::Map<const Vec<D>>(output.profile_centre.data());
  std::vector<ProfileRow> rows;
  for (const RingRow& ring :
       radial_profile<D>(snapshot, centre, output.profile_radii[0], output.profile_radii[1], output.profile_layers))
    rows.push_back({ring.position, ring.grains, ring.velocity, Vec<3>(0, ring.shear_rate, 0), ring.fluctuation,
                    ring.temperature, ring.solid_fraction, ring.stress});
  return rows;
}

template std::vector<ProfileRow> scene_profile<2>(const Scene&, const Snapshot<2>&);
template std::vector<ProfileRow> scene_profile<3>(const Scene&, const Snapshot<3>&);

namespace {

template <int D>
void put_profile(FinalMeasures& result, const Scene& scene, const Snapshot<D>& snapshot, const ProfileAverage& mean) {
  const int direction = static_cast<int>(scene.output.profile_direction);
  result.profile_by_rings = !scene.output.profile_centre.empty();
  result.profile = mean.mean();
  result.profile_states = mean.states();
  if (result.profile.empty()) result.profile = scene_profile(scene, snapshot);
  result.profile_normal = Vec<3>::UnitX();
  if (result.profile_by_rings) return;
  const Mat<D> inverse = snapshot.cell->box.inverse();
  result.profile_normal.setZero();
  result.profile_normal.head<D>() = inverse.row(direction).normalized().transpose();
}

/// Directions of strain that the loading leaves free.
template <int D>
std::vector<Mat<D>> free_strains(const Scene& scene, const Derived& derived, const Sample<D>& sample) {
  std::vector<Mat<D>> strains;
  for (const CellMode<D>& mode : cell_modes(scene, derived, sample))
    if (mode.stress_driven) strains.push_back(mode.direction);
  return strains;
}

}  // namespace

template <int D>
FinalMeasures final_measures(const Scene& scene, const Derived& derived, const Sample<D>& sample,
                             const Snapshot<D>& snapshot, const ProfileAverage& profile) {
  const MeasureSet asked(scene.output.measures);
  const double diameter = derived.grains.mean_diameter;
  const NetworkOptions options{derived.layout.friction, true};
  FinalMeasures result;
  if (asked.has(MeasureKind::forces)) result.forces = force_distribution(snapshot);
  if (asked.has(MeasureKind::gaps)) {
    result.gaps = gap_distribution(snapshot, largest_gap * diameter, gap_intervals);
    for (GapRow& row : result.gaps) row.gap /= diameter;
  }
  if (asked.has(MeasureKind::profile)) put_profile(result, scene, snapshot, profile);
  if (asked.has(MeasureKind::voronoi)) result.local_solid_fraction = local_solid_fraction(snapshot);
  if (asked.has(MeasureKind::indeterminacy))
    result.indeterminacy = indeterminacy(snapshot, options, free_strains(scene, derived, sample));
  if (asked.has(MeasureKind::moduli)) {
    const auto stiffness = contact_stiffness(snapshot, derived.laws, sample.material, sample.plane_material);
    result.moduli = elastic_moduli(snapshot, stiffness, options);
  }
  return result;
}

template FinalMeasures final_measures<2>(const Scene&, const Derived&, const Sample<2>&, const Snapshot<2>&,
                                         const ProfileAverage&);
template FinalMeasures final_measures<3>(const Scene&, const Derived&, const Sample<3>&, const Snapshot<3>&,
                                         const ProfileAverage&);

}  // namespace galet
