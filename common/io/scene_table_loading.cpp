// The rows of loadings, drives, ends and stages. A scene's own and its stages' are the same rows under other names.
#include "common/io/scene_table.hpp"

namespace galet::scene_table {

namespace {

LoadingSpec& of_scene(Scene& scene) { return scene.loading; }
LoadingSpec& of_stage(Scene& scene) { return scene.stages.back().loading; }
EndSpec& end_of_run(Scene& scene) { return scene.run; }
EndSpec& end_of_stage(Scene& scene) { return scene.stages.back(); }

template <LoadingSpec& (*Of)(Scene&)>
void add_kind(Rows& rows, const std::string& table) {
  rows.push_back({.path = table + ".kind",
                  .target = [](Scene& s) -> FieldTarget { return &Of(s).kind; },
                  .choices = {"none", "plane_shear", "isotropic", "oedometric", "biaxial", "triaxial", "drives"},
                  .doc = "`none`: the cell does not move; `plane_shear`: L_xy given, sigma_yy held at `pressure` (the "
                         "volume held if no pressure is given); `isotropic`: mean stress held at `pressure`; "
                         "`oedometric`: the axis (y in 2D, z in 3D) driven, no lateral strain; `biaxial` (2D), "
                         "`triaxial` (3D): the axis driven, each lateral stress held at `pressure`; `drives`: the "
                         "[[drive]] entries. All but `none` need a cell periodic in each direction"});
}

template <LoadingSpec& (*Of)(Scene&)>
void add_shear(Rows& rows, const std::string& table) {
  rows.push_back({.path = table + ".shear_rate",
                  .target = [](Scene& s) -> FieldTarget { return &Of(s).shear_rate; },
                  .quantity = Quantity::rate,
                  .range = above(0),
                  .fallback = "plane_shear: needed, or `inertial_number`",
                  .doc = "plane_shear: L_xy"});
  rows.push_back({.path = table + ".inertial_number",
                  .target = [](Scene& s) -> FieldTarget { return &Of(s).inertial_number; },
                  .symbol = "I",
                  .range = above(0),
                  .fallback = "plane_shear: needed, or `shear_rate`",
                  .doc =
                      "the rate times sqrt(m / (P d^(D-2))): plane_shear: of L_xy; oedometric, biaxial, triaxial: of "
                      "the compression"});
  rows.push_back({.path = table + ".fixed_volume",
                  .target = [](Scene& s) -> FieldTarget { return &Of(s).fixed_volume; },
                  .doc = "plane_shear: the volume is held; `pressure` is then only the unit of stress"});
}

template <LoadingSpec& (*Of)(Scene&)>
void add_axis(Rows& rows, const std::string& table) {
  rows.push_back(
      {.path = table + ".compression_rate",
       .target = [](Scene& s) -> FieldTarget { return &Of(s).compression_rate; },
       .quantity = Quantity::rate,
       .fallback = "one of four: see `axial_stress`, `hold_axial`, `inertial_number`",
       .doc = "oedometric, biaxial, triaxial: -L along the axis, > 0 shortens the sample, < 0 lengthens it"});
  rows.push_back(
      {.path = table + ".axial_stress",
       .target = [](Scene& s) -> FieldTarget { return &Of(s).axial_stress; },
       .quantity = Quantity::pressure,
       .doc = "oedometric, biaxial, triaxial: the stress along the axis is held at this, in place of a rate"});
  rows.push_back({.path = table + ".axial_stress_to",
                  .target = [](Scene& s) -> FieldTarget { return &Of(s).axial_stress_to; },
                  .quantity = Quantity::pressure,
                  .doc = "and goes there linearly with time until the end"});
  rows.push_back({.path = table + ".hold_axial",
                  .target = [](Scene& s) -> FieldTarget { return &Of(s).hold_axial; },
                  .doc = "oedometric, biaxial, triaxial: the stress along the axis is held at what it is at the start "
                         "(creep)"});
}

template <LoadingSpec& (*Of)(Scene&)>
void add_loading_rows(Rows& rows, const std::string& table, const char* pressure_doc, const char* pressure_default) {
  add_kind<Of>(rows, table);
  rows.push_back({.path = table + ".pressure",
                  .target = [](Scene& s) -> FieldTarget { return &Of(s).pressure; },
                  .symbol = "P",
                  .quantity = Quantity::pressure,
                  .range = above(0),
                  .fallback = pressure_default,
                  .doc = pressure_doc});
  rows.push_back({.path = table + ".pressure_to",
                  .target = [](Scene& s) -> FieldTarget { return &Of(s).pressure_to; },
                  .quantity = Quantity::pressure,
                  .range = above(0),
                  .doc = "the pressure held goes there linearly with time until the end"});
  add_shear<Of>(rows, table);
  add_axis<Of>(rows, table);
  rows.push_back({.path = table + ".gravity",
                  .target = [](Scene& s) -> FieldTarget { return &Of(s).gravity; },
                  .symbol = "g",
                  .quantity = Quantity::acceleration,
                  .fallback = "none",
                  .doc = "acceleration, per direction; 0 in periodic directions"});
  rows.push_back({.path = table + ".inclination",
                  .target = [](Scene& s) -> FieldTarget { return &Of(s).inclination; },
                  .symbol = "theta",
                  .range = between(-180, 180),
                  .fallback = "0",
                  .doc = "degrees by which gravity is turned from the last direction towards x, also where x is "
                         "periodic: the slope of an inclined plane"});
}

template <LoadingSpec& (*Of)(Scene&)>
void add_drive_rows(Rows& rows, const std::string& table) {
  rows.push_back({.path = table + ".component",
                  .target = [](Scene& s) -> FieldTarget { return &Of(s).drives.back().component; },
                  .required = true,
                  .doc = "`\"xx\"`, `\"xy\"`, ... of the velocity gradient L, or `\"isotropic\"`: one rate for all "
                         "diagonal components, whose stress is the mean normal stress"});
  rows.push_back({.path = table + ".rate",
                  .target = [](Scene& s) -> FieldTarget { return &Of(s).drives.back().rate; },
                  .quantity = Quantity::rate,
                  .fallback = "needed, or `stress`, or `hold`",
                  .doc = "the component's value, < 0 in compression"});
  rows.push_back({.path = table + ".stress",
                  .target = [](Scene& s) -> FieldTarget { return &Of(s).drives.back().stress; },
                  .quantity = Quantity::pressure,
                  .fallback = "needed, or `rate`, or `hold`",
                  .doc = "the stress that the component is held at, > 0 in compression"});
  rows.push_back({.path = table + ".stress_to",
                  .target = [](Scene& s) -> FieldTarget { return &Of(s).drives.back().stress_to; },
                  .quantity = Quantity::pressure,
                  .doc = "the stress goes there linearly with time until the end"});
  rows.push_back({.path = table + ".hold",
                  .target = [](Scene& s) -> FieldTarget { return &Of(s).drives.back().hold; },
                  .doc = "the stress is held at what it is at the start"});
}

template <EndSpec& (*Of)(Scene&)>
void add_conditions(Rows& rows, const std::string& table) {
  rows.push_back({.path = table + ".equilibrium",
                  .target = [](Scene& s) -> FieldTarget { return &Of(s).equilibrium; },
                  .range = above(0),
                  .fallback = "run to the end",
                  .doc = "no imposed rate: stop once, for one inertial time, held stresses are within "
                         "`stress_tolerance` and the kinetic energy per grain (rattlers apart) is below this times "
                         "P d^D"});
  rows.push_back({.path = table + ".unbalanced",
                  .target = [](Scene& s) -> FieldTarget { return &Of(s).unbalanced; },
                  .range = above(0),
                  .fallback = "run to the end",
                  .doc = "the same with the unbalanced force ratio: mean force left on a grain (rattlers apart) / mean "
                         "contact force. With `equilibrium` both are asked"});
  rows.push_back({.path = table + ".stress_tolerance",
                  .target = [](Scene& s) -> FieldTarget { return &Of(s).stress_tolerance; },
                  .range = above(0),
                  .fallback = "0.01",
                  .doc = "of these two: relative error of each held stress"});
  rows.push_back({.path = table + ".until",
                  .target = [](Scene& s) -> FieldTarget { return &Of(s).until; },
                  .fallback = "run to the end",
                  .doc = "stop once this component, `\"xx\"`, `\"xy\"`, ... or `\"isotropic\"`, has reached"});
  rows.push_back({.path = table + ".until_stress",
                  .target = [](Scene& s) -> FieldTarget { return &Of(s).until_stress; },
                  .quantity = Quantity::pressure,
                  .doc = "this stress, from either side (mean over one inertial time), or"});
  rows.push_back({.path = table + ".until_strain",
                  .target = [](Scene& s) -> FieldTarget { return &Of(s).until_strain; },
                  .range = above(0),
                  .doc = "this strain since the start, either way (logarithmic; `\"isotropic\"`: of the volume)"});
  rows.push_back({.path = table + ".cycles",
                  .target = [](Scene& s) -> FieldTarget { return &Of(s).cycles; },
                  .range = at_least(0),
                  .doc = "> 0: go there and back so often in all: rates change sign, changing stresses return"});
}

template <EndSpec& (*Of)(Scene&)>
void add_length(Rows& rows, const std::string& table) {
  rows.push_back({.path = table + ".duration",
                  .target = [](Scene& s) -> FieldTarget { return &Of(s).duration; },
                  .quantity = Quantity::time,
                  .range = above(0),
                  .fallback = "needed, or `strain`",
                  .doc = "time simulated (at most, if a condition may end it sooner)"});
  rows.push_back({.path = table + ".strain",
                  .target = [](Scene& s) -> FieldTarget { return &Of(s).strain; },
                  .range = above(0),
                  .fallback = "needed, or `duration`",
                  .doc = "strain simulated, of the rate that the loading imposes: L_xy, else that of the axis, else "
                         "that of the first drive with a rate"});
}

}  // namespace

void add_loading(Rows& rows) {
  add_loading_rows<of_scene>(rows, "loading", "the pressure held, and the unit of stress in kappa and I", "none");
}

void add_drives(Rows& rows) { add_drive_rows<of_scene>(rows, "drive"); }

void add_run(Rows& rows) {
  add_length<end_of_run>(rows, "run");
  rows.push_back({.path = "run.average_from",
                  .target = [](Scene& s) -> FieldTarget { return &s.run.average_from; },
                  .range = {.low = 0, .high = 1, .high_open = true},
                  .doc = "measures are averaged from this fraction of the run (of its last stage) on"});
  rows.push_back({.path = "run.samples",
                  .target = [](Scene& s) -> FieldTarget { return &s.run.samples; },
                  .range = at_least(1),
                  .doc = "number of measures over the run (over each stage)"});
  add_conditions<end_of_run>(rows, "run");
}

void add_stages(Rows& rows) {
  rows.push_back({.path = "stage.name",
                  .target = [](Scene& s) -> FieldTarget { return &s.stages.back().name; },
                  .fallback = "its number",
                  .doc = "what progress, summary and files call it"});
  add_length<end_of_stage>(rows, "stage");
  add_conditions<end_of_stage>(rows, "stage");
  rows.push_back({.path = "stage.friction",
                  .target = [](Scene& s) -> FieldTarget { return &s.stages.back().friction; },
                  .range = at_least(0),
                  .fallback = "the material's",
                  .doc = "friction of [material] in this stage: 0 while assembling gives the densest packings"});
  rows.push_back({.path = "stage.restitution",
                  .target = [](Scene& s) -> FieldTarget { return &s.stages.back().restitution; },
                  .range = between(0, 1),
                  .fallback = "the material's",
                  .doc = "restitution of [material] in this stage, in place of its restitution or damping ratio"});
  add_loading_rows<of_stage>(rows, "stage.loading", "the pressure held in this stage", "`loading.pressure`");
  add_drive_rows<of_stage>(rows, "stage.drive");
}

}  // namespace galet::scene_table
