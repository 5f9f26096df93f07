// The rows of rigid bodies: [[body]].
#include "common/io/scene_table.hpp"

namespace galet::scene_table {

namespace {

void add_translation(Rows& rows) {
  rows.push_back({.path = "body.velocity",
                  .target = [](Scene& s) -> FieldTarget { return &s.bodies.back().velocity; },
                  .quantity = Quantity::velocity,
                  .fallback = "at rest",
                  .doc = "of its centre; imposed, or where the body is free: at the start"});
  rows.push_back({.path = "body.free",
                  .target = [](Scene& s) -> FieldTarget { return &s.bodies.back().free; },
                  .fallback = "false in each direction",
                  .doc = "per direction: moved by the grains' forces, gravity and `force`, not by `velocity`"});
  rows.push_back({.path = "body.guide",
                  .target = [](Scene& s) -> FieldTarget { return &s.bodies.back().guide; },
                  .fallback = "none",
                  .doc = "the body moves freely along this direction only, in place of `free`"});
  rows.push_back({.path = "body.force",
                  .target = [](Scene& s) -> FieldTarget { return &s.bodies.back().force; },
                  .quantity = Quantity::force,
                  .fallback = "none",
                  .doc = "on the body, along its free directions (with a guide: what of it is along that)"});
}

void add_rotation(Rows& rows) {
  rows.push_back({.path = "body.spin",
                  .target = [](Scene& s) -> FieldTarget { return &s.bodies.back().spin; },
                  .quantity = Quantity::angular_velocity,
                  .number_too = true,
                  .fallback = "none",
                  .doc = "angular velocity about its centre; imposed, or where the body turns freely: at the start"});
  rows.push_back({.path = "body.free_rotation",
                  .target = [](Scene& s) -> FieldTarget { return &s.bodies.back().free_rotation; },
                  .fallback = "false about each axis",
                  .doc =
                      "`[true]` in 2D, `[true, true, true]` in 3D: turned by the grains' forces and `torque`, not by "
                      "`spin`; in 3D it may be about one axis only, which then stays where it is"});
  rows.push_back({.path = "body.torque",
                  .target = [](Scene& s) -> FieldTarget { return &s.bodies.back().torque; },
                  .quantity = Quantity::torque,
                  .number_too = true,
                  .fallback = "none",
                  .doc = "on the body, about its free axes"});
}

void add_mass(Rows& rows) {
  rows.push_back({.path = "body.mass",
                  .target = [](Scene& s) -> FieldTarget { return &s.bodies.back().mass; },
                  .quantity = Quantity::mass,
                  .range = above(0),
                  .fallback = "that of its grains",
                  .doc = "of the body; its inertia is then in proportion to that of its grains"});
  rows.push_back({.path = "body.centre",
                  .target = [](Scene& s) -> FieldTarget { return &s.bodies.back().centre; },
                  .quantity = Quantity::length,
                  .fallback = "that of its grains' masses",
                  .doc = "of mass: what `velocity` is of, and what it turns about; ring: needed, also the circle's"});
  rows.push_back(
      {.path = "body.inertia",
       .target = [](Scene& s) -> FieldTarget { return &s.bodies.back().inertia; },
       .quantity = Quantity::inertia,
       .number_too = true,
       .fallback = "that of its grains",
       .doc = "moment of inertia about the centre; in 3D xx, yy, zz, xy, xz, yz of the tensor at the start"});
}

void add_shape(Rows& rows) {
  rows.push_back(
      {.path = "body.shape",
       .target = [](Scene& s) -> FieldTarget { return &s.bodies.back().shape; },
       .choices = {"listed", "wall", "ring", "chain", "polygon"},
       .doc = "`listed`: its grains are the [[grain]] entries that name it; `wall`: a row of grains (3D: a "
              "square layer) across the whole cell; `ring`: grains on a circle about `centre` (3D: a stack "
              "of such circles along z, a rough cylinder); `chain`, `polygon`: a clump of equal grains in line, "
              "or at the corners of a regular polygon, placed and turned at random"});
  rows.push_back({.path = "body.at",
                  .target = [](Scene& s) -> FieldTarget { return &s.bodies.back().at; },
                  .quantity = Quantity::length,
                  .fallback = "wall: needed",
                  .doc = "wall: coordinate of its grains' centres along `across`. Other grains are placed on the side "
                         "of the cell's middle"});
  rows.push_back({.path = "body.across",
                  .target = [](Scene& s) -> FieldTarget { return &s.bodies.back().across; },
                  .choices = {"x", "y", "z"},
                  .doc = "wall: the direction that it stands across"});
  rows.push_back({.path = "body.radius",
                  .target = [](Scene& s) -> FieldTarget { return &s.bodies.back().radius; },
                  .quantity = Quantity::length,
                  .range = above(0),
                  .fallback = "ring: needed",
                  .doc = "ring: of the circle of its grains' centres"});
  rows.push_back({.path = "body.grains",
                  .target = [](Scene& s) -> FieldTarget { return &s.bodies.back().outside; },
                  .choices = {"inside", "outside"},
                  .doc = "ring: on which side other grains are placed"});
  rows.push_back(
      {.path = "body.spacing",
       .target = [](Scene& s) -> FieldTarget { return &s.bodies.back().spacing; },
       .range = above(0),
       .doc = "distance of neighbours; wall, ring: in mean diameters, at least (they are spread evenly); chain, "
              "polygon: in diameters of the clump's grains"});
  rows.push_back({.path = "body.size",
                  .target = [](Scene& s) -> FieldTarget { return &s.bodies.back().size; },
                  .range = at_least(1),
                  .fallback = "chain, polygon: needed",
                  .doc = "chain, polygon: number of grains"});
  rows.push_back({.path = "body.copies",
                  .target = [](Scene& s) -> FieldTarget { return &s.bodies.back().copies; },
                  .range = at_least(1),
                  .doc = "chain, polygon: number of such bodies, called `name 1`, `name 2`, ..."});
  rows.push_back({.path = "body.segments",
                  .target = [](Scene& s) -> FieldTarget { return &s.bodies.back().segments; },
                  .range = at_least(0),
                  .doc = "ring: > 0: so many arcs of it are bodies of their own, each free to move along its radius"});
  rows.push_back({.path = "body.pressure",
                  .target = [](Scene& s) -> FieldTarget { return &s.bodies.back().pressure; },
                  .quantity = Quantity::pressure,
                  .range = at_least(0),
                  .fallback = "none",
                  .doc = "ring of segments: presses each on the grains, by its arc at `radius` (3D: times the cell's "
                         "height)"});
  rows.push_back({.path = "body.material",
                  .target = [](Scene& s) -> FieldTarget { return &s.bodies.back().material; },
                  .fallback = "[material]",
                  .doc = "of a shape: name of the material of its grains"});
}

}  // namespace

void add_bodies(Rows& rows) {
  rows.push_back({.path = "body.name",
                  .target = [](Scene& s) -> FieldTarget { return &s.bodies.back().name; },
                  .required = true,
                  .doc = "what its grains call it"});
  add_shape(rows);
  add_translation(rows);
  add_rotation(rows);
  add_mass(rows);
}

}  // namespace galet::scene_table
