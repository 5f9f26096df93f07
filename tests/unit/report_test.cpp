// The report of a folder of results: what it says is what the files hold, and it needs nothing but itself.
#include "src/report/report.hpp"

#include <cmath>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "common/core/error.hpp"
#include "common/io/checkpoint.hpp"
#include "common/io/files.hpp"
#include "common/io/program.hpp"
#include "src/report/figures.hpp"
#include "src/report/html.hpp"
#include "src/run_files.hpp"
#include "src/simulation.hpp"
#include "src/text_table.hpp"
#include "tests/support/temporary_folder.hpp"

namespace galet::test::report_test {
namespace {

constexpr const char* scene_text = R"(title = "Shear <of> few & \"disks\""
grains.count = 30
material.friction = 0.4
material.restitution = 0.1
material.stiffness_level = 1e3
initial = {kind = "gas", solid_fraction = 0.5}
loading = {kind = "plane_shear", pressure = 1, inertial_number = 0.2}
run = {duration = 8, samples = 40}
cd = {dt_factor = 0.02, tolerance = 1e-2}
output.measures = ["forces", "gaps", "profile", "voronoi", "directions", "friction", "indeterminacy", "moduli"]
)";

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

template <int D>
void run_into(const std::string& folder, const std::string& text, EngineKind kind) {
  const std::vector<Override> changes = {{"seed", "3"}};
  Simulation<D> simulation(parse_scene(text, "scene.toml", changes), kind, changes);
  const RunResult result = simulation.run();
  write_run(result, simulation, simulation.scene().title, folder);
  write_checkpoint(folder + (kind == EngineKind::md ? "/md" : "/cd") + "_checkpoint.h5", simulation.checkpoint());
}

TEST(Report, HoldsWhatTheFilesSay) {
  const test::TemporaryFolder folder;
  run_into<2>(folder.path(), scene_text, EngineKind::cd);
  const report::RunFolder results = report::read_run_folder(folder.path());
  ASSERT_EQ(results.runs.size(), 1u);
  const std::string page = report::report_html(results);

  EXPECT_TRUE(has(page, "<h1>Shear &lt;of&gt; few &amp; &quot;disks&quot;</h1>"));
  EXPECT_TRUE(has(page, "material.stiffness_level = 1e3\n")) << "the scene's text";
  EXPECT_TRUE(has(page, "--set seed=3\n"));
  for (const report::EngineRun& run : results.runs) {
    const auto& mu = run.summary.at("averages").at("mu_star");
    EXPECT_TRUE(has(page, "<td>" + short_number(report::number(mu, "value"), 5) + "</td><td>± " +
                              short_number(report::number(mu, "error"), 2) + "</td>"));
    EXPECT_TRUE(has(page, "<code>" + report::text(run.summary, "state_hash") + "</code>"));
    for (const auto& line : run.summary.at("origin").at("derived"))
      EXPECT_TRUE(has(page, report::escaped(report::text(line, "from")))) << line;
    EXPECT_GT(run.summary.at("origin").at("derived").size(), 5u);
    const std::vector<report::NamedFigure> figures = report::series_figures(run);
    ASSERT_FALSE(figures.empty());
    EXPECT_EQ(figures[0].name, "mu_star");
    EXPECT_EQ(figures[0].figure.series.at(0).x.size(), static_cast<std::size_t>(run.series->rows()));
    EXPECT_EQ(report::distribution_figures(run).size(), 3u);
    EXPECT_GE(report::profile_figures(run).size(), 4u);
  }
  EXPECT_TRUE(has(page, "Contact directions of the last state"));
  EXPECT_TRUE(has(page, "degree of force indeterminacy"));
  EXPECT_TRUE(has(page, "steps that missed the tolerance"));

  // Nothing outside of the page: no address is fetched, no path of this machine is told.
  for (const char* outside : {"src=\"http", "href=\"http", "url(http", "@import", "<script", "<link"})
    EXPECT_FALSE(has(page, outside)) << outside;
  EXPECT_FALSE(has(page, folder.path()));
  if (run_program({"gnuplot", "-V"}).found) {
    EXPECT_FALSE(has(page, "need gnuplot"));
    // Each picture's parts are its own.
    for (const char* name : {"mu_star", "forces", "profile_velocity"})
      EXPECT_TRUE(has(page, fmt::format("id=\"cd-{}-gnuplot_plot_1\"", name))) << name;
  }
  EXPECT_TRUE(has(page, "id=\"cd-sample-cell\"") && has(page, "url(#cd-sample-cell)"));
  EXPECT_FALSE(has(page, "id=\"cell\""));
}

// A run that failed has neither averages of its end nor a picture, but says why.
TEST(Report, OfAFailedRun) {
  const test::TemporaryFolder folder;
  const std::string text = std::string(scene_text) + "guard = {every = 10, speed = 1e-3}\n";
  Simulation<2> simulation(parse_scene(text, "scene.toml"), EngineKind::md);
  const RunResult result = simulation.run();
  ASSERT_EQ(result.ending, Ending::failed);
  write_run(result, simulation, "scene", folder.path());
  const std::string page = report::report_html(report::read_run_folder(folder.path()));
  EXPECT_TRUE(has(page, "<b>The run failed</b>"));
  EXPECT_TRUE(has(page, report::escaped(result.failure)));
  EXPECT_TRUE(has(page, "guard = {every = 10"));
}

/// The message with which reading is refused; empty when it is read.
std::string refusal(const std::string& path) {
  try {
    report::read_run_folder(path);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(Report, RefusesWhatIsNoFolderOfResults) {
  const test::TemporaryFolder folder;
  EXPECT_TRUE(has(refusal(folder.file("absent")), "is no folder"));
  EXPECT_TRUE(has(refusal(folder.path()), "holds no results"));
  write_file(folder.file("md_summary.json"), "{\"scene\": ");
  EXPECT_TRUE(has(refusal(folder.path()), "md_summary.json"));
  EXPECT_TRUE(has(refusal(folder.path()), "no whole JSON file"));
  write_file(folder.file("md_summary.json"), "[1, 2]");
  EXPECT_TRUE(has(refusal(folder.path()), "no summary of a run"));
}

TEST(ReportHtml, Pieces) {
  EXPECT_EQ(report::html_symbol("sigma_xy"), "σ<sub>xy</sub>");
  EXPECT_EQ(report::plot_symbol("sigma_xy"), "σ_{xy}");
  EXPECT_EQ(report::html_symbol("dissipated_sliding"), "dissipated sliding");
  EXPECT_EQ(
      report::inline_svg("<?xml?>\n<svg width=\"9\" height='8' height=\"7\" viewBox=\"0 0 1 1\"><title>t</title>"
                         "<defs><clipPath id=\"a\"/></defs><g clip-path=\"url(#a)\"/><use xlink:href='#b'/></svg>",
                         "p-"),
      "<svg height='8' viewBox=\"0 0 1 1\"><defs><clipPath id=\"p-a\"/></defs><g clip-path=\"url(#p-a)\"/><use "
      "xlink:href='#p-b'/></svg>");
  EXPECT_EQ(report::inline_svg("no picture", "p-"), "");
}

}  // namespace
}  // namespace galet::test::report_test
