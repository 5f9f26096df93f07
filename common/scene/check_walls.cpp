// The rules of rough walls, and of the grains that are glued to them.
#include <algorithm>
#include <set>

#include "common/core/near_match.hpp"
#include "common/scene/check_report.hpp"

namespace galet::scene_check {

namespace {

void check_wall(Report& report, std::size_t k) {
  const WallSpec& wall = report.scene.walls[k];
  const std::string path = fmt::format("wall[{}].", k);
  report.components(path + "velocity", wall.velocity.size());
  report.components(path + "free", wall.free.size());
  report.components(path + "force", wall.force.size());
  const auto is_free = [&](std::size_t a) { return a < wall.free.size() && wall.free[a]; };
  for (std::size_t a = 0; a < wall.force.size(); ++a)
    report.rule(wall.force[a] == 0 || is_free(a), path + "force",
                fmt::format("{}force: the wall is not free along {}, where its velocity is imposed", path, axis(a)),
                {path + "free"});
  const bool any = std::find(wall.free.begin(), wall.free.end(), true) != wall.free.end();
  report.rule(!wall.mass || any, path + "mass", path + "mass has no effect on a wall that is free in no direction",
              {path + "free"});
  const auto& listed = report.scene.grains.listed;
  const bool used =
      std::any_of(listed.begin(), listed.end(), [&](const ListedGrain& grain) { return grain.wall == wall.name; });
  report.rule(used, path + "name",
              fmt::format("{}name: no [[grain]] is glued to {}: give its grains wall = {}", path, quoted(wall.name),
                          quoted(wall.name)),
              {"grain"});
}

}  // namespace

void check_walls(Report& report) {
  const Scene& scene = report.scene;
  Paths names;
  std::set<std::string> seen;
  for (std::size_t k = 0; k < scene.walls.size(); ++k) {
    const std::string path = fmt::format("wall[{}].name", k), &name = scene.walls[k].name;
    report.rule(!name.empty(), path, path + " is empty");
    report.rule(name.empty() || seen.insert(name).second, path,
                fmt::format("{}: {} is the name of another wall already", path, quoted(name)));
    if (!name.empty()) check_wall(report, k);
    names.push_back(name);
  }
  if (!scene.walls.empty()) {
    report.rule(scene.engine == EngineKind::cd, "wall", "[[wall]] entries need engine = \"cd\": md has no rigid bodies",
                {"engine"});
    report.rule(scene.loading.kind == LoadingKind::none, "wall",
                "[[wall]] entries need loading.kind = \"none\": walls move the grains, not the cell", {"loading.kind"});
  }
  for (std::size_t k = 0; k < scene.grains.listed.size(); ++k) {
    const ListedGrain& grain = scene.grains.listed[k];
    const std::string path = fmt::format("grain[{}].", k);
    if (grain.wall.empty()) continue;
    const bool known = std::find(names.begin(), names.end(), grain.wall) != names.end();
    report.rule(
        known, path + "wall",
        fmt::format("{}wall: no [[wall]] is called {}{}", path, quoted(grain.wall), suggestion(grain.wall, names)),
        {"wall"});
    report.rule(grain.velocity.empty() && grain.spin.empty(), path + "wall",
                path + "wall: a grain of a wall moves with it: leave out its velocity and spin");
  }
}

}  // namespace galet::scene_check
