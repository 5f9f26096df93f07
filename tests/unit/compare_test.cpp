// The comparison of the engines: which rows it makes, and that they don't depend on how many run side by side.
#include "src/compare.hpp"

#include <algorithm>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "src/compare_report.hpp"

namespace galet::test::compare_test {
namespace {

Scene small_scene() {
  Scene scene;
  scene.title = "small";
  scene.grains.count = 50;
  scene.grains.diameter = {SizeKind::uniform, 1, 0.2, {}, {}};
  scene.material.friction = 0.4;
  scene.material.restitution = 0.1;
  scene.material.stiffness_level = 1e3;
  scene.loading.kind = LoadingKind::plane_shear;
  scene.loading.pressure = 1;
  scene.loading.inertial_number = 0.2;
  scene.cd.tolerance = 1e-2;
  scene.run.strain = 1;
  scene.run.samples = 20;
  scene.compare.inertial_numbers = {0.2, 0.3};
  scene.compare.stiffness_levels = {500, 1000};
  scene.compare.cd_dt_factors = {0.02};
  scene.compare.cd_tolerances = {1e-2};
  return scene;
}

TEST(ComparePlan, IsEachStateTimesEachSetOfParameters) {
  Scene scene = small_scene();
  scene.compare.cd_tolerances = {1e-3, 1e-4};
  const std::vector<PlannedRow> rows = compare_plan(scene);
  ASSERT_EQ(rows.size(), 2u * (2 + 2));
  EXPECT_EQ(rows[0].engine, EngineKind::md);
  EXPECT_EQ(rows[0].inertial_number, 0.2);
  EXPECT_EQ(rows[0].stiffness_level, 500);
  EXPECT_EQ(rows[0].scene.material.stiffness_level, 500);
  EXPECT_EQ(rows[3].engine, EngineKind::cd);
  EXPECT_FALSE(rows[3].stiffness_level);
  EXPECT_EQ(rows[3].scene.cd.tolerance, 1e-4);
  // Pictures: the stiffest and the finest row of the first state.
  EXPECT_TRUE(rows[1].reference);
  EXPECT_TRUE(rows[3].reference);
  EXPECT_EQ(std::count_if(rows.begin(), rows.end(), [](const PlannedRow& row) { return row.reference; }), 2);
}

TEST(ComparePlan, EmptyListsTakeTheScenesOwnValues) {
  Scene scene = small_scene();
  scene.compare = CompareSpec{};
  const std::vector<PlannedRow> rows = compare_plan(scene);
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows[0].stiffness_level, 1e3);
  EXPECT_EQ(rows[1].dt_factor, scene.cd.dt_factor);
  scene.material.stiffness_level.reset();
  EXPECT_EQ(compare_plan(scene).size(), 1u);  // no stiffness, no md rows
}

TEST(ComparePlan, ShortenedIsSmaller) {
  Scene scene = small_scene();
  scene.grains.count = 5000;
  const Scene brief = shortened(scene);
  EXPECT_EQ(brief.grains.count, 400);
  EXPECT_EQ(compare_plan(brief).size(), 4u);
}

TEST(Compare, RowsDontDependOnTheirNeighbours) {
  SideBySideOptions options;
  const Comparison alone = compare(small_scene(), options);
  options.jobs = 3;
  const Comparison together = compare(small_scene(), options);
  ASSERT_EQ(alone.rows.size(), 6u);
  ASSERT_EQ(together.rows.size(), 6u);
  for (std::size_t k = 0; k < 6; ++k) {
    EXPECT_TRUE(alone.rows[k].usable()) << alone.rows[k].failure;
    EXPECT_EQ(alone.rows[k].mu_star.value, together.rows[k].mu_star.value);
    EXPECT_EQ(alone.rows[k].steps, together.rows[k].steps);
    EXPECT_GT(alone.rows[k].cost, 0);
  }
  ASSERT_EQ(alone.limits.size(), 2u);
  EXPECT_EQ(alone.limits[1].inertial_number, 0.3);
  EXPECT_TRUE(alone.limits[0].mu_star.md && alone.limits[0].mu_star.cd);
  EXPECT_NE(alone.rows[1].picture.find("<svg"), std::string::npos);
}

TEST(Compare, JsonHasWhatMachinesRead) {
  const Comparison comparison = compare(small_scene(), {});
  const auto json = nlohmann::json::parse(compare_json(comparison, "small"));
  ASSERT_EQ(json["rows"].size(), 6u);
  for (const auto& row : json["rows"]) {
    EXPECT_EQ(row["kappa"].is_null(), row["engine"] == "cd");
    for (const char* key : {"I", "dt", "tolerance", "penetration", "seconds"}) EXPECT_TRUE(row.contains(key)) << key;
    for (const char* key : {"mu_star", "Phi", "z"}) {
      EXPECT_TRUE(row[key]["value"].is_number());
      EXPECT_TRUE(row[key]["error"].is_number());
    }
  }
  EXPECT_EQ(json["rigid_limit"].size(), 2u);
  EXPECT_EQ(compare_table(comparison).rows.size(), 6u);
  EXPECT_NE(compare_text(comparison).find("rigid limit"), std::string::npos);
}

TEST(Compare, CompressesOncePerSetOfParameters) {
  Scene scene = small_scene();
  scene.initial.kind = InitialKind::compressed_gas;
  scene.compare.stiffness_levels = {500};
  scene.run.strain = 0.2;
  const Comparison comparison = compare(scene, {});
  for (const CompareRow& row : comparison.rows) {
    ASSERT_TRUE(row.usable()) << row.failure;
    EXPECT_GT(row.series.rows.front()[Observable::solid_fraction], 0.7);
  }
}

}  // namespace
}  // namespace galet::test::compare_test
