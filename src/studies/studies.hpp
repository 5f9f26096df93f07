// The studies, one file each.
#pragma once

#include "src/studies/study.hpp"

namespace galet {

namespace flow_law {
std::vector<StudyRun> plan(StudySize size);
StudyReport report(const std::vector<StudyRow>& rows);
}  // namespace flow_law
namespace flow_friction {
std::vector<StudyRun> plan(StudySize size);
StudyReport report(const std::vector<StudyRow>& rows);
}  // namespace flow_friction
namespace flow_restitution {
std::vector<StudyRun> plan(StudySize size);
StudyReport report(const std::vector<StudyRow>& rows);
}  // namespace flow_restitution
namespace flow_kappa {
std::vector<StudyRun> plan(StudySize size);
StudyReport report(const std::vector<StudyRow>& rows);
}  // namespace flow_kappa
namespace compression {
std::vector<StudyRun> plan(StudySize size);
StudyReport report(const std::vector<StudyRow>& rows);
}  // namespace compression
namespace cohesive_flow {
std::vector<StudyRun> plan(StudySize size);
StudyReport report(const std::vector<StudyRow>& rows);
}  // namespace cohesive_flow
namespace critical_state {
std::vector<StudyRun> plan(StudySize size);
StudyReport report(const std::vector<StudyRow>& rows);
}  // namespace critical_state
namespace triaxial {
std::vector<StudyRun> plan(StudySize size);
StudyReport report(const std::vector<StudyRow>& rows);
}  // namespace triaxial
namespace consolidation {
std::vector<StudyRun> plan(StudySize size);
StudyReport report(const std::vector<StudyRow>& rows);
}  // namespace consolidation
namespace inclined_plane {
std::vector<StudyRun> plan(StudySize size);
StudyReport report(const std::vector<StudyRow>& rows);
}  // namespace inclined_plane
namespace annular_shear {
std::vector<StudyRun> plan(StudySize size);
StudyReport report(const std::vector<StudyRow>& rows);
}  // namespace annular_shear
namespace regimes {
std::vector<StudyRun> plan(StudySize size);
StudyReport report(const std::vector<StudyRow>& rows);
}  // namespace regimes

inline constexpr Study flow_law_study{
    "flow-law",
    "Dilatancy and friction of sheared disks against the inertial number",
    "Roux and Chevoir 2010, sec. 3.1 and 3.2 (da Cruz et al. 2005)",
    "disks +-20 %, mu = 0.4, e = 0.1, K_T = K_N / 2, kappa = 1e4 (md) or rigid (cd); periodic cell, sheared at "
    "constant "
    "pressure, and once at the volume that the pressure gave; between rough walls, as the published runs.",
    Observable::mu_star,
    flow_law::plan,
    flow_law::report};

inline constexpr Study flow_friction_study{"flow-friction",
                                           "Linear flow laws against the friction between grains",
                                           "Roux and Chevoir 2010, sec. 3.2 (da Cruz et al. 2005)",
                                           "as flow-law, with mu = 0 to 0.8; lines fitted over 0.01 <= I <= 0.2",
                                           Observable::mu_star,
                                           flow_friction::plan,
                                           flow_friction::report};

inline constexpr Study flow_restitution_study{
    "flow-restitution",
    "Effect of restitution on flows with and without friction, and the collisional limit",
    "Roux and Chevoir 2010, sec. 3.2 (da Cruz 2004)",
    "as flow-law, with e = 0.1 to 0.9, mu = 0 and 0.4; effects are ratios - 1 between the ends of the range",
    Observable::mu_star,
    flow_restitution::plan,
    flow_restitution::report};

inline constexpr Study flow_kappa_study{
    "flow-kappa",
    "Effect of the stiffness of contacts, and the rigid limit",
    "Roux and Chevoir 2010, sec. 3.2 (da Cruz 2004; Campbell 2002)",
    "as flow-law, with kappa = 40 to 1e5 (2.5e5 in full size) in md, the same "
    "compliance in cd, and rigid grains; contacts "
    "are without attraction (viscous_convention = \"total\") in all of them; sliding is "
    "undamped in md, and critically damped in one more run at each I",
    Observable::mu_star,
    flow_kappa::plan,
    flow_kappa::report};

inline constexpr Study compression_study{
    "compression",
    "Isotropic compression of spheres: coordination and rattlers of the states A, C and D",
    "Roux and Chevoir 2010, sec. 2.1 (Agnolin and Roux 2007)",
    "equal spheres, Hertz and Mindlin with nu = 0.3, kappa = 39000 at the first pressure, mu = 0.3 but for the "
    "assembly of A; "
    "three packings of each; rigid grains (cd) assembled the same way",
    Observable::z_star,
    compression::plan,
    compression::report};

inline constexpr Study cohesive_flow_study{
    "cohesive-flow",
    "Flow laws of cohesive disks against the cohesion number",
    "Roux and Chevoir 2010, sec. 3.4 (Rognon et al. 2006, 2008)",
    "as flow-law, md with attraction sqrt(4 K_N F0 h) at kappa = 1e5; rigid grains, and md beside them at kappa = 1e6, "
    "with constant attraction F0 and a range of 1e-3 d",
    Observable::mu_star,
    cohesive_flow::plan,
    cohesive_flow::report};

inline constexpr Study critical_state_study{
    "critical-state",
    "The critical state in simple shear against the friction of contacts",
    "Roux and Chevoir 2010, sec. 2.3 (Peyneau and Roux 2008; Chialvo et al. 2012)",
    "2D: disks +-20 %; 3D: equal spheres; linear law, kappa = 1e4 (quick size: 3000) or rigid; loose starts from a "
    "gas, dense "
    "ones from frictionless shear",
    Observable::mu_star,
    critical_state::plan,
    critical_state::report};

inline constexpr Study triaxial_study{
    "triaxial",
    "Triaxial compression of dense sphere packings: peaks, and strains of type I and II",
    "Roux and Chevoir 2010, sec. 2.2",
    "equal spheres, Hertz and Mindlin with nu = 0.3, kappa = 8400 and 39000, state A assembled without friction and "
    "then given "
    "mu, state C; axial strain at I = 5e-4 (quick size: 2e-3); rigid grains from state A beside them",
    Observable::solid_fraction,
    triaxial::plan,
    triaxial::report};

inline constexpr Study consolidation_study{
    "consolidation",
    "Consolidation curve of cohesive disks, and what a little rolling resistance does to it",
    "Roux and Chevoir 2010, sec. 2.1 (Gilabert et al. 2007, 2008)",
    "disks of diameters uniform in [0.67, 1.33] of their mean, mu = 0.5, constant attraction F0 of range 0.01 d, K_N d "
    "/ F0 = 1e5; "
    "a gas of solid fraction 0.4 aggregates, then P* = P d / F0 goes from 0.01 to 10 in steps and back",
    Observable::solid_fraction,
    consolidation::plan,
    consolidation::report};

inline constexpr Study inclined_plane_study{"inclined-plane",
                                            "Flow down a rough inclined plane, and the law of homogeneous shear",
                                            "Roux and Chevoir 2010, sec. 3.3 (Prochnow 2002; da Cruz 2004)",
                                            "disks +-20 %, mu = 0.4, e = 0.1, on a floor of glued disks; K_N = 2e5 m g "
                                            "/ d (quick size: 2e4); cd at dt = 0.01 sqrt(d / "
                                            "g), and finer at 20 degrees; homogeneous shear in the periodic cell",
                                            Observable::mu_star,
                                            inclined_plane::plan,
                                            inclined_plane::report};

inline constexpr Study annular_shear_study{
    "annular-shear",
    "Annular shear: the local law at several radii, and creep",
    "Roux and Chevoir 2010, sec. 3.3 (Koval et al. 2009)",
    "disks +-20 %, mu = 0.4, e = 0.1, whole annulus, inner ring of surface speed sqrt(P / m), outer one of arcs under "
    "P; "
    "kappa = 1e4 "
    "(quick size: 1e3) or rigid; homogeneous shear of the same material in the periodic cell",
    Observable::mu_star,
    annular_shear::plan,
    annular_shear::report};

inline constexpr Study regimes_study{
    "regimes",
    "Which parameters matter in which regime",
    "Roux and Chevoir 2010, last table",
    "flows and assembly: disks +-20 %; solids: equal spheres (Hertz, Mindlin); quick size: 120 to 200 grains; each "
    "parameter is "
    "changed "
    "alone from a "
    "reference; kappa of cd: from rigid to elastic contacts; type I has no rows of cd, whose contacts don't deform",
    Observable::solid_fraction,
    regimes::plan,
    regimes::report};

}  // namespace galet
