#include "src/report/figures.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "common/io/files.hpp"
#include "common/io/scratch_folder.hpp"
#include "common/measure/histogram.hpp"
#include "src/report/html.hpp"

namespace galet::report {

namespace {

std::vector<double> column(const NumberTable& table, int index) {
  std::vector<double> values;
  for (int row = 0; row < table.rows(); ++row) values.push_back(table.at(row, index));
  return values;
}

/// Worth drawing: some value that is a number and not zero.
bool says_something(const std::vector<double>& values) {
  return std::any_of(values.begin(), values.end(), [](double value) { return std::isfinite(value) && value != 0; });
}

/// What one figure of columns shows.
struct Plan {
  std::string name, title, y_label;
  std::vector<std::string> columns;
  bool log_y = false;
  std::string caption;
};

std::string axis_label(const NumberTable& table, int index) {
  const CsvColumn& shown = table.columns[static_cast<std::size_t>(index)];
  return plot_symbol(shown.name) + (shown.unit.empty() ? "" : " [" + shown.unit + "]");
}

/// Columns of one table against another of its columns (`upright`: that one is drawn upwards). No series where the
/// table has none of the columns.
NamedFigure draw(const Plan& plan, const NumberTable& table, const std::string& against, bool upright) {
  NamedFigure result{plan.name, plan.caption, {}};
  Figure& figure = result.figure;
  figure.title = plan.title;
  figure.log_y = plan.log_y;
  const auto base = table.find(against);
  if (!base) return result;
  std::string unit;
  for (const std::string& name : plan.columns) {
    const auto index = table.find(name);
    if (!index) continue;
    std::vector<double> values = column(table, *index);
    if (!says_something(values)) continue;
    unit = table.columns[static_cast<std::size_t>(*index)].unit;
    Series series{plot_symbol(name), column(table, *base), std::move(values), {}, true};
    if (upright) std::swap(series.x, series.y);
    figure.series.push_back(std::move(series));
  }
  const std::string label = plan.y_label + (unit.empty() ? "" : " [" + unit + "]");
  figure.x_label = upright ? label : axis_label(table, *base);
  figure.y_label = upright ? axis_label(table, *base) : label;
  if (figure.series.size() == 1) figure.series.front().label.clear();  // the axis says it
  return result;
}

std::vector<NamedFigure> draw_all(const std::vector<Plan>& plans, const NumberTable& table, const std::string& against,
                                  bool upright) {
  std::vector<NamedFigure> figures;
  for (const Plan& plan : plans) {
    NamedFigure figure = draw(plan, table, against, upright);
    if (!figure.figure.series.empty()) figures.push_back(std::move(figure));
  }
  return figures;
}

}  // namespace

std::vector<NamedFigure> series_figures(const EngineRun& run) {
  if (!run.series || run.series->rows() < 2) return {};
  const bool sheared = number(run.summary, "strain") != 0 && !run.summary.contains("stages");
  std::vector<Plan> plans;
  if (number(run.summary, "strain") != 0)
    plans.push_back({"mu_star", "Stress ratio", "μ* = |σ_{xy}| / σ_{yy}", {"mu_star"}, false, ""});
  plans.insert(
      plans.end(),
      {{"stress",
        "Stress",
        "σ",
        {"sigma_xx", "sigma_yy", "sigma_zz", "sigma_xy", "sigma_xz", "sigma_yz"},
        false,
        "Positive in compression."},
       {"phi", "Solid fraction", "Φ", {"Phi"}, false, ""},
       {"z", "Coordination number", "z, z*", {"z", "z_star"}, false, "z: all grains; z*: without rattlers."},
       {"rattlers", "Rattlers", "share of the grains", {"rattler_fraction"}, false, ""},
       {"strain",
        "Strain of the cell",
        "ε",
        {"eps_xx", "eps_yy", "eps_zz", "eps_v"},
        false,
        "Positive in compression."},
       {"overlap",
        "Overlap of contacts",
        "overlap / d",
        {"mean_overlap", "peak_overlap"},
        true,
        "Mean of the contacts, and the largest of all samples."},
       {"kinetic", "Kinetic energy per grain", "energy", {"kinetic_per_grain"}, true, "Of fluctuations and rotations."},
       {"inertial", "Inertial number as realised", "I", {"I"}, true, ""},
       {"anisotropy",
        "Anisotropies along the stress",
        "a",
        {"a_c", "a_n", "a_t", "a_l"},
        false,
        "Of contacts, normal forces, tangential forces, branches."},
       {"friction",
        "Friction",
        "share",
        {"mobilised", "sliding"},
        false,
        "Mean of |F<sub>T</sub>| / its bound; share of sliding contacts."},
       {"temperature", "Granular temperature", "T", {"T", "T_rot"}, true, ""},
       {"balance",
        "Unbalanced force and torque",
        "relative to contact forces",
        {"unbalanced_force", "unbalanced_torque"},
        true,
        "0 in equilibrium."},
       {"budget",
        "Energy budget",
        "energy so far",
        {"work", "dissipated_viscous", "dissipated_sliding", "dissipated_unloading", "dissipated_rolling",
         "dissipated_pivoting", "dissipated_relaxation"},
        false,
        ""}});
  return draw_all(plans, *run.series, sheared ? "strain" : "time", false);
}

std::vector<NamedFigure> profile_figures(const EngineRun& run) {
  if (!run.profile) return {};
  const std::string against = run.profile->find("r") ? "r" : "y";
  std::vector<NamedFigure> figures =
      draw_all({{"profile_velocity",
                 "Velocity",
                 "velocity",
                 {"v_x", "v_y", "v_z", "v_r", "v_t"},
                 false,
                 "Mean over the grains of a layer."},
                {"profile_rate", "Shear rate", "shear rate", {"shear_rate"}, false, ""},
                {"profile_phi", "Solid fraction", "Φ", {"Phi"}, false, "Grains are cut exactly at the layers."},
                {"profile_stress",
                 "Stress",
                 "σ",
                 {"sigma_xx", "sigma_yy", "sigma_zz", "sigma_xy", "sigma_rr", "sigma_rt", "sigma_tt"},
                 false,
                 "Contact part. Positive in compression."},
                {"profile_temperature", "Granular temperature", "T", {"T"}, false, ""},
                {"profile_mu",
                 "Stress ratio and inertial number",
                 "μ*, I",
                 {"mu_star", "I"},
                 false,
                 "Of the stress across the layers."}},
               *run.profile, against, true);
  // Layers may be cut along any direction, whatever their column is called.
  for (NamedFigure& figure : figures) {
    const std::string label = figure.figure.y_label;
    figure.figure.y_label = (against == "r" ? "distance from the axis" : "place across the layers") + label.substr(1);
  }
  return figures;
}

namespace {

NamedFigure voronoi_figure(const NumberTable& table) {
  NamedFigure result{"voronoi",
                     "Grain volume / volume of its radical Voronoi cell.",
                     {"Local solid fraction", "Φ of a grain's cell", "probability density", false, false, {}}};
  const auto index = table.find("Phi");
  if (!index) return result;
  std::vector<double> values = column(table, *index);
  std::erase_if(values, [](double value) { return !std::isfinite(value); });
  if (values.size() < 2) return result;
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  if (!(*high > *low)) return result;
  // Intervals as narrow as leave about ten grains in each.
  const int intervals = std::clamp(static_cast<int>(values.size() / 10), 8, 40);
  const Histogram shown = histogram(values, *low, *high, intervals);
  Series series;
  series.line = true;
  for (std::size_t k = 0; k < shown.density.size(); ++k)
    series.x.push_back(shown.centre(k)), series.y.push_back(shown.density[k]);
  result.figure.series.push_back(std::move(series));
  return result;
}

}  // namespace

std::vector<NamedFigure> distribution_figures(const EngineRun& run) {
  std::vector<NamedFigure> figures;
  const auto add = [&](std::vector<NamedFigure> more) {
    for (NamedFigure& figure : more) figures.push_back(std::move(figure));
  };
  if (run.forces) {
    add(draw_all({{"forces",
                   "Contact forces of the last state",
                   "probability density",
                   {"P_normal", "P_tangential"},
                   true,
                   "Forces in units of their means."}},
                 *run.forces, "x", false));
    if (!figures.empty()) figures.back().figure.x_label = "force / mean force";
  }
  if (run.gaps) {
    add(draw_all({{"gaps", "Neighbours up to a gap", "mean number of neighbours", {"z"}, false, ""}}, *run.gaps, "gap",
                 false));
    if (!figures.empty() && figures.back().name == "gaps") figures.back().figure.x_label = "gap / d";
  }
  if (run.voronoi) {
    NamedFigure figure = voronoi_figure(*run.voronoi);
    if (!figure.figure.series.empty()) figures.push_back(std::move(figure));
  }
  return figures;
}

std::string figures_html(const std::string& heading, const std::vector<NamedFigure>& figures,
                         const std::string& prefix) {
  if (figures.empty()) return "";
  const ScratchFolder folder;
  std::string html = fmt::format("<h3>{}</h3>\n<div class=\"figures\">\n", heading);
  for (const NamedFigure& figure : figures) {
    const std::string svg = write_figure(folder.file(figure.name), figure.figure);
    if (svg.empty())
      return fmt::format(
          "<h3>{}</h3>\n<p class=\"warning\">Figures need gnuplot, which is not installed (Debian "
          "package gnuplot-nox).</p>\n",
          heading);
    html += fmt::format("<figure>{}<figcaption>{}</figcaption></figure>\n",
                        inline_svg(read_file(svg), prefix + figure.name + "-"), figure.caption);
  }
  return html + "</div>\n";
}

}  // namespace galet::report
