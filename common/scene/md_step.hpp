// The time step of the soft engine: how stiff contacts get, how fast the stiffest mode of a packing is, and what step
// follows.
#pragma once

#include "common/scene/derive.hpp"

namespace galet {

/// Fills the md entries of `derived` (contact_stiffness, collision_time, md_dt, md_dt_stable, md_stiffest) from its
/// laws, pressure and grains. Leaves them empty when the scene says nothing about stiffness, and the bound empty when
/// nothing tells how deep Hertz contacts get (then md.dt must be given).
void derive_md_step(const Scene& scene, Derived& derived);

}  // namespace galet
