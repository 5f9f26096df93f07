// The rows of [output] and [guard].
#include "common/io/scene_table.hpp"
#include "common/scene/measure_names.hpp"

namespace galet::scene_table {

namespace {

std::vector<std::string> measure_words() {
  std::vector<std::string> words;
  for (const MeasureInfo& measure : measure_table) words.emplace_back(measure.name);
  return words;
}

/// One clause per measure, for the reference.
std::string measure_meanings() {
  std::string text = "measures to compute. At each sample: ";
  for (const bool in_series : {true, false}) {
    if (!in_series) text += ". At the end: ";
    bool first = true;
    for (const MeasureInfo& measure : measure_table) {
      if (measure.in_series != in_series) continue;
      text += std::string(first ? "`" : "; `") + std::string(measure.name) + "`, " + std::string(measure.meaning);
      first = false;
    }
  }
  return text;
}

}  // namespace

void add_output(Rows& rows) {
  rows.push_back({.path = "output.measures",
                  .target = [](Scene& s) -> FieldTarget { return &s.output.measures; },
                  .choices = measure_words(),
                  .doc = measure_meanings()});
  rows.push_back({.path = "output.profile_layers",
                  .target = [](Scene& s) -> FieldTarget { return &s.output.profile_layers; },
                  .range = at_least(1),
                  .doc = "layers of the measure `profile`"});
  rows.push_back({.path = "output.profile_direction",
                  .target = [](Scene& s) -> FieldTarget { return &s.output.profile_direction; },
                  .choices = {"x", "y", "z"},
                  .doc = "cell vector that the measure `profile` cuts into layers"});
  rows.push_back({.path = "output.profile_centre",
                  .target = [](Scene& s) -> FieldTarget { return &s.output.profile_centre; },
                  .quantity = Quantity::length,
                  .fallback = "layers",
                  .doc = "the measure `profile` goes by `profile_layers` rings about this place (3D: about an axis "
                         "along z), with components (r, theta, z) and stresses of contacts only"});
  rows.push_back({.path = "output.profile_radii",
                  .target = [](Scene& s) -> FieldTarget { return &s.output.profile_radii; },
                  .quantity = Quantity::length,
                  .range = at_least(0),
                  .fallback = "needed with `profile_centre`",
                  .doc = "where the rings begin and end"});
  rows.push_back({.path = "output.frames",
                  .target = [](Scene& s) -> FieldTarget { return &s.output.frames; },
                  .range = at_least(0),
                  .doc = "states written over the run at equal intervals, besides the first"});
  rows.push_back({.path = "output.formats",
                  .target = [](Scene& s) -> FieldTarget { return &s.output.formats; },
                  .choices = {"paraview", "xyz", "lammps"},
                  .fallback = "[\"paraview\"]",
                  .doc =
                      "files of these states: `paraview`, grains, contacts and cell with a collection (.pvd) of each; "
                      "`xyz`, extended XYZ (OVITO); `lammps`, text dumps"});
}

void add_guard(Rows& rows) {
  rows.push_back({.path = "guard.every",
                  .target = [](Scene& s) -> FieldTarget { return &s.guard.every; },
                  .range = at_least(1),
                  .doc = "steps between checks; states are also checked before they are kept"});
  rows.push_back({.path = "guard.overlap",
                  .target = [](Scene& s) -> FieldTarget { return &s.guard.overlap; },
                  .range = {.low = 0, .high = 0.5, .low_open = true},
                  .doc = "largest overlap, in units of the smaller of the two radii"});
  rows.push_back(
      {.path = "guard.speed",
       .target = [](Scene& s) -> FieldTarget { return &s.guard.speed; },
       .range = above(0),
       .doc = "largest speed of a grain (fluctuation), in units of the scene's own: the largest of speeds at the "
              "start, of imposed motions over the cell, of falls under gravity through it, sqrt(P d^D / m), and "
              "sqrt(F0 d / m)"});
  rows.push_back({.path = "guard.energy",
                  .target = [](Scene& s) -> FieldTarget { return &s.guard.energy; },
                  .range = above(0),
                  .doc = "largest kinetic energy per grain, in units of m v^2 / 2 with that speed v"});
}

}  // namespace galet::scene_table
