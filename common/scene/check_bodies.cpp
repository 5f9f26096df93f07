// The rules of rigid bodies, and of the grains that are glued to them.
#include <algorithm>
#include <set>

#include <Eigen/Core>
#include <Eigen/Eigenvalues>

#include "common/core/near_match.hpp"
#include "common/scene/body_shapes.hpp"
#include "common/scene/check_report.hpp"
#include "common/scene/rigid_bodies.hpp"

namespace galet::scene_check {

namespace {

bool any(const std::vector<bool>& values) { return std::find(values.begin(), values.end(), true) != values.end(); }

std::size_t axes(const Scene& scene) { return scene.dimension == 2 ? 1 : 3; }

bool free_in_every_way(const Scene& scene, const BodySpec& body) {
  const auto all = [](const std::vector<bool>& free, std::size_t wanted) {
    return static_cast<std::size_t>(std::count(free.begin(), free.end(), true)) == wanted;
  };
  return all(body.free, static_cast<std::size_t>(scene.dimension)) && all(body.free_rotation, axes(scene));
}

/// A rotation has one component in 2D and three in 3D, or is absent.
void check_rotation(Report& report, const std::string& path, std::size_t size) {
  const std::size_t wanted = axes(report.scene);
  report.rule(size == 0 || size == wanted, path,
              fmt::format("{}: {}D needs {} component{}, got {}", path, report.scene.dimension, wanted,
                          wanted == 1 ? "" : "s", size),
              {"dimension"});
}

/// Loads act only where the body is free.
void check_load(Report& report, const std::string& path, const std::string& free_path, const std::vector<double>& load,
                const std::vector<bool>& free, const std::string& what) {
  for (std::size_t a = 0; a < load.size(); ++a)
    report.rule(load[a] == 0 || (a < free.size() && free[a]), path,
                fmt::format("{}: the body {}{}, where its {} is imposed", path, what,
                            what == "is not free" ? fmt::format(" along {}", axis(a))
                            : load.size() > 1     ? fmt::format(" about {}", axis(a))
                                                  : "",
                            what == "is not free" ? "velocity" : "spin"),
                {free_path});
}

void check_axes(Report& report, const std::string& path, const BodySpec& body) {
  if (report.scene.dimension != 3 || body.free_rotation.size() != 3) return;
  const auto count = std::count(body.free_rotation.begin(), body.free_rotation.end(), true);
  report.rule(count != 2, path + "free_rotation",
              path + "free_rotation: a body turns freely about one axis or about all three, not about two");
  if (count != 1 || body.spin.size() != 3) return;
  for (std::size_t a = 0; a < 3; ++a)
    report.rule(body.free_rotation[a] || body.spin[a] == 0, path + "spin",
                fmt::format("{}spin: a body that turns freely about one axis can't have an imposed spin about {}", path,
                            axis(a)),
                {path + "free_rotation"});
}

bool positive_definite(const std::vector<double>& v) {
  if (v.size() == 1) return v[0] > 0;
  const Eigen::Matrix3d tensor = (Eigen::Matrix3d() << v[0], v[3], v[4], v[3], v[1], v[5], v[4], v[5], v[2]).finished();
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(tensor, Eigen::EigenvaluesOnly).eigenvalues()[0] > 0;
}

void check_mass(Report& report, const std::string& path, const BodySpec& body) {
  const bool moved = any(body.free) || !body.guide.empty() || body.segments > 0, turned = any(body.free_rotation);
  report.rule(!body.mass || moved || turned, path + "mass",
              path + "mass has no effect on a body that is free in nothing", {path + "free", path + "free_rotation"});
  report.components(path + "centre", body.centre.size());
  report.rule(body.centre.empty() || turns(body) || body.shape == BodyShape::ring, path + "centre",
              path + "centre has no effect on a body that never turns", {path + "spin", path + "free_rotation"});
  if (body.inertia.empty()) return;
  report.rule(turned, path + "inertia", path + "inertia has no effect on a body that does not turn freely",
              {path + "free_rotation"});
  const std::size_t wanted = report.scene.dimension == 2 ? 1 : 6;
  if (body.inertia.size() != wanted)
    report.add(path + "inertia",
               fmt::format("{}inertia: {}D needs {}, got {}", path, report.scene.dimension,
                           wanted == 1 ? "a number" : "6 components (xx, yy, zz, xy, xz, yz)", body.inertia.size()),
               {"dimension"});
  else
    report.rule(positive_definite(body.inertia), path + "inertia",
                path + "inertia: every moment of inertia must be above 0");
}

/// A field that belongs to other shapes than the body's.
void check_idle(Report& report, const std::string& path, bool given, bool has_effect, const char* shapes,
                const std::string& body) {
  report.rule(!given || has_effect, path, fmt::format("{} needs shape = {}", path, shapes), {body + "shape"});
}

void check_wall(Report& report, const std::string& path, const BodySpec& body) {
  const Scene& scene = report.scene;
  const auto across = static_cast<std::size_t>(body.across), dim = static_cast<std::size_t>(scene.dimension);
  const Paths reads = {path + "shape", path + "across", "cell.periodic", "cell.size", "dimension"};
  report.rule(body.at.has_value(), path + "at", path + "at is needed with shape = \"wall\": where it stands", reads);
  if (across >= dim) return report.add(path + "across", path + "across = \"z\" needs dimension = 3", {"dimension"});
  report.rule(!is_periodic(scene, across), path + "across",
              fmt::format("{}across: {} is a periodic direction, in which grains would pass the wall from behind; set "
                          "cell.periodic to false there",
                          path, axis(across)),
              reads);
  if (scene.cell.size.size() != dim || !body.at) return;
  report.rule(*body.at >= 0 && *body.at <= scene.cell.size[across], path + "at",
              fmt::format("{}at: {:.6g} is outside the cell, whose size is {:.6g} along {}", path, *body.at,
                          scene.cell.size[across], axis(across)),
              reads);
}

/// Two walls across one direction don't start in the same place and, where both motions are imposed, don't meet.
void check_wall_pair(Report& report, std::size_t k, std::size_t other) {
  const Scene& scene = report.scene;
  const BodySpec &a = scene.bodies[other], &b = scene.bodies[k];
  if (a.shape != BodyShape::wall || b.shape != BodyShape::wall || a.across != b.across || !a.at || !b.at) return;
  const auto across = static_cast<std::size_t>(a.across);
  const std::string path = fmt::format("body[{}].", k);
  const Paths reads = {fmt::format("body[{}]", other), "run"};
  const double gap = *b.at - *a.at;
  if (gap == 0)
    return report.add(path + "at", fmt::format("{}at: body[{}], a wall too, stands in the same place", path, other),
                      reads);
  const auto imposed = [&](const BodySpec& wall) {
    return wall.guide.empty() && (wall.free.size() <= across || !wall.free[across]);
  };
  const auto speed = [&](const BodySpec& wall) { return wall.velocity.size() > across ? wall.velocity[across] : 0.0; };
  if (!imposed(a) || !imposed(b) || !ends_in_time(scene)) return;
  const double meeting = -gap / (speed(b) - speed(a));  // not positive, or not a number: never
  report.rule(!(meeting > 0 && meeting <= *scene.run.duration), path + "velocity",
              fmt::format("{}velocity: the wall crosses body[{}] at the time {:.6g}, before the end of the run", path,
                          other, meeting),
              reads);
}

void check_ring(Report& report, const std::string& path, const BodySpec& body) {
  const Paths reads = {path + "shape", "cell.periodic", "dimension"};
  report.rule(body.radius.has_value(), path + "radius", path + "radius is needed with shape = \"ring\"", reads);
  report.rule(!body.centre.empty(), path + "centre", path + "centre is needed with shape = \"ring\"", reads);
  for (std::size_t a = 0; a < 2; ++a)
    report.rule(!is_periodic(report.scene, a), path + "shape",
                fmt::format("{}shape: the ring crosses the periodic direction {}; set cell.periodic to false there",
                            path, axis(a)),
                reads);
}

void check_clump(Report& report, const std::string& path, const BodySpec& body) {
  const int least = body.shape == BodyShape::chain ? 1 : 3;
  report.rule(body.size >= least, path + "size",
              fmt::format("{}size is needed: the number of grains, at least {}", path, least), {path + "shape"});
  report.rule(body.centre.empty(), path + "centre", path + "centre: a clump turns about the centre of its grains",
              {path + "shape"});
}

/// Motion along a line.
void check_guide(Report& report, const std::string& path, const BodySpec& body) {
  if (body.guide.empty()) return;
  report.components(path + "guide", body.guide.size());
  report.rule(std::any_of(body.guide.begin(), body.guide.end(), [](double x) { return x != 0; }), path + "guide",
              path + "guide is zero: it must point along the line on which the body moves");
  report.rule(!any(body.free), path + "guide", fmt::format("{0}guide and {0}free exclude each other", path),
              {path + "free"});
}

/// What the segments of a ring have by themselves.
void check_segments(Report& report, const std::string& path, const BodySpec& body) {
  report.rule(!body.pressure || body.segments > 0, path + "pressure",
              fmt::format("{0}pressure needs {0}segments: a whole ring does not yield", path), {path + "segments"});
  if (body.segments == 0) return;
  report.rule(body.segments >= 3, path + "segments", path + "segments: at least 3 make a ring");
  const auto refuse = [&](bool given, const char* field) {
    report.rule(!given, path + field,
                fmt::format("{0}{1} and {0}segments exclude each other: segments move along their radius", path, field),
                {path + "segments"});
  };
  refuse(any(body.free), "free"), refuse(!body.force.empty(), "force"), refuse(!body.velocity.empty(), "velocity");
  refuse(!body.guide.empty(), "guide"), refuse(turns(body), "spin");
}

void check_shape(Report& report, const std::string& path, const BodySpec& body) {
  const Scene& scene = report.scene;
  const bool wall = body.shape == BodyShape::wall, ring = body.shape == BodyShape::ring;
  check_idle(report, path + "at", body.at.has_value(), wall, "\"wall\"", path);
  check_idle(report, path + "across", body.across != Axis::y, wall, "\"wall\"", path);
  check_idle(report, path + "radius", body.radius.has_value(), ring, "\"ring\"", path);
  check_idle(report, path + "grains", body.outside, ring, "\"ring\"", path);
  check_idle(report, path + "segments", body.segments > 0, ring, "\"ring\"", path);
  check_idle(report, path + "size", body.size > 0, is_clump(body), "\"chain\" or \"polygon\"", path);
  check_idle(report, path + "copies", body.copies > 1, is_clump(body), "\"chain\" or \"polygon\"", path);
  const bool made = body.shape != BodyShape::listed;
  check_idle(report, path + "spacing", body.spacing != 1, made, "\"wall\", \"ring\", \"chain\" or \"polygon\"", path);
  check_idle(report, path + "material", !body.material.empty(), made, "\"wall\", \"ring\", \"chain\" or \"polygon\"",
             path);
  check_idle(report, path + "pressure", body.pressure.has_value(), ring, "\"ring\"", path);
  if (wall) check_wall(report, path, body);
  if (ring) check_ring(report, path, body), check_segments(report, path, body);
  check_guide(report, path, body);
  const InitialKind kind = scene.initial.kind;
  const bool placed = kind == InitialKind::gas || kind == InitialKind::dense;
  report.rule(!(wall || ring) || placed || kind == InitialKind::listed, path + "shape",
              path + "shape needs initial.kind = \"gas\", \"dense\" or \"listed\"", {"initial.kind"});
  report.rule(!is_clump(body) || placed, path + "shape",
              path + "shape: clumps are placed at random: they need initial.kind = \"gas\" or \"dense\"",
              {"initial.kind"});
  report.rule(!made || !scene.cell.size.empty(), path + "shape",
              path + "shape needs cell.size: that is where the grains of shapes are placed", {"cell.size"});
  if (is_clump(body)) check_clump(report, path, body);
}

void check_body(Report& report, std::size_t k) {
  const BodySpec& body = report.scene.bodies[k];
  const std::string path = fmt::format("body[{}].", k);
  report.components(path + "velocity", body.velocity.size());
  report.components(path + "free", body.free.size());
  report.components(path + "force", body.force.size());
  check_rotation(report, path + "spin", body.spin.size());
  check_rotation(report, path + "free_rotation", body.free_rotation.size());
  check_rotation(report, path + "torque", body.torque.size());
  if (body.guide.empty()) check_load(report, path + "force", path + "free", body.force, body.free, "is not free");
  check_load(report, path + "torque", path + "free_rotation", body.torque, body.free_rotation, "does not turn freely");
  check_axes(report, path, body);
  check_mass(report, path, body);
  check_shape(report, path, body);
  const auto& listed = report.scene.grains.listed;
  const bool used =
      std::any_of(listed.begin(), listed.end(), [&](const ListedGrain& grain) { return grain.body == body.name; });
  report.rule(body.shape == BodyShape::listed || !used, path + "name",
              fmt::format("{}name: the shape makes the grains of {}: no [[grain]] can be glued to it", path,
                          in_quotes(body.name)),
              {"grain", path + "shape"});
  report.rule(used || body.shape != BodyShape::listed, path + "name",
              fmt::format("{}name: no [[grain]] is glued to {}: give its grains body = {}", path, in_quotes(body.name),
                          in_quotes(body.name)),
              {"grain"});
}

void check_company(Report& report) {
  const Scene& scene = report.scene;
  if (scene.bodies.empty()) return;
  for (std::size_t k = 0; k < scene.bodies.size(); ++k)
    report.rule(
        scene.loading.kind == LoadingKind::none || free_in_every_way(scene, scene.bodies[k]),
        fmt::format("body[{}]", k),
        fmt::format("body[{0}] is not free to move and turn in every way, as it must be in a cell that moves: give "
                    "body[{0}].free and body[{0}].free_rotation all true, or loading.kind = \"none\"",
                    k),
        {"loading.kind"});
  for (const auto& [value, name] :
       {std::pair{scene.md.drag, "md.drag"}, std::pair{scene.md.acceleration_damping, "md.acceleration_damping"}})
    report.rule(value == 0, name, fmt::format("{} is refused with [[body]] entries: it acts on grains alone", name),
                {"body"});
}

}  // namespace

void check_bodies(Report& report) {
  const Scene& scene = report.scene;
  Paths names;
  std::set<std::string> seen;
  for (std::size_t k = 0; k < scene.bodies.size(); ++k) {
    for (std::size_t other = 0; other < k; ++other) check_wall_pair(report, k, other);
    const std::string path = fmt::format("body[{}].name", k), &name = scene.bodies[k].name;
    report.rule(!name.empty(), path, path + " is empty");
    report.rule(name.empty() || seen.insert(name).second, path,
                fmt::format("{}: {} is the name of another body already", path, in_quotes(name)));
    if (!name.empty()) check_body(report, k);
    names.push_back(name);
  }
  check_company(report);
  for (std::size_t k = 0; k < scene.grains.listed.size(); ++k) {
    const ListedGrain& grain = scene.grains.listed[k];
    const std::string path = fmt::format("grain[{}].", k);
    if (grain.body.empty()) continue;
    const bool known = std::find(names.begin(), names.end(), grain.body) != names.end();
    report.rule(
        known, path + "body",
        fmt::format("{}body: no [[body]] is called {}{}", path, in_quotes(grain.body), suggestion(grain.body, names)),
        {"body"});
    report.rule(grain.velocity.empty() && grain.spin.empty(), path + "body",
                path + "body: a grain of a body moves with it: leave out its velocity and spin");
  }
}

}  // namespace galet::scene_check
