// A loading as drives of single components of the cell's velocity gradient L, each in rate or in stress:
//
//   plane_shear             L_xy given; sigma_yy held at the pressure (or the volume held)
//   isotropic               L_xx = L_yy (= L_zz), mean normal stress held at the pressure
//   oedometric              axis driven; no lateral strain
//   biaxial 2D, triaxial 3D axis driven; each lateral normal stress held at the pressure
//   drives                  as they are listed
//
// The axis is the last direction, y or z, and is driven at L = -compression_rate, at a stress, or at the stress that it
// has when the stage starts. Stresses are positive in compression, rates L negative (common/core/conventions.hpp).
// Source: chapter, sec. "essais".
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/scene/derive.hpp"
#include "common/scene/scene.hpp"

namespace galet {

/// Whether the loading drives an axis of its own.
bool has_axis(LoadingKind kind);
/// "yy" or "zz".
std::string axis_component(int dimension);
/// "xx", "xy", ..., "isotropic": what drives of that dimension may be called.
std::vector<std::string> component_names(int dimension);

/// Whether some component has a rate other than 0 imposed.
bool imposes_rate(const LoadingSpec& loading);
/// Whether a stress is to change with time.
bool has_changing_stress(const LoadingSpec& loading);
/// Whether some stress is held at what it is when the stage starts.
bool holds_present_stress(const LoadingSpec& loading);
/// The largest stress that the loading asks for (absolute value); 0 for none.
double largest_stress(const LoadingSpec& loading);

/// Gravity as it acts: turned by the inclination, (g_x cos - g_last sin, ..., g_x sin + g_last cos), so that with
/// g = (0, -1) it is (sin, -cos): down a slope towards +x. Empty: none.
std::vector<double> gravity_of(const LoadingSpec& loading);

/// `derived`: of that scene; its rates.
std::vector<CellDrive> loading_drives(const Scene& scene, const Derived& derived);

}  // namespace galet
