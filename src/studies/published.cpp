#include "src/studies/published.hpp"

#include <algorithm>
#include <array>
#include <string>

#include "common/core/error.hpp"

namespace galet {

namespace {

constexpr std::string_view chapter = "Roux and Chevoir 2010";
constexpr std::string_view digit = "half of the last printed digit";
constexpr std::string_view spread = "covers da Cruz et al. 2005, the same material";
constexpr std::string_view agnolin = "Agnolin and Roux 2007";
constexpr std::string_view about = "stated more finely, quoted as about: protocols and sizes differ";
constexpr std::string_view rognon = "Roux and Chevoir 2010; Rognon et al. 2006";
constexpr std::string_view gilabert = "Roux and Chevoir 2010; Gilabert et al. 2008";
constexpr std::string_view estrada = "Roux and Chevoir 2010; Estrada et al. 2008";
constexpr std::string_view chialvo = "Chialvo, Sun and Sundaresan 2012";
constexpr std::string_view critical_digits = "jamming densities, fitted there: 0.5 %";
constexpr std::string_view koval = "Roux and Chevoir 2010; Koval et al. 2009";
constexpr std::string_view drawn = "printed as a statement";

constexpr std::array table = {
    // Dense flow of the reference material: mu* = mu*_min + b I, Phi = Phi_max - a I.
    Published{"flow.Phi_max", Claim::equal, 0.82, 0.01, chapter, spread},
    Published{"flow.a", Claim::equal, 0.37, 0.07, chapter, spread},
    Published{"flow.mu_min", Claim::equal, 0.26, 0.01, chapter, spread},
    Published{"flow.b", Claim::equal, 1.1, 0.05, chapter, digit},
    Published{"flow.mu_star_at_0.1", Claim::equal, 0.37, 0.02, "Roux and Chevoir 2010; da Cruz et al. 2005",
              "band of both fits"},
    Published{"flow.Phi_at_0.1", Claim::equal, 0.78, 0.01, "Roux and Chevoir 2010; da Cruz et al. 2005",
              "band of both fits"},
    Published{"flow.engines", Claim::equal, 0, 0.02, "Roux and Chevoir 2010; Lemaitre, Roux and Chevoir 2009",
              "\"perfect agreement\": 2 % is the width of the printed symbols"},
    Published{"flow.volume", Claim::equal, 0, 0.02, chapter, "\"the same states\": 2 % is the width of the symbols"},
    Published{"flow.walls_mu", Claim::equal, 0, 0.01, chapter, "\"homogeneous shear\" in both: the spread of mu*_min"},
    Published{"flow.walls_Phi", Claim::equal, 0, 0.01, chapter, "\"homogeneous shear\" in both: the spread of Phi_max"},
    Published{"flow.walls_law_mu", Claim::equal, 0, 0.02, "Roux and Chevoir 2010; da Cruz et al. 2005",
              "band of both fits"},
    Published{"flow.walls_law_Phi", Claim::equal, 0, 0.01, "Roux and Chevoir 2010; da Cruz et al. 2005",
              "band of both fits"},
    // Friction between grains.
    Published{"friction.a", Claim::equal, 0.35, 0.05, chapter, "covers the reference material's own 0.37 and 0.30"},
    Published{"friction.b", Claim::equal, 1.0, 0.1, chapter, "covers the reference material's own 1.1"},
    Published{"friction.mu_min_grows", Claim::at_least, 0, 0, chapter, drawn},
    Published{"friction.Phi_max_falls", Claim::at_most, 0, 0, chapter, drawn},
    Published{"friction.frictionless", Claim::at_most, 0.75, 0, chapter, "\"much smaller\": by a quarter at least"},
    // Restitution.
    Published{"restitution.frictional", Claim::equal, 0, 0.02, chapter, "\"no effect\": 2 %, the width of the symbols"},
    Published{"restitution.frictionless", Claim::equal, 0, 0.02, chapter,
              "\"no effect\": 2 %, the width of the symbols"},
    Published{"restitution.collisional", Claim::equal, 0.29, 0.01, chapter,
              "printed digits; (1/2) sqrt((pi + 8)/(2 pi)) sqrt(1 - e^2) = 0.2902"},
    Published{"restitution.visible", Claim::at_most, 0, 0, chapter, drawn},
    // Stiffness of the contacts.
    Published{"kappa.none", Claim::equal, 0, 0.01, chapter, "\"no effect\" from 1e3 or 1e4 on: 1 %"},
    Published{"kappa.visible", Claim::at_least, 0.01, 0, chapter, "\"an effect\" at 40: more than the 1 % of none"},
    Published{"kappa.compliant", Claim::equal, 0, 0.02, "Galet: one law in both engines",
              "2 %: two engines with the same compliance"},
    // Flows whose stress is not uniform.
    Published{"slope.ratio", Claim::equal, 0, 0.02, chapter, "\"equal to tan theta\": 2 %, the width of symbols"},
    Published{"slope.uniform_I", Claim::equal, 0, 0.2, chapter,
              "\"constant\": 0.2 of I are 5 % of mu* at I = 0.1, the width of the law"},
    Published{"slope.uniform_Phi", Claim::equal, 0, 0.02, chapter, "\"constant\": 2 %, the width of symbols"},
    Published{"slope.local_mu", Claim::equal, 0, 0.01, chapter,
              "\"the law of homogeneous shear\": the spread of mu*_min"},
    Published{"slope.local_Phi", Claim::equal, 0, 0.01, chapter,
              "\"the law of homogeneous shear\": the spread of Phi_max"},
    Published{"slope.flows_above", Claim::at_least, 0, 0, chapter, drawn},
    Published{"annulus.moment", Claim::equal, 0, 0.02, koval, "balance of moments; 2 %: noise of rings"},
    Published{"annulus.local_mu", Claim::equal, 0, 0.01, koval,
              "\"doesn't depend on the stress\": the spread of mu*_min"},
    Published{"annulus.local_Phi", Claim::equal, 0, 0.01, koval,
              "\"doesn't depend on the stress\": the spread of Phi_max"},
    Published{"annulus.converges", Claim::at_least, 0, 0, "Galet: gradients fall as 1/R_i", drawn},
    Published{"annulus.creep", Claim::at_least, 0, 0, koval, drawn},
    // The chapter's last table: effects over what counts as one.
    Published{"regimes.Y", Claim::at_least, 1, 0, chapter, "printed O; 1: the effect that counts as one"},
    Published{"regimes.N", Claim::at_most, 1, 0, chapter, "printed N; 1: the effect that counts as one"},
    // Isotropic compression of spheres (Agnolin and Roux 2007, PRE 76, 061302, table of states; N = 4000, kappa =
    // 39000).
    Published{"compression.Phi_A", Claim::equal, 0.637, 0.001, agnolin, about},
    Published{"compression.z_star_A", Claim::equal, 6.07, 0.03, agnolin, about},
    Published{"compression.rattlers_A", Claim::equal, 0.013, 0.003, agnolin, "stated"},
    Published{"compression.Phi_C", Claim::equal, 0.635, 0.002, agnolin, "stated"},
    Published{"compression.z_star_C", Claim::equal, 4.56, 0.03, agnolin, "stated"},
    Published{"compression.rattlers_C", Claim::equal, 0.133, 0.005, agnolin, "stated"},
    Published{"compression.Phi_D", Claim::equal, 0.5923, 0.001, agnolin, about},
    Published{"compression.z_star_D", Claim::equal, 4.55, 0.03, agnolin, about},
    Published{"compression.rattlers_D", Claim::equal, 0.111, 0.004, agnolin, "stated"},
    // z with rattlers: the chapter speaks of z near 6 and near 4.
    Published{"compression.growth_A", Claim::equal, 0.05, 0.01, chapter,
              "\"about 5 %\" from kappa to infinity to 2000"},
    Published{"compression.z_2000", Claim::equal, 4.8, 0.1, chapter, "\"approaching 4.8\""},
    Published{"compression.left", Claim::at_most, 0.1, 0, chapter, "\"very little irreversible strain\": a tenth"},
    Published{"compression.moderate", Claim::equal, 0, 0.1, chapter, "\"moderate and progressive\": a tenth"},
    Published{"compression.cycle_z", Claim::at_most, 0, 0, chapter, "\"a high z may decrease in a cycle\""},
    Published{"compression.assembly_Phi", Claim::equal, 0, 0.003, chapter,
              "\"on mu only\", I up to 1e-4: a tenth of what friction does"},
    Published{"compression.assembly_z_star", Claim::equal, 0, 0.03, chapter,
              "\"on mu only\", I up to 1e-4: a tenth of what friction does"},
    Published{"compression.rattlers_2000", Claim::at_most, 0.5, 0, chapter, "\"a good half\" of them recruited"},
    // Cohesive flow: the figures' digits are not stated in the text, only what rises and falls.
    Published{"cohesive.falls", Claim::at_most, 0, 0, rognon, drawn},
    Published{"cohesive.rises", Claim::at_least, 0, 0, rognon, drawn},
    Published{"cohesive.mu_min_weak", Claim::equal, 0, 0.03, rognon,
              "\"does not affect\" below eta = 10: a tenth of mu*_min"},
    Published{"cohesive.deflection", Claim::equal, 1, 0.3, rognon,
              "an order of magnitude; pi/(z Phi) = 0.8 to 1.2 in packings"},
    // Critical state in simple shear.
    Published{"critical.mu_star_2D", Claim::equal, 0.26, 0.01, "Roux and Chevoir 2010; da Cruz et al. 2005",
              "covers both sources"},
    Published{"critical.Phi_2D", Claim::equal, 0.815, 0.005, "Roux and Chevoir 2010; da Cruz et al. 2005",
              "covers both sources"},
    Published{"critical.mu_star_3D_0", Claim::equal, 0.1009, 0.004, "Peyneau and Roux 2008", "stated"},
    Published{"critical.mu_star_3D_0.3", Claim::equal, 0.35, 0.02, chialvo, "read off a figure"},
    Published{"critical.mu_star_3D_0.5", Claim::equal, 0.38, 0.02, chialvo, "read off a figure"},
    Published{"critical.Phi_3D_0", Claim::equal, 0.636, 0.003, chialvo, critical_digits},
    Published{"critical.Phi_3D_0.1", Claim::equal, 0.613, 0.003, chialvo, critical_digits},
    Published{"critical.Phi_3D_0.3", Claim::equal, 0.596, 0.003, chialvo, critical_digits},
    Published{"critical.Phi_3D_0.5", Claim::equal, 0.587, 0.003, chialvo, critical_digits},
    Published{"critical.Phi_3D_1", Claim::equal, 0.581, 0.003, chialvo, critical_digits},
    Published{"critical.grows", Claim::at_least, 0, 0, chapter, drawn},
    Published{"critical.falls", Claim::at_most, 0, 0, chapter, drawn},
    Published{"critical.rolling_grows", Claim::at_least, 0, 0, estrada, drawn},
    Published{"critical.rolling_falls", Claim::at_most, 0, 0, estrada, drawn},
    Published{"critical.start_mu_star", Claim::equal, 0, 0.02, chapter, "\"independent of the initial state\": 2 %"},
    Published{"critical.start_Phi", Claim::equal, 0, 0.003, chapter,
              "\"independent of the initial state\": a tenth of what friction does"},
    // Triaxial compression from dense states, Phi about Phi*.
    Published{"triaxial.phi_0", Claim::equal, 5.5, 0.5, chapter, "stated"},
    Published{"triaxial.phi_0.3", Claim::equal, 24, 1, chapter, "stated"},
    Published{"triaxial.phi_0.5", Claim::equal, 26, 1, chapter, "stated"},
    Published{"triaxial.phi_1", Claim::equal, 28, 1, chapter, "stated"},
    Published{"triaxial.dilatancy_0", Claim::equal, 0, 0.01, chapter, "stated"},
    Published{"triaxial.dilatancy_0.3", Claim::equal, 0.52, 0.01, chapter, "stated"},
    Published{"triaxial.dilatancy_0.5", Claim::equal, 0.60, 0.01, chapter, "stated"},
    Published{"triaxial.dilatancy_1", Claim::equal, 0.71, 0.01, chapter, "stated"},
    Published{"triaxial.same_peak", Claim::equal, 0, 0.05, chapter,
              "the same peak: q/P within the stated degree of the friction angle"},
    Published{"triaxial.type_I", Claim::equal, 0, 0.05, chapter, "curves fall on one: 5 %"},
    Published{"triaxial.type_II", Claim::equal, 0, 0.05, chapter, "curves fall on one: 5 %"},
    Published{"triaxial.slow", Claim::equal, 0, 0.05, chapter, "\"independent of I and zeta\" for I below 1e-3: 5 %"},
    Published{"triaxial.fast", Claim::at_least, 0, 0, "Galet: inference from the flow laws, mu* grows with I",
              "at I = 0.01 inertia adds to q"},
    Published{"triaxial.creep", Claim::at_most, 3e-3, 0, chapter, "\"of the order of 1e-3 or 1e-4\""},
    Published{"triaxial.creep_falls", Claim::at_most, 0, 0, chapter, drawn},
    Published{"triaxial.rigid", Claim::at_most, 0.1, 0, "Galet: rigid grains have no strain of type I", "a tenth"},
    Published{"triaxial.instability", Claim::equal, 0, 0.1, chapter,
              "the structure breaks at a stress that is its own: 10 %, the scatter of samples"},
    Published{"triaxial.stiffer", Claim::at_least, 0, 0, chapter, drawn},
    // Consolidation of cohesive disks.
    Published{"consolidation.slope", Claim::at_most, 0, 0, gilabert, drawn},
    Published{"consolidation.rolling", Claim::at_least, 0, 0, gilabert, drawn},
    Published{"consolidation.looser", Claim::at_least, 0, 0, gilabert, drawn},
    Published{"consolidation.unloading", Claim::at_most, 0.1, 0, gilabert, "\"little strain\": a tenth"},
};

}  // namespace

std::span<const Published> published_table() { return table; }

const Published& published(std::string_view key) {
  const auto* found = std::find_if(table.begin(), table.end(), [&](const Published& p) { return p.key == key; });
  require(found != table.end(), "no published number is called '" + std::string(key) + "'");
  return *found;
}

Estimate published_estimate(std::string_view key) { return {published(key).value, published(key).uncertainty}; }

}  // namespace galet
