// The rows of smooth boundaries: [[plane]] and [[cylinder]].
#include "common/io/scene_table.hpp"

namespace galet::scene_table {

namespace {

void add_planes(Rows& rows) {
  rows.push_back({.path = "plane.point",
                  .target = [](Scene& s) -> FieldTarget { return &s.planes.back().point; },
                  .quantity = Quantity::length,
                  .required = true,
                  .doc = "a point of the plane"});
  rows.push_back({.path = "plane.normal",
                  .target = [](Scene& s) -> FieldTarget { return &s.planes.back().normal; },
                  .required = true,
                  .doc = "points to the grains' side; any length but 0"});
  rows.push_back({.path = "plane.velocity",
                  .target = [](Scene& s) -> FieldTarget { return &s.planes.back().velocity; },
                  .quantity = Quantity::velocity,
                  .fallback = "at rest",
                  .doc = "imposed velocity"});
  rows.push_back({.path = "plane.mass",
                  .target = [](Scene& s) -> FieldTarget { return &s.planes.back().mass; },
                  .quantity = Quantity::mass,
                  .range = above(0),
                  .fallback = "none: its velocity is imposed",
                  .doc = "cd: the plane is a body of this mass that moves freely along its normal (`velocity` is then "
                         "where it starts, and stays imposed across the normal)"});
  rows.push_back({.path = "plane.force",
                  .target = [](Scene& s) -> FieldTarget { return &s.planes.back().force; },
                  .quantity = Quantity::force,
                  .doc = "on a plane with mass, along its normal: > 0 presses it against the grains. Gravity does not "
                         "act on planes"});
  rows.push_back({.path = "plane.material",
                  .target = [](Scene& s) -> FieldTarget { return &s.planes.back().material; },
                  .fallback = "[material]",
                  .doc = "name of its material"});
}

void add_cylinders(Rows& rows) {
  rows.push_back({.path = "cylinder.point",
                  .target = [](Scene& s) -> FieldTarget { return &s.cylinders.back().point; },
                  .quantity = Quantity::length,
                  .required = true,
                  .doc = "a point of the axis (2D: the centre)"});
  rows.push_back({.path = "cylinder.radius",
                  .target = [](Scene& s) -> FieldTarget { return &s.cylinders.back().radius; },
                  .symbol = "R",
                  .quantity = Quantity::length,
                  .range = above(0),
                  .required = true,
                  .doc = "of the surface"});
  rows.push_back({.path = "cylinder.grains",
                  .target = [](Scene& s) -> FieldTarget { return &s.cylinders.back().outside; },
                  .choices = {"inside", "outside"},
                  .doc = "on which side the grains are"});
  rows.push_back({.path = "cylinder.axis",
                  .target = [](Scene& s) -> FieldTarget { return &s.cylinders.back().axis; },
                  .choices = {"x", "y", "z"},
                  .doc = "3D: direction of the axis, the only one in which the cell may be periodic"});
  rows.push_back({.path = "cylinder.velocity",
                  .target = [](Scene& s) -> FieldTarget { return &s.cylinders.back().velocity; },
                  .quantity = Quantity::velocity,
                  .fallback = "at rest",
                  .doc = "imposed velocity"});
  rows.push_back({.path = "cylinder.spin",
                  .target = [](Scene& s) -> FieldTarget { return &s.cylinders.back().spin; },
                  .quantity = Quantity::angular_velocity,
                  .doc = "imposed angular velocity about the axis; needs friction"});
  rows.push_back({.path = "cylinder.material",
                  .target = [](Scene& s) -> FieldTarget { return &s.cylinders.back().material; },
                  .fallback = "[material]",
                  .doc = "name of its material"});
}

}  // namespace

void add_boundaries(Rows& rows) {
  add_planes(rows);
  add_cylinders(rows);
}

}  // namespace galet::scene_table
