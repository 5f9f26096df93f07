// What the parts of check() share: the scene under examination and what was found in it.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "common/scene/check.hpp"

namespace galet::scene_check {

using Paths = std::vector<std::string>;

/// The scene under examination and what was found in it.
struct Report {
  const Scene& scene;
  std::vector<Finding> findings = {};

  void add(std::string path, std::string message, Paths reads = {}) {
    findings.push_back({std::move(path), std::move(message), std::move(reads)});
  }
  /// Adds the finding when the rule is broken.
  void rule(bool holds, std::string path, std::string message, Paths reads = {}) {
    if (!holds) add(std::move(path), std::move(message), std::move(reads));
  }
  /// A vector of the scene has one component per direction, or is absent.
  void components(const std::string& path, std::size_t size, bool may_be_absent = true) {
    const auto wanted = static_cast<std::size_t>(scene.dimension);
    if (size == wanted || (size == 0 && may_be_absent)) return;
    add(path, fmt::format("{}: {}D needs {} components, got {}", path, wanted, wanted, size), {"dimension"});
  }
};

/// Whether the grains are made by the scene itself (not listed, not read from a file).
inline bool drawn(InitialKind kind) {
  return kind != InitialKind::listed && kind != InitialKind::packing && kind != InitialKind::checkpoint;
}

inline bool is_periodic(const Scene& scene, std::size_t direction) {
  return direction >= scene.cell.periodic.size() || scene.cell.periodic[direction];
}

inline bool periodic_everywhere(const Scene& scene) {
  return std::find(scene.cell.periodic.begin(), scene.cell.periodic.end(), false) == scene.cell.periodic.end();
}

inline char axis(std::size_t direction) { return "xyz"[direction]; }

/// Whether the run lasts for run.duration, whatever happens: it is one stage without conditions.
inline bool ends_in_time(const Scene& scene) {
  return scene.run.duration && scene.stages.empty() && scene.run.until.empty() && !scene.run.equilibrium &&
         !scene.run.unbalanced;
}

/// Whether some contact makes grains turn.
bool rotates(const Scene& scene);

// check_material.cpp
void check_material(Report& report);
void check_material_names(Report& report);  ///< of materials, and who refers to them
void check_relaxers(Report& report);

// check_loading.cpp
void check_loadings(Report& report);    ///< of the scene and of its stages, with their ends
bool imposes_flow(const Scene& scene);  ///< whether some loading imposes a rate

// check_boundaries.cpp
void check_boundaries(Report& report);  ///< planes and cylinders

// check_bodies.cpp
void check_bodies(Report& report);

// check_output.cpp
void check_output(Report& report);

}  // namespace galet::scene_check
