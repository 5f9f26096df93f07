// Everything that a program which uses Galet as a library needs: #include <galet/galet.hpp>.
//
//   galet::Scene scene = galet::read_scene("plane_shear_2d.toml");
//   galet::Simulation<2> simulation(scene, galet::EngineKind::cd);
//   const galet::RunResult result = simulation.run();
//   const galet::Estimate mu_star = result.averages[galet::Observable::mu_star];
//
// The parts can be used alone: a scene built in code, initial_sample(), derive(), md::make_engine() or
// cd::make_engine(), Engine::advance(), Engine::snapshot() and the measures of common/measure.
#pragma once

#include "cd/engine.hpp"
#include "common/core/archive.hpp"
#include "common/core/conventions.hpp"
#include "common/core/error.hpp"
#include "common/core/parallel.hpp"
#include "common/engine/engine.hpp"
#include "common/io/checkpoint.hpp"
#include "common/io/scene_file.hpp"
#include "common/io/svg.hpp"
#include "common/measure/balance.hpp"
#include "common/measure/block_average.hpp"
#include "common/measure/coordination.hpp"
#include "common/measure/elastic_moduli.hpp"
#include "common/measure/equilibrium_matrix.hpp"
#include "common/measure/fabric.hpp"
#include "common/measure/force_distribution.hpp"
#include "common/measure/gap_distribution.hpp"
#include "common/measure/mobilisation.hpp"
#include "common/measure/numbers.hpp"
#include "common/measure/profile.hpp"
#include "common/measure/radial_profile.hpp"
#include "common/measure/stress.hpp"
#include "common/measure/temperature.hpp"
#include "common/measure/voronoi.hpp"
#include "common/scene/check.hpp"
#include "common/scene/derive.hpp"
#include "common/scene/packing.hpp"
#include "common/scene/sample.hpp"
#include "common/scene/scene.hpp"
#include "md/engine.hpp"
#include "src/compare.hpp"
#include "src/rigid_limit.hpp"
#include "src/simulation.hpp"
