// Mistakes in single fields of a scene file: names, types, ranges, words, units, syntax.
#include <gtest/gtest.h>

#include "tests/unit/scene_mistakes.hpp"

namespace galet::test::scene_reader_test {
namespace {

class SceneReader : public testing::TestWithParam<BadScene> {};

TEST_P(SceneReader, SaysWhatItExpected) { EXPECT_EQ(mistakes_of(GetParam().text), GetParam().expected); }

std::vector<BadScene> bad_fields() {
  return {
      {"misspelt_field",
       sound + R"(material.fricton = 0.4
)",
       {R"(5:10: unknown name "fricton" in [material]; did you mean "friction"?)"}},
      {"misspelt_field_that_was_needed",
       R"(grains.count = 10
material.restituton = 0.5
material.normal_stiffness = 1e4
run.duration = 1
)",
       {R"(2:10: unknown name "restituton" in [material]; did you mean "restitution"?)"}},
      {"misspelt_table",
       R"([grains]
count = 10
[materials]
restitution = 0.5
normal_stiffness = 1e4
[run]
duration = 1
)",
       {"3:2: unknown table [materials]; did you mean [material]?"}},
      {"field_of_another_table",
       R"([grains]
count = 10
[material]
restitution = 0.5
stiffness_level = 1e4
[run]
duration = 1
pressure = 1
)",
       {R"(8:1: unknown name "pressure" in [run]; it belongs to [[body]], [loading] or [stage.loading])"}},
      {"symbol_for_name",
       R"([grains]
count = 10
[material]
mu = 0.4
restitution = 0.5
normal_stiffness = 1e4
[run]
duration = 1
)",
       {R"(4:1: unknown name "mu" in [material]; did you mean "friction"?)"}},
      {"unknown_field_without_near_match",
       sound + R"(md.zzzzz = 1
)",
       {R"(5:4: unknown name "zzzzz" in [md]; expected dt, steps_per_contact, allow_unsafe_dt, energy_budget, drag or )"
        R"(acceleration_damping)"}},
      {"unknown_name_at_the_top",
       sound + R"(colour = "red"
)",
       {R"(5:1: unknown name "colour" at the top of the file; expected title, dimension, seed, units or engine)"}},
      {"list_misnamed",
       sound + R"([[planes]]
point = [0, 0]
normal = [0, 1]
)",
       {"5:3: unknown table [[planes]]; did you mean [[plane]]?"}},
      {"text_for_number",
       sound + R"(material.friction = "0.4"
)",
       {R"(5:21: material.friction: expected a number >= 0, got "0.4" (this field has no unit: )"
        R"(leave out the quotes))"}},
      {"number_for_text",
       sound + R"(title = 3
)",
       {"5:9: title: expected a string, got 3"}},
      {"fraction_for_whole_number",
       R"(grains.count = 1e3
material.restitution = 0.5
material.normal_stiffness = 1e4
run.duration = 1
)",
       {"1:16: grains.count: expected a whole number >= 1, got 1000.0"}},
      {"number_for_truth",
       sound + R"(md.allow_unsafe_dt = 1
)",
       {"5:22: md.allow_unsafe_dt: expected true or false, got 1"}},
      {"number_for_array",
       sound + R"(cell.aspect = 2
)",
       {"5:15: cell.aspect: expected an array of numbers > 0, got 2"}},
      {"text_in_array",
       sound + R"(cell.aspect = [1, "2"]
)",
       {R"(5:19: cell.aspect: expected a number > 0, got "2" (this field has no unit: leave out the quotes))"}},
      {"number_in_array_of_truth",
       sound + R"(cell.periodic = [true, 0]
)",
       {"5:24: cell.periodic: expected true or false, got 0"}},
      {"table_for_number",
       sound + R"(material.friction = {mu = 0.4}
)",
       {"5:21: material.friction: expected a number >= 0, got a table"}},
      {"number_for_table",
       R"(grains = 10
material.restitution = 0.5
material.normal_stiffness = 1e4
run.duration = 1
)",
       {"1:1: grains: expected a table [grains], got 10"}},
      {"list_for_table",
       R"([[grains]]
count = 10
[material]
restitution = 0.5
normal_stiffness = 1e4
[run]
duration = 1
)",
       {"1:3: grains: expected a table [grains], got a list: write it once, with single brackets"}},
      {"table_for_list",
       sound + R"(loading.kind = "drives"
[drive]
component = "xx"
rate = 1
)",
       {"6:2: drive: expected [[drive]] entries, got a table: write [[drive]] with double brackets"}},
      {"numbers_for_list",
       sound + R"(drive = [1]
)",
       {"5:10: drive[0]: expected a table, got 1"}},
      {"date_for_number",
       sound + R"(cd.dt = 2026-01-31
)",
       {"5:9: cd.dt: expected a time > 0, got a date or time"}},
      {"negative_friction",
       sound + R"(material.friction = -0.1
)",
       {"5:21: material.friction: expected a number >= 0, got -0.1"}},
      {"restitution_above_one",
       R"(grains.count = 10
material.restitution = 1.1
material.normal_stiffness = 1e4
run.duration = 1
)",
       {"2:24: material.restitution: expected a number in [0, 1], got 1.1"}},
      {"no_grains",
       R"(grains.count = 0
material.restitution = 0.5
material.normal_stiffness = 1e4
run.duration = 1
)",
       {"1:16: grains.count: expected a whole number >= 1, got 0"}},
      {"count_too_large",
       R"(grains.count = 3000000000
material.restitution = 0.5
material.normal_stiffness = 1e4
run.duration = 1
)",
       {"1:16: grains.count: expected a whole number >= 1, got 3000000000, above the largest possible, 2147483647"}},
      {"dimension_four",
       sound + R"(dimension = 4
loading.gravity = [0, 0, 0, -1]
)",
       {"5:13: dimension: expected 2 or 3, got 4"}},
      {"not_a_number",
       sound + R"(cd.dt = nan
)",
       {"5:9: cd.dt: expected a time > 0, got nan, which is not finite"}},
      {"infinite",
       sound + R"(md.dt = inf
)",
       {"5:9: md.dt: expected a time > 0, got inf, which is not finite"}},
      {"average_from_the_end",
       sound + R"(run.average_from = 1.0
)",
       {"5:20: run.average_from: expected a number in [0, 1), got 1.0"}},
      {"penetration_zero",
       sound + R"(cd.penetration = 0
)",
       {"5:18: cd.penetration: expected a number > 0, got 0"}},
      {"negative_sweep_value",
       sound + R"(compare.cd_dt_factors = [0.01, -0.005]
)",
       {"5:32: compare.cd_dt_factors: expected a number > 0, got -0.005"}},
      {"negative_seed",
       sound + R"(seed = -1
)",
       {"5:8: seed: expected a whole number >= 0, got -1"}},
      {"misspelt_choice",
       sound + R"(loading.kind = "plane_sheer"
loading.shear_rate = 1
)",
       {R"(5:16: loading.kind: expected "none", "plane_shear", "isotropic", "oedometric", "biaxial", )"
        R"("triaxial" or "drives", got )"
        R"("plane_sheer"; did you mean "plane_shear"?)"}},
      {"unknown_engine",
       sound + R"(engine = "fem"
)",
       {R"(5:10: engine: expected "md" or "cd", got "fem")"}},
      {"number_for_choice",
       sound + R"(engine = 2
)",
       {R"(5:10: engine: expected "md" or "cd", got 2)"}},
      {"unit_in_reduced",
       sound + R"(loading.pressure = "10 kPa"
)",
       {R"(5:20: loading.pressure: expected a pressure > 0, got "10 kPa"; values with units need )"
        R"(units = "SI" at the top of the file)"}},
      {"wrong_unit",
       sound + R"(units = "SI"
dimension = 3
grains.diameter = 1e-3
grains.density = 2600
loading.pressure = "3 mm"
)",
       {R"(9:20: loading.pressure: expected a pressure in Pa, kPa, MPa or GPa, got "3 mm")"}},
      {"wrong_unit_2d",
       sound + R"(units = "SI"
grains.diameter = 1e-3
grains.density = 2600
loading.pressure = "10 kPa"
)",
       {R"(8:20: loading.pressure: expected a pressure in N/m, kN/m, MN/m or GN/m (in 2D a force )"
        R"(per length), got "10 kPa")"}},
      {"unit_in_wrong_case",
       sound + R"(units = "SI"
dimension = 3
grains.diameter = 1e-3
grains.density = "2600 kg/m3"
loading.pressure = "10 kpa"
)",
       {R"(9:20: loading.pressure: expected a pressure in Pa, kPa, MPa or GPa, got "10 kpa"; did you mean "10 kPa"?)"}},
      {"unit_without_number",
       sound + R"(units = "SI"
grains.diameter = "mm"
grains.mass = 1
)",
       {R"(6:19: grains.diameter: expected a length in um, mm, cm or m, got "mm")"}},
      {"unit_of_a_pure_number",
       sound + R"(units = "SI"
grains.diameter = 1e-3
grains.mass = 1
material.friction = "0.3 m"
)",
       {R"(8:21: material.friction: expected a number >= 0, got "0.3 m" (this field has no unit: )"
        R"(leave out the quotes))"}},
      {"converted_value_out_of_range",
       sound + R"(units = "SI"
grains.diameter = "-1 mm"
grains.mass = 1
)",
       {R"(6:19: grains.diameter: expected a length > 0, got "-1 mm")"}},
      {"misspelt_units",
       sound + R"(units = "si"
grains.diameter = "1 mm"
grains.mass = "1 g"
)",
       {R"(5:9: units: expected "SI" or "reduced", got "si"; did you mean "SI"?)"}},
      {"si_without_size_and_mass",
       sound + R"(units = "SI"
)",
       {R"(1:1: grains.diameter is needed with units = "SI")",
        R"(1:1: grains.density or grains.mass is needed with units = "SI")"}},
      {"syntax",
       sound + R"(cd.dt 1e-3
)",
       {"5:7: TOML syntax: Error while parsing key-value pair: expected '=', saw '1'"}},
      {"unquoted_text",
       sound + R"(engine = cd
)",
       {"5:10: TOML syntax: Error while parsing value: could not determine value type (text is written in double "
        "quotes)"}},
      {"field_twice",
       sound + R"(run.duration = 2
)",
       {"5:16: TOML syntax: Error while parsing key-value pair: cannot redefine existing integer 'run.duration'"}}};
}

const auto name_of = [](const auto& bad) { return bad.param.name; };
INSTANTIATE_TEST_SUITE_P(BadFields, SceneReader, testing::ValuesIn(bad_fields()), name_of);

}  // namespace
}  // namespace galet::test::scene_reader_test
