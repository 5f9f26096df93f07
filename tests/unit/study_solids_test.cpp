// Findings of the studies of solid packings on synthetic rows whose answers are known: cycles, rates, creep, and
// strains of type I.
#include <cmath>

#include <gtest/gtest.h>

#include "common/io/scene_file.hpp"
#include "src/studies/registry.hpp"
#include "src/studies/solid_templates.hpp"
#include "src/studies/triaxial_curve.hpp"
#include "tests/support/study_rows.hpp"

namespace galet::test::study_solids_test {
namespace {

void add_stage(StudyRow& row, const std::string& name, double time,
               const std::vector<std::pair<Observable, double>>& values, Ending ending = Ending::equilibrium) {
  StageReport stage;
  stage.name = name, stage.time = time, stage.ending = ending;
  for (const auto& [observable, value] : values) stage.last[observable] = value;
  row.run.stages.push_back(stage);
}

/// A curve of `rows` points: q/P of the axial strain, from an assembly at time 10 that left a strain of 0.3.
StudyRow triaxial_row(EngineKind engine, std::vector<std::pair<std::string, double>> parameters, double most, int rows,
                      double (*deviator)(double strain, double scale), double scale) {
  StudyRow row = with_parameters(engine, std::move(parameters));
  constexpr double before = 0.3;
  add_stage(row, "A", 10, {{Observable::eps_zz, before}});
  for (int k = 0; k <= rows; ++k) {
    Measurement at;
    const double strain = most * k / rows;
    at[Observable::time] = 10 + k;
    at[Observable::eps_zz] = before + strain;
    at[Observable::sigma_xx] = at[Observable::sigma_yy] = 1;
    at[Observable::sigma_zz] = 1 + deviator(strain, scale);
    row.run.series.rows.push_back(at);
  }
  add_stage(row, "triaxial", 10 + rows, {{Observable::eps_zz, before + most}}, Ending::finished);
  return row;
}

double line(double strain, double slope) { return slope * strain; }
double constant(double, double value) { return value; }

TEST(StudySolids, CurveIsThatOfItsStageAlone) {
  StudyRow row = triaxial_row(EngineKind::md, {}, 0.01, 100, line, 50);
  add_stage(row, "creep", 200, {{Observable::eps_zz, 0.3 + 0.012}});
  Measurement later;
  later[Observable::time] = 150;
  later[Observable::eps_zz] = 0.5, later[Observable::sigma_xx] = later[Observable::sigma_yy] = 1;
  row.run.series.rows.push_back(later);
  const TriaxialCurve curve = triaxial_curve(row);
  ASSERT_EQ(curve.strain.size(), 100u);  // the state at the end of the assembly is no point of it
  EXPECT_NEAR(curve.strain.back(), 0.01, 1e-15);
  EXPECT_NEAR(deviator_at(curve, 0.00455), 50 * 0.00455, 1e-12);
  EXPECT_NEAR(strain_at(curve, 0.2275), 0.00455, 1e-12);
  EXPECT_TRUE(std::isnan(deviator_at(curve, 0.02)));
  EXPECT_TRUE(std::isnan(strain_at(curve, 0.6)));
  EXPECT_NEAR(mean_deviator(curve, 0.00195, 0.00405), 50 * 0.003, 1e-12);
}

TEST(StudySolids, StrainsOfTypeOneAreThoseOfTheContacts) {
  // q/P = 0.2 kappa strain: as type I is; elastic cd 3 % softer, rigid cd a hundred times stiffer than kappa = 8400.
  std::vector<StudyRow> rows;
  const auto add = [&](EngineKind engine, double level, double slope) {
    for (const int seed : {1, 2})
      rows.push_back(
          triaxial_row(engine, {{"ramp", 1}, {"kappa", level}, {"seed", seed}}, 2 / slope, 400, line, slope));
  };
  add(EngineKind::md, 8400, 0.2 * 8400), add(EngineKind::md, 39000, 0.2 * 39000);
  add(EngineKind::cd, 8400, 0.2 * 8400 / 1.03), add(EngineKind::cd, 0, 20 * 8400);
  const StudyReport report = find_study("triaxial").evaluate(rows);
  const StudyFinding *collapse = finding(report, "kappa strain of A from q/P = 0.1 to 0.4, kappa = 39000 over 8400"),
                     *elastic = finding(report, "strain of A from q/P = 0.1 to 0.4, elastic cd over md"),
                     *rigid = finding(report, "strain of A from q/P = 0.1 to 0.4, rigid cd over md");
  ASSERT_TRUE(collapse && elastic && rigid);
  EXPECT_NEAR(collapse->ours.value, 0, 1e-9);
  EXPECT_NEAR(elastic->ours.value, 0.03, 1e-9);
  EXPECT_NEAR(rigid->ours.value, 0.01, 1e-9);
  for (const StudyFinding* one : {collapse, elastic, rigid}) EXPECT_EQ(one->verdict, Verdict::agrees) << one->quantity;
}

TEST(StudySolids, RatesAreComparedWithTheUsualOne) {
  std::vector<StudyRow> rows;
  rows.push_back(triaxial_row(EngineKind::md, {{"state", 'A'}, {"mu", 0.3}, {"kappa", 8400}, {"seed", 1}}, 0.02, 200,
                              constant, 1.0));
  rows.push_back(triaxial_row(EngineKind::md, {{"I", 1e-3}, {"e", 0.2}, {"seed", 1}}, 0.02, 200, constant, 1.02));
  rows.push_back(triaxial_row(EngineKind::md, {{"I", 1e-2}, {"e", 0.2}, {"seed", 1}}, 0.02, 200, constant, 1.2));
  const StudyReport report = find_study("triaxial").evaluate(rows);
  const StudyFinding *slow = finding(report, "A: mean q/P, I = 0.001"),
                     *fast = finding(report, "A: mean q/P, I = 0.01");
  ASSERT_TRUE(slow && fast);
  EXPECT_NEAR(slow->ours.value, 0.02, 1e-12);
  EXPECT_NEAR(fast->ours.value, 0.2, 1e-12);
}

TEST(StudySolids, CreepIsTheStrainOfItsStageWhereItEnds) {
  std::vector<StudyRow> rows;
  const auto add = [&](double rate, double creep, Ending ending) {
    StudyRow row = triaxial_row(EngineKind::md, {{"creep_after", rate}, {"seed", 1}}, 0.002, 100, line, 400);
    add_stage(row, "creep", 300, {{Observable::eps_zz, 0.3 + 0.002 + creep}}, ending);
    rows.push_back(row);
  };
  add(1e-3, 2e-4, Ending::equilibrium), add(5e-3, 1e-3, Ending::equilibrium);
  const StudyReport report = find_study("triaxial").evaluate(rows);
  EXPECT_NEAR(finding(report, "axial strain of creep after I = 0.001, A (md)")->ours.value, 2e-4, 1e-15);
  EXPECT_NEAR(finding(report, "creep after slow compression less")->ours.value, -8e-4, 1e-15);
  // A sample that goes on to flow has no strain of creep.
  rows.back().run.stages.back().ending = Ending::finished;
  const StudyReport open = find_study("triaxial").evaluate(rows);
  EXPECT_TRUE(std::isnan(finding(open, "axial strain of creep after I = 0.005, A (md)")->ours.value));
}

TEST(StudySolids, CyclesLeaveAPartOfTheirStrain) {
  std::vector<StudyRow> rows;
  StudyRow isotropic = with_parameters(EngineKind::md, {{"state", 'A'}, {"oedometric", 0}, {"seed", 1}});
  add_stage(isotropic, "A", 1, {{Observable::eps_v, 0.7}, {Observable::z_star, 6.0}});
  add_stage(isotropic, "kappa 8400", 2, {{Observable::eps_v, 0.702}});
  add_stage(isotropic, "kappa 2000", 3, {{Observable::eps_v, 0.71}});
  add_stage(isotropic, "back", 4, {{Observable::eps_v, 0.7003}, {Observable::z_star, 5.7}});
  StudyRow oedometric = with_parameters(EngineKind::md, {{"state", 'A'}, {"oedometric", 1}, {"seed", 1}});
  add_stage(oedometric, "A", 1, {{Observable::eps_zz, 0.25}, {Observable::z, 5.9}});
  add_stage(oedometric, "loaded", 2, {{Observable::eps_zz, 0.254}, {Observable::z, 6.195}});
  add_stage(oedometric, "unloaded", 3, {{Observable::eps_zz, 0.2502}});
  const StudyReport report = find_study("compression").evaluate({isotropic, oedometric});
  EXPECT_NEAR(finding(report, "strain of A left after an isotropic cycle")->ours.value, 0.03, 1e-12);
  EXPECT_NEAR(finding(report, "z of A under the axial stress")->ours.value, 0.05, 1e-12);
  EXPECT_EQ(finding(report, "z of A under the axial stress")->note,
            "a cycle leaves 0.050 +- 0.000 of its axial strain");
  EXPECT_NEAR(finding(report, "z* of A after an isotropic cycle, less before")->ours.value, -0.3, 1e-12);
}

TEST(StudySolids, AssembliesAreComparedOneChangeAtATime) {
  std::vector<StudyRow> rows;
  const auto add = [&](double rate, double restitution, double grains, double fraction) {
    StudyRow row = with_parameters(EngineKind::md, {{"I", rate}, {"e", restitution}, {"N", grains}, {"seed", 1}});
    add_stage(row, "rest", 1, {{Observable::solid_fraction, fraction}, {Observable::z_star, 4.5}});
    rows.push_back(row);
  };
  add(1e-3, 0.2, 300, 0.6), add(1e-2, 0.2, 300, 0.603), add(0.1, 0.2, 300, 0.63);
  add(1e-3, 0.9, 300, 0.606), add(1e-3, 0.2, 150, 0.597);
  const StudyReport quick = find_study("compression").evaluate(rows);
  EXPECT_NEAR(finding(quick, "Phi, assembled with I = 0.01 over 0.001")->ours.value, 0.005, 1e-12);
  EXPECT_NEAR(finding(quick, "Phi, assembled with e = 0.9 over 0.2")->ours.value, 0.01, 1e-12);
  EXPECT_NEAR(finding(quick, "Phi, assembled with N = 150 over 300")->ours.value, -0.005, 1e-12);
  add(1e-4, 0.2, 150, 0.4975);  // a slower one, of fewer grains, takes the place of the faster in the comparison
  const StudyReport full = find_study("compression").evaluate(rows);
  EXPECT_NEAR(finding(full, "Phi, assembled with I = 0.001 over 0.0001, N = 150")->ours.value, 0.2, 1e-12);
}

TEST(StudySolids, ScenesHoldWhatTheyAreAskedFor) {
  SolidScene solid;
  solid.engine = EngineKind::cd;
  solid.stiffness_level = 8400;
  solid.compliance = true;
  solid.tolerance = 1e-6;
  const Scene ramp = parse_scene(assembly_scene(solid, 'A') + ramp_stage(1.2, 50), "ramp");
  EXPECT_TRUE(ramp.cd.compliance);
  EXPECT_EQ(ramp.cd.tolerance, 1e-6);
  ASSERT_EQ(ramp.stages.size(), 2u);
  EXPECT_EQ(ramp.stages[1].loading.axial_stress_to, 2.2);
  EXPECT_EQ(ramp.stages[1].until_strain, 0.02);
  solid.engine = EngineKind::md, solid.compliance = false;
  const Scene cycle = parse_scene(assembly_scene(solid, 'C') + oedometric_stages(solid, 2100), "cycle");
  ASSERT_EQ(cycle.stages.size(), 8u);
  EXPECT_EQ(cycle.md.steps_per_contact, sparing_steps);
  EXPECT_EQ(cycle.stages[4].loading.axial_stress_to, 8);  // P goes as kappa^(-3/2), kappa falls to a quarter
  EXPECT_EQ(cycle.stages[5].loading.axial_stress, 8);
  EXPECT_EQ(cycle.stages[7].loading.axial_stress, 1);
  const Scene approach = parse_scene(approach_scene(solid, 0.01), "approach");
  EXPECT_EQ(approach.stages[0].until_stress, 1);
}

}  // namespace
}  // namespace galet::test::study_solids_test
