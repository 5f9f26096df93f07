#include "src/final_measures_json.hpp"

#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "common/measure/numbers.hpp"

namespace galet {

namespace {

using Json = nlohmann::ordered_json;

Json rows_json(const Eigen::MatrixXd& matrix) {
  Json rows = Json::array();
  for (long a = 0; a < matrix.rows(); ++a) {
    rows.push_back(Json::array());
    for (long b = 0; b < matrix.cols(); ++b) rows.back().push_back(matrix(a, b));
  }
  return rows;
}

Json histogram_json(const Histogram& histogram) {
  return {{"low", histogram.low},     {"width", histogram.width}, {"density", histogram.density},
          {"below", histogram.below}, {"above", histogram.above}, {"values", histogram.values}};
}

struct Spread {
  double mean = 0, deviation = 0;
};

/// Of the values that are numbers.
Spread spread_of(const std::vector<double>& values) {
  double sum = 0, squares = 0, count = 0;
  for (double value : values)
    if (!std::isnan(value)) sum += value, squares += value * value, ++count;
  const double mean = sum / count;
  return {mean, std::sqrt(std::max(0.0, squares / count - mean * mean))};
}

}  // namespace

Json measures_json(const FinalMeasures& measures) {
  Json json = Json::object();
  if (measures.forces) {
    const ForceDistribution& forces = *measures.forces;
    json["forces"] = {{"mean_normal", forces.mean_normal},
                      {"mean_tangential", forces.mean_tangential},
                      {"normal", histogram_json(forces.normal)},
                      {"tangential", histogram_json(forces.tangential)}};
  }
  for (const GapRow& row : measures.gaps) json["gaps"].push_back({{"gap", row.gap}, {"z", row.coordination}});
  if (!measures.profile.empty()) json["profile"] = {{"states", measures.profile_states}};
  if (!measures.local_solid_fraction.empty()) {
    const Spread local = spread_of(measures.local_solid_fraction);
    json["voronoi"] = {{"mean", local.mean}, {"standard_deviation", local.deviation}};
  }
  if (const auto& counts = measures.indeterminacy)
    json["indeterminacy"] = {{"forces", counts->forces},
                             {"freedoms", counts->freedoms},
                             {"rank", counts->rank},
                             {"indeterminacy", counts->indeterminacy()},
                             {"mechanisms", counts->mechanisms()}};
  if (const auto& moduli = measures.moduli)
    json["moduli"] = {{"bulk", moduli->bulk},
                      {"shear", moduli->shear},
                      {"affine_bulk", moduli->affine_bulk},
                      {"affine_shear", moduli->affine_shear},
                      {"stiffness", rows_json(moduli->stiffness)}};
  return json;
}

std::string measures_text(const FinalMeasures& measures) {
  std::string text;
  if (const auto& counts = measures.indeterminacy)
    text += fmt::format("network: {} forces, {} degrees of freedom; force indeterminacy {}, mechanisms {}\n",
                        counts->forces, counts->freedoms, counts->indeterminacy(), counts->mechanisms());
  if (const auto& moduli = measures.moduli)
    text += fmt::format("elastic moduli: bulk {:.4g}, shear {:.4g} (affine estimates {:.4g}, {:.4g})\n", moduli->bulk,
                        moduli->shear, moduli->affine_bulk, moduli->affine_shear);
  if (!measures.local_solid_fraction.empty()) {
    const Spread local = spread_of(measures.local_solid_fraction);
    text += fmt::format("Voronoi cells: Phi {:.4g}, standard deviation {:.2g}\n", local.mean, local.deviation);
  }
  return text;
}

namespace {

CsvTable force_table(const ForceDistribution& forces) {
  CsvTable table;
  table.comments = {fmt::format("x: force / its mean; means {:g} (normal), {:g} (tangential)", forces.mean_normal,
                                forces.mean_tangential),
                    "P_normal, P_tangential: probability densities"};
  table.columns = {{"x", ""}, {"P_normal", ""}, {"P_tangential", ""}};
  for (std::size_t k = 0; k < forces.normal.density.size(); ++k)
    table.rows.push_back({forces.normal.centre(k), forces.normal.density[k], forces.tangential.density[k]});
  return table;
}

CsvTable gap_table(const std::vector<GapRow>& rows) {
  CsvTable table;
  table.comments = {"gap: in units of d; z: mean number of neighbours of a grain up to that gap"};
  table.columns = {{"gap", ""}, {"z", ""}};
  for (const GapRow& row : rows) table.rows.push_back({row.gap, row.coordination});
  return table;
}

CsvTable direction_table(const std::vector<DirectionRow>& rows, const std::string& axes) {
  CsvTable table;
  table.comments = {fmt::format("angle: of the normal from {} towards {}, middle of the sector", axes[0], axes[1]),
                    "density: of contacts, 1 where they are isotropic",
                    "F_normal, F_tangential: mean of the sector / mean normal force of all; F_tangential along the "
                    "normal turned by 90 degrees"};
  table.columns = {{"angle", "deg"}, {"contacts", ""}, {"density", ""}, {"F_normal", ""}, {"F_tangential", ""}};
  for (const DirectionRow& row : rows) {
    table.rows.push_back({row.angle * 180 / std::numbers::pi, static_cast<std::int64_t>(row.contacts), row.density,
                          CsvCell{}, CsvCell{}});
    if (!std::isnan(row.normal_force))
      table.rows.back()[3] = row.normal_force, table.rows.back()[4] = row.tangential_force;
  }
  return table;
}

CsvTable voronoi_table(const std::vector<double>& phi) {
  CsvTable table;
  table.comments = {"Phi: volume of the grain / volume of its Voronoi cell"};
  table.columns = {{"grain", ""}, {"Phi", ""}};
  for (std::size_t i = 0; i < phi.size(); ++i) {
    table.rows.push_back({static_cast<std::int64_t>(i), {}});
    if (!std::isnan(phi[i])) table.rows.back()[1] = phi[i];
  }
  return table;
}

/// A row's cells; I and mu* refer to the stress across the layers.
std::vector<CsvCell> profile_cells(const ProfileRow& row, const Vec<3>& normal, const MeasureScale& scale) {
  const int dimension = scale.dimension;
  std::vector<CsvCell> cells = {row.position, static_cast<std::int64_t>(row.grains)};
  for (int a = 0; a < dimension; ++a) cells.emplace_back(row.velocity[a]);
  const Vec<3> traction = row.stress * normal;
  const double pressure = normal.dot(traction);
  const double rate = (row.shear_rate - normal.dot(row.shear_rate) * normal).norm();
  cells.insert(cells.end(), {rate, row.solid_fraction, row.fluctuation, row.temperature});
  for (int a = 0; a < dimension; ++a)
    for (int b = 0; b < dimension; ++b) cells.emplace_back(row.stress(a, b));
  cells.emplace_back(), cells.emplace_back();
  if (pressure > 0) {
    cells[cells.size() - 2] = (traction - pressure * normal).norm() / pressure;
    cells.back() = inertial_number(dimension, rate, pressure, scale.mass, scale.diameter);
  }
  return cells;
}

CsvTable profile_table(const FinalMeasures& measures, const MeasureScale& scale) {
  CsvTable table;
  table.comments = {measures.profile_states > 0
                        ? fmt::format("mean of {} states, one per row of the series", measures.profile_states)
                        : std::string("of the last state"),
                    measures.profile_by_rings
                        ? "r: middle of the ring; grains: centres in it; t: along theta; stresses: of contacts"
                        : "y: middle of the layer; grains: centres in it; shear_rate: of the velocity along the layer",
                    measures.profile_by_rings ? "mu_star, I: of the stress across the ring"
                                              : "mu_star, I: of the stress across the layer"};
  const auto unit = [&](const char* name) { return scale.si ? std::string(name) : std::string(); };
  table.columns = {{measures.profile_by_rings ? "r" : "y", unit("m")}, {"grains", ""}};
  const std::string axes = measures.profile_by_rings ? "rtz" : "xyz";
  const std::size_t dimension = static_cast<std::size_t>(scale.dimension);
  for (std::size_t a = 0; a < dimension; ++a) table.columns.push_back({std::string("v_") + axes[a], unit("m/s")});
  table.columns.insert(table.columns.end(),
                       {{"shear_rate", unit("1/s")}, {"Phi", ""}, {"fluctuation", unit("m2/s2")}, {"T", unit("J")}});
  for (std::size_t a = 0; a < dimension; ++a)
    for (std::size_t b = 0; b < dimension; ++b)
      table.columns.push_back({std::string("sigma_") + axes[a] + axes[b], unit(dimension == 2 ? "N/m" : "Pa")});
  table.columns.push_back({"mu_star", ""}), table.columns.push_back({"I", ""});
  for (const ProfileRow& row : measures.profile)
    table.rows.push_back(profile_cells(row, measures.profile_normal, scale));
  return table;
}

}  // namespace

std::vector<NamedTable> measure_tables(const FinalMeasures& measures, const MeasureScale& scale) {
  std::vector<NamedTable> tables;
  if (measures.forces) tables.push_back({"forces", force_table(*measures.forces)});
  if (!measures.gaps.empty()) tables.push_back({"gaps", gap_table(measures.gaps)});
  if (!measures.directions.empty())
    tables.push_back({"directions", direction_table(measures.directions, measures.direction_axes)});
  if (!measures.profile.empty()) tables.push_back({"profile", profile_table(measures, scale)});
  if (!measures.local_solid_fraction.empty())
    tables.push_back({"voronoi", voronoi_table(measures.local_solid_fraction)});
  return tables;
}

}  // namespace galet
