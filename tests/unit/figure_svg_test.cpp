// Pictures: what is drawn, how often and where; that names and labels can't run commands.
#include <cstdlib>
#include <filesystem>
#include <sstream>

#include <gtest/gtest.h>

#include "common/core/error.hpp"
#include "common/io/figure.hpp"
#include "common/io/svg.hpp"
#include "tests/support/brute_force.hpp"
#include "tests/support/temporary_folder.hpp"

namespace galet::test::figure_svg_test {
namespace {

using test::file_bytes;
using test::TemporaryFolder;

int occurrences(const std::string& text, const std::string& piece) {
  int count = 0;
  for (std::size_t place = text.find(piece); place != std::string::npos; place = text.find(piece, place + 1)) ++count;
  return count;
}

/// The pieces of `text` that stand between `before` and the next `after`.
std::vector<std::string> pieces(const std::string& text, const std::string& before, const std::string& after) {
  std::vector<std::string> found;
  for (std::size_t place = text.find(before); place != std::string::npos; place = text.find(before, place + 1)) {
    const std::size_t begin = place + before.size();
    found.push_back(text.substr(begin, text.find(after, begin) - begin));
  }
  return found;
}

/// Every opened element is closed, in order; every & begins an entity; every number is one.
::testing::AssertionResult well_formed(const std::string& svg) {
  std::vector<std::string> open;
  for (const std::string& tag : pieces(svg, "<", ">")) {
    const std::string name = tag.substr(0, tag.find_first_of(" /", 1));
    if (name[0] == '/') {
      if (open.empty() || "/" + open.back() != name) return ::testing::AssertionFailure() << "unexpected <" << name;
      open.pop_back();
    } else if (!tag.ends_with('/')) {
      open.push_back(name);
    }
  }
  if (!open.empty()) return ::testing::AssertionFailure() << open.back() << " is not closed";
  for (const std::string& entity : pieces(svg, "&", ";"))
    if (entity != "amp" && entity != "lt" && entity != "gt") return ::testing::AssertionFailure() << "a bare &";
  if (svg.find("nan") != std::string::npos) return ::testing::AssertionFailure() << "a coordinate that is no number";
  return ::testing::AssertionSuccess();
}

struct Scenery {
  Sample<2> sample;
  ContactColumns<2> contacts;
  std::string svg(const std::string& title = "t") const {
    return force_chain_svg(test::snapshot_of(sample, contacts), {title, 900});
  }
  void add(int i, int j, const Vec<2>& branch, double force) {
    contacts.i.push_back(i);
    contacts.j.push_back(j);
    contacts.image.push_back({0, 0});
    contacts.normal.push_back(branch.normalized());
    contacts.branch.push_back(branch);
    contacts.gap.push_back(0);
    contacts.force.push_back(force * branch.normalized());
  }
};

/// Grains of diameter 1 at the given places in a periodic 10 x 10 cell.
Scenery scenery(const std::vector<Vec<2>>& places) {
  Scenery result;
  result.sample.resize(static_cast<int>(places.size()));
  result.sample.position = places;
  result.sample.cell.box = 10 * Mat<2>::Identity();
  result.sample.cell.periodic = {true, true};
  return result;
}

/// Contacts drawn: the lines with a round cap, one path each.
int lines(const std::string& svg) {
  const std::size_t begin = svg.find("<g stroke-linecap=\"round\">");
  return occurrences(svg.substr(begin, svg.find("</g>", begin) - begin), "<path");
}

TEST(ForceChains, GrainsAtTheBorderAreDrawnOnBothSides) {
  EXPECT_EQ(occurrences(scenery({Vec<2>(5, 5)}).svg(), "<circle"), 1);
  EXPECT_EQ(occurrences(scenery({Vec<2>(0.3, 5)}).svg(), "<circle"), 2);
  EXPECT_EQ(occurrences(scenery({Vec<2>(5, 9.8)}).svg(), "<circle"), 2);
  EXPECT_EQ(occurrences(scenery({Vec<2>(0.3, 9.8)}).svg(), "<circle"), 4);
  Scenery walled = scenery({Vec<2>(0.3, 9.8)});
  walled.sample.cell.periodic = {true, false};
  EXPECT_EQ(occurrences(walled.svg(), "<circle"), 2);
}

TEST(ForceChains, ContactsAcrossTheBorderAreDrawnOnBothSides) {
  Scenery inside = scenery({Vec<2>(5, 5), Vec<2>(6, 5)});
  inside.add(0, 1, Vec<2>(1, 0), 1);
  EXPECT_EQ(lines(inside.svg()), 1);
  Scenery across = scenery({Vec<2>(0.3, 5), Vec<2>(9.3, 5)});
  across.add(0, 1, Vec<2>(-1, 0), 1);
  EXPECT_EQ(lines(across.svg()), 2);
}

TEST(ForceChains, WidthGrowsWithTheForceUpToASaturation) {
  Scenery chain = scenery({Vec<2>(2, 5), Vec<2>(3, 5), Vec<2>(4, 5), Vec<2>(5, 5), Vec<2>(6, 5)});
  chain.sample.cell.box *= 4;  // so that no width is limited by the page
  for (int c = 0; c < 4; ++c) chain.add(c, c + 1, Vec<2>(1, 0), std::array{1.0, 2.0, 100.0, 200.0}[c]);
  const std::string svg = chain.svg();
  std::vector<double> widths;
  const std::size_t begin = svg.find("<g stroke-linecap=\"round\">");
  const std::string group = svg.substr(begin, svg.find("</g>", begin) - begin);
  for (const std::string& width : pieces(group, "stroke-width=\"", "\"")) widths.push_back(std::stod(width));
  ASSERT_EQ(widths.size(), 4u);
  EXPECT_LE(widths[0], widths[1]);
  EXPECT_LT(widths[1], widths[2]);
  EXPECT_NEAR(widths[3] / widths[2], 2, 0.02) << "200 is 2.6 times the mean: not saturated";
  EXPECT_NE(svg.find("= 75.8"), std::string::npos) << "the legend must give the mean force";
  EXPECT_NE(svg.find(">5 d<"), std::string::npos) << "the scale";
}

TEST(ForceChains, TractionHasItsOwnColourAndLegend) {
  Scenery pulled = scenery({Vec<2>(5, 5), Vec<2>(6, 5)});
  pulled.add(0, 1, Vec<2>(1, 0), -1);
  EXPECT_NE(pulled.svg().find("traction"), std::string::npos);
  pulled.contacts.force[0] *= -1;
  EXPECT_EQ(pulled.svg().find("traction"), std::string::npos);
}

TEST(ForceChains, RattlersArePale) {
  const std::string pale = "fill=\"#f9f9f9\"";
  Scenery pair = scenery({Vec<2>(5, 5), Vec<2>(6, 5)});
  const std::string svg = pair.svg();
  EXPECT_EQ(occurrences(svg.substr(svg.find(pale)), "<circle"), 2);
}

// A cell that has been sheared by whole widths is the same cell, and gives the same picture to the last digit.
TEST(ForceChains, TiltedCellIsReduced) {
  Scenery straight = scenery({Vec<2>(0.3, 2), Vec<2>(7, 9.7), Vec<2>(8, 9.7)});
  straight.add(1, 2, Vec<2>(1, 0), 1);
  Scenery tilted = straight;
  tilted.sample.cell.box(0, 1) = 30;
  tilted.sample.position[0] += Vec<2>(40, 10);
  EXPECT_EQ(straight.svg(), tilted.svg());
  tilted.sample.cell.box(0, 1) = 32;
  EXPECT_NE(straight.svg(), tilted.svg());
}

TEST(ForceChains, PlanesAreHatched) {
  Scenery floor = scenery({Vec<2>(5, 0.5)});
  floor.sample.cell.periodic = {true, false};
  const std::string before = floor.svg();
  floor.sample.planes = {{Vec<2>(0, 0), Vec<2>(0, 1), Vec<2>::Zero()}};
  floor.add(0, 1, Vec<2>(0, -0.5), 1);
  EXPECT_TRUE(well_formed(floor.svg()));
  EXPECT_GT(occurrences(floor.svg(), "L"), occurrences(before, "L") + 15) << "one stroke per half diameter";
  floor.sample.planes[0].point = Vec<2>(0, -500);  // out of view
  EXPECT_LT(occurrences(floor.svg(), "L"), occurrences(before, "L") + 5);
}

TEST(ForceChains, CylindersAreHatchedCircles) {
  Scenery drum = scenery({Vec<2>(5, 5)});
  drum.sample.cell.periodic = {false, false};
  drum.sample.planes.resize(1);
  drum.sample.planes[0].point = Vec<2>(5, 5);
  drum.sample.planes[0].radius = 4;
  const std::string svg = drum.svg();
  EXPECT_TRUE(well_formed(svg));
  const std::string::size_type begin = svg.find("<g clip-path=\"url(#view)\"");
  ASSERT_NE(begin, std::string::npos);
  const std::string group = svg.substr(begin, svg.find("</g>", begin) - begin);
  const std::string circle = group.substr(0, group.find("/>"));
  EXPECT_EQ(occurrences(circle, "L"), 96) << "96 sides, closed";
  // Strokes lie outside of the circle, where no grain may be, one per half diameter of its length.
  EXPECT_NEAR(occurrences(group, "L") - 96, 2 * 3.14159 * 4 / 0.5, 1);
  drum.sample.planes[0].inside = false;
  EXPECT_NE(svg, drum.svg());
}

TEST(ForceChains, IsWellFormedWhateverTheTitle) {
  Scenery pair = scenery({Vec<2>(5, 5), Vec<2>(6, 5)});
  pair.add(0, 1, Vec<2>(1, 0), 1);
  const std::string svg = pair.svg("a < b & \"c\" > d\n</svg>");
  EXPECT_TRUE(well_formed(svg));
  EXPECT_NE(svg.find("a &lt; b &amp;"), std::string::npos);
  EXPECT_NE(svg.find(">2 d<"), std::string::npos) << "5 d would fill half of this picture";
  EXPECT_TRUE(well_formed(scenery({}).svg("")));
  EXPECT_THROW(force_chain_svg(test::snapshot_of(pair.sample, pair.contacts), {"", 10}), std::invalid_argument);
}

bool have_gnuplot() {
  std::istringstream folders(std::getenv("PATH") != nullptr ? std::getenv("PATH") : "");
  for (std::string folder; std::getline(folders, folder, ':');)
    if (std::filesystem::exists(std::filesystem::path(folder) / "gnuplot")) return true;
  return false;
}
#define SKIP_WITHOUT_GNUPLOT \
  if (!have_gnuplot()) GTEST_SKIP() << "gnuplot is not installed"

Figure simple_figure() {
  Figure figure;
  figure.title = "title";
  figure.x_label = "x";
  figure.y_label = "y";
  figure.series = {{"first", {0.1, 1, 10}, {1, 1.0 / 3, 3}, {0.1, 0.2, 0.3}, false},
                   {"second", {1, 2}, {2, 3}, {}, true}};
  return figure;
}

TEST(Figure, WritesDataScriptAndPictures) {
  SKIP_WITHOUT_GNUPLOT;
  const TemporaryFolder folder;
  for (const bool logarithmic : {false, true}) {
    Figure figure = simple_figure();
    figure.log_x = figure.log_y = logarithmic;
    EXPECT_EQ(write_figure(folder.file("f"), figure), folder.file("f.svg"));
    EXPECT_EQ(file_bytes(folder.file("f.dat")),
              "# title\n# first\n# x   y   error\n0.1 1 0.1\n1 0.3333333333333333 0.2\n10 3 0.3\n\n\n"
              "# second\n# x   y\n1 2\n2 3\n\n\n");
    EXPECT_TRUE(file_bytes(folder.file("f.png")).starts_with("\x89PNG"));
    const std::string svg = file_bytes(folder.file("f.svg"));
    EXPECT_NE(svg.find("</svg>"), std::string::npos);
    for (const char* text : {"title", "first", "second"}) EXPECT_NE(svg.find(text), std::string::npos) << text;
  }
  EXPECT_EQ(folder.entries(), 4);
}

TEST(Figure, NamesAndLabelsAreOnlyText) {
  SKIP_WITHOUT_GNUPLOT;
  const TemporaryFolder folder;
  const std::string victim = folder.file("victim");
  const std::string attack = "`touch " + victim + "`'; system('touch " + victim + "'); '\n!touch " + victim + "\n\\";
  Figure figure = simple_figure();
  figure.title = figure.x_label = figure.y_label = figure.series[0].label = attack;
  for (const std::string name :
       {"it's $(touch victim) `touch victim`", "-e", "|touch victim", "< touch victim", "~", "a;b\"c"}) {
    EXPECT_EQ(write_figure(folder.file(name), figure), folder.file(name) + ".svg");
    EXPECT_TRUE(std::filesystem::exists(folder.file(name) + ".png")) << name;
    EXPECT_FALSE(std::filesystem::exists(victim)) << name;
  }
  EXPECT_EQ(folder.entries(), 24);
  EXPECT_THROW(write_figure(folder.file("new\nline"), figure), std::invalid_argument);
  EXPECT_THROW(write_figure(folder.path() + "/", figure), std::invalid_argument);
}

/// "linecolor ... pointtype N" of each series of a script.
std::vector<std::string> looks(const std::string& script) {
  std::vector<std::string> found;
  for (std::size_t at = script.find("linecolor rgb '#", script.find("\nplot ")); at != std::string::npos;
       at = script.find("linecolor rgb '#", at + 1))
    found.push_back(script.substr(at, script.find(" pointsize", at) - at));
  return found;
}

TEST(Figure, OpenPointsHaveTheColourOfTheirFilledOnes) {
  const TemporaryFolder folder;
  Figure figure = simple_figure();
  figure.series.push_back(figure.series[0]);
  figure.series[2].look = 1, figure.series[2].open = true;
  write_figure(folder.file("f"), figure);
  const auto found = looks(file_bytes(folder.file("f.gp")));
  ASSERT_EQ(found.size(), 3u);
  const auto colour = [&](int k) { return found[k].substr(0, found[k].find(" pointtype")); };
  EXPECT_NE(colour(0), colour(1));
  EXPECT_EQ(colour(1), colour(2));
  EXPECT_NE(found[1], found[2]);
}

// A point without a value is none.
TEST(Figure, PointsThatCanNotBeShownAreCounted) {
  SKIP_WITHOUT_GNUPLOT;
  const TemporaryFolder folder;
  Figure figure = simple_figure();
  figure.log_x = true;
  figure.series[0].x[1] = -1;
  figure.series[0].y[2] = std::nan("");
  figure.series[1].x = {0, 0};
  write_figure(folder.file("f"), figure);
  EXPECT_NE(file_bytes(folder.file("f.svg")).find("first (1 off the axes)"), std::string::npos);
  EXPECT_NE(file_bytes(folder.file("f.dat")).find("-1 0.3333333333333333 0.2"), std::string::npos);
  figure.series = {{"nothing", {}, {}, {}, false}};
  EXPECT_NE(write_figure(folder.file("empty"), figure), "");
  EXPECT_NE(file_bytes(folder.file("empty.svg")).find("no points"), std::string::npos);
}

TEST(Figure, RefusesColumnsOfDifferentLengths) {
  const TemporaryFolder folder;
  Figure figure = simple_figure();
  figure.series[0].y.pop_back();
  EXPECT_THROW(write_figure(folder.file("f"), figure), std::invalid_argument);
  figure = simple_figure();
  figure.series[0].y_error.pop_back();
  EXPECT_THROW(write_figure(folder.file("f"), figure), std::invalid_argument);
}

TEST(Figure, WithoutGnuplotDataAndScriptAreThere) {
  const TemporaryFolder folder;
  const char* set = std::getenv("PATH");
  const std::string before = set != nullptr ? set : "";
  ::setenv("PATH", folder.path().c_str(), 1);
  const std::string result = write_figure(folder.file("f"), simple_figure());
  ::setenv("PATH", before.c_str(), 1);
  EXPECT_EQ(result, "");
  EXPECT_EQ(folder.entries(), 2);
}

}  // namespace
}  // namespace galet::test::figure_svg_test
