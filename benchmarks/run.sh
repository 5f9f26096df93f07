#!/usr/bin/env bash
# Makes the committed results again:  benchmarks/run.sh [NAME...]     (default: all; about an hour on two cores)
#
#   plane_shear_2d   galet compare scenes/plane_shear_2d.toml: both engines, speed against error
#   isotropic_3d     both engines on scenes/isotropic_3d.toml
#   frictionless_2d  both engines on scenes/frictionless_2d.toml
#   presets          every ready scene with both engines side by side: stresses, Phi, z, mu*, energy budget, time (an hour or more)
#   layouts          what each layout costs (Google Benchmark)
#   stages           what each stage of a step costs (Google Benchmark)
#   md_scaling       speed, stages and memory of md from 1e3 to 1e6 grains (about five minutes, 3 GB; --quick: to 64000, half a minute)
#   engine_scaling   cost per grain and step and memory of both engines, 1e3 to 1e6 grains (cd: to 1e5), size ratios 1, 10 and 50
#   neighbour_sizes  cost of making a neighbour list: equal grains, size ratios 1:10 and 1:50, dilute gases
#   solver_sweeps    Gauss-Seidel, plain and with momentum
#   cd_runs          whole runs of cd: time per step and contact, share of the solver, steps that missed
#   cd_piles         the contact solver on packings under gravity, 400 to 50000 contacts, and on pile3d where GALET_FCLIB holds it
#   solver_bodies    second-order methods on matrices of bodies and of contacts, on packings under gravity and on pile3d likewise
#   cd_compliance    deflections of a packing under a stress increment in both engines, kappa = 1e3 to 1e6, and their cost
#   cd_cell_inertia  plane shear with the cell's inertia a tenth to ten times the default, both engines
#   rough_wall       plane shear between rough walls against the periodic cell at the same I, both engines (about eight minutes)
#   hertz_compression  frictionless glass beads from 10 kPa on: Phi, z*, rattlers, z* against kappa (three packings)
#   lammps_peer      the same packing and law in LAMMPS; skipped where it is not installed
#   lammps_speed     grain-steps per second of LAMMPS and md in turn, and of two threads; needs LAMMPS too
#   md_accuracy      error of md against the step beside the usual scheme, and the work to reach an error (uses lammps_speed)
#   md_drift         energy and positions of md over 1e7 steps of packings that nothing drives (about four minutes)
#   work_precision   error against processor time of both engines in eight classes of scenes, where one overtakes the other, cost laws, and
#                    orders of convergence to the rigid limit (about ten minutes of one core; goes on where it was stopped)
#   rigid_limit      contact forces of a hyperstatic packing in md and elastic cd at kappa = 1e2 to 1e7, contact by contact
#   same_packing     where the interval of strains of type I ends, on the same packings in md, elastic and rigid cd (about fifteen minutes)
#   verify           galet verify --all: every case whose answer is known, both engines (docs/verification.md)
#   siconos_hard_cases  contact problems of hard cases given to Siconos; skipped where it is not installed
#   studies          every study of `galet study --list` in its quick size (GALET_STUDY_SIZE=full: the published sizes, days, under
#                    results/studies_full; rows there are finished runs, from which it goes on), then docs/reproduction.md; not among
#                    the default
#   gradient_flows   stop and flow on a rough inclined plane, both engines
#   faults           runs of both engines killed at 200 random moments each, a full file system, 1e4 damaged checkpoints, 1e5 scenes with
#                    mistakes
#   solver_profile   every contact solver on every FCLIB problem of the folder GALET_FCLIB, beside Siconos where it is installed (about ten
#                    minutes); skipped where that is not set
#   solver_starts    solvers on the large pile of disks of this folder from seven perturbed starts; likewise
#   solver_settings  settings of momentum, chosen on one half of these problems and looked at on the other; likewise
#
# Results go to benchmarks/results/NAME, each with machine.txt beside it; docs/validation.md and docs/verification.md are then made from them.
set -euo pipefail
root=$(CDPATH='' cd -- "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
cd "$root"
# scripts/test leaves its configuration in the same folder.
cmake --preset release -DGALET_BUILD_BENCHMARKS=ON -DGALET_OPTIMISE_BENCHMARKS=ON >/dev/null
cmake --build --preset release
bin=build/release
names=("$@")
[ ${#names[@]} -gt 0 ] || names=(solver_sweeps cd_compliance cd_cell_inertia rough_wall cd_piles solver_bodies cd_runs layouts stages isotropic_3d frictionless_2d hertz_compression lammps_peer lammps_speed md_accuracy md_drift solver_profile work_precision rigid_limit same_packing verify siconos_hard_cases plane_shear_2d)
for name in "${names[@]}"; do
  if [ "$name" = studies ]; then
    size=--quick kind=studies
    [ "${GALET_STUDY_SIZE:-quick}" = full ] && size='' kind=studies_full
    for study in $("$bin/src/galet" study --list | awk 'NR > 1 && NF == 0 { exit } NR > 1 { print $1 }'); do
      out=benchmarks/results/$kind/$study
      "$bin/src/galet" study "$study" $size --jobs 2 --out "$out"
      rm -rf "$out"/*.png "$out/rows"  # tables and scenes say the same
      benchmarks/machine.sh >"$out/machine.txt"
    done
    benchmarks/reproduction.sh >docs/reproduction.md
    continue
  fi
  out=benchmarks/results/$name
  mkdir -p "$out"
  echo "== $name"
  case $name in
    plane_shear_2d) "$bin/src/galet" compare "scenes/$name.toml" --jobs 2 --out "$out" | tee "$out/table.txt" ;;
    isotropic_3d | frictionless_2d)
      for engine in md cd; do
        "$bin/src/galet" run "scenes/$name.toml" --engine $engine --out "build/out/$name" | tee "$out/$engine.txt"
      done ;;
    presets)
      # A part per scene: what a run that was broken off has finished is not run again.
      parts=build/out/presets
      mkdir -p "$parts"
      for scene in scenes/*.toml; do
        part=$parts/$(basename "$scene" .toml).csv
        [ -f "$part" ] && continue
        "$bin/benchmarks/presets" scenes "$(basename "$scene" .toml)" | tee "$part.part"
        mv "$part.part" "$part"
      done
      awk 'FNR > 1 || NR == 1' "$parts"/*.csv >"$out/presets.csv"
      rm -r "$parts" ;;
    layouts) "$bin/benchmarks/layouts" --benchmark_min_time=0.7 --benchmark_format=csv 2>/dev/null | tee "$out/layouts.csv" ;;
    stages)
      "$bin/benchmarks/stages" --benchmark_min_time=0.2 --benchmark_repetitions=5 --benchmark_report_aggregates_only=true \
        --benchmark_format=csv 2>/dev/null | awk -F, '
          /^name,/ { print "stage,ns per item,item,spread"; next }
          { gsub(/"/, ""); sub("/manual_time", "", $1) }
          $1 ~ /_median$/ { sub("_median", "", $1); name[++rows] = $1; item[rows] = $8; value[rows] = 1e9 * $NF }
          $1 ~ /_cv$/ { spread[rows] = $NF }
          END { for (k = 1; k <= rows; ++k) printf "%s,%.3g,%s,%.2g\n", name[k], value[k], item[k], spread[k] }' | tee "$out/stages.csv" ;;
    siconos_hard_cases)
      "$bin/benchmarks/siconos_hard_cases" "$out"
      if [ ! -f "$out/summary.csv" ]; then
        rmdir --ignore-fail-on-non-empty "$out"
        continue
      fi ;;
    md_scaling) "$bin/benchmarks/md_scaling" | tee "$out/md_scaling.csv" ;;
    engine_scaling)
      "$bin/benchmarks/engine_scaling" "$out"
      rm -f "$out"/*.png ;;
    md_drift) "$bin/benchmarks/md_drift" | tee "$out/md_drift.csv" ;;
    neighbour_sizes) "$bin/benchmarks/neighbour_sizes" | tee "$out/neighbour_sizes.csv" ;;
    solver_sweeps) "$bin/benchmarks/solver_sweeps" | tee "$out/solver_sweeps.csv" ;;
    cd_compliance) "$bin/benchmarks/cd_compliance" | tee "$out/cd_compliance.csv" ;;
    cd_runs) "$bin/benchmarks/cd_runs" | tee "$out/cd_runs.csv" ;;
    cd_cell_inertia) "$bin/benchmarks/cd_cell_inertia" "$out/cd_cell_inertia" | tee "$out/cd_cell_inertia.csv" ;;
    rough_wall) "$bin/benchmarks/rough_wall" scenes/rough_wall_shear_2d.toml "$out" ;;
    cd_piles)
      pile=${GALET_FCLIB:+$GALET_FCLIB/pile3d.geo}
      if [ -n "$pile" ] && [ -f "$pile" ]; then "$bin/benchmarks/cd_piles" "$out" "$pile"; else "$bin/benchmarks/cd_piles" "$out"; fi ;;
    solver_bodies)
      pile=${GALET_FCLIB:+$GALET_FCLIB/pile3d.geo}
      if [ -n "$pile" ] && [ -f "$pile" ]; then "$bin/benchmarks/solver_bodies" "$pile"; else "$bin/benchmarks/solver_bodies"; fi | tee "$out/solver_bodies.csv" ;;
    hertz_compression)
      for seed in 1 2 3; do "$bin/benchmarks/hertz_compression" 4000 $seed | tee "$out/seed_$seed.csv"; done ;;
    same_packing) "$bin/benchmarks/same_packing" | tee "$out/same_packing.csv" ;;
    lammps_peer) benchmarks/peers/lammps.sh "$out/table.csv" ;;
    lammps_speed) benchmarks/peers/lammps_speed.sh "$out" ;;
    md_accuracy)
      speeds=benchmarks/results/lammps_speed/cases.csv
      if [ -f $speeds ]; then "$bin/benchmarks/md_accuracy" "$out" $speeds; else "$bin/benchmarks/md_accuracy" "$out"; fi ;;
    work_precision)
      "$bin/benchmarks/work_precision" "$out"
      rm -f "$out"/*.png ;;
    rigid_limit)
      "$bin/benchmarks/rigid_limit" "$out"
      rm -f "$out"/*.png ;;
    verify)
      # A case that fails is a result too.
      "$bin/src/galet" verify --all --out "$out" | tee "$out/table.txt" || true ;;
    gradient_flows)
      "$bin/benchmarks/gradient_flows" | tee "$out/slope.csv" ;;
    faults)
      {
        GALET_KILLS=200 "$bin/tests/command/command_tests"
        "$bin/tests/long_tests" --gtest_filter='Mutations.*'
      } | grep -v '^Note\|^Running\|^ *$\|RUN\|^\[---' | sed 's/ ([0-9]* ms.*)//; s/, where GetParam() = .*//' | tee "$out/faults.txt" ;;
    solver_profile | solver_settings | solver_starts)
      if [ -z "${GALET_FCLIB:-}" ]; then
        echo "skipped: GALET_FCLIB names no folder of FCLIB problems"
        rmdir --ignore-fail-on-non-empty "$out"
        continue
      fi
      if [ "$name" = solver_settings ]; then
        "$bin/benchmarks/solver_settings" "$GALET_FCLIB" | tee "$out/solver_settings.csv"
      elif [ "$name" = solver_starts ]; then
        "$bin/benchmarks/solver_starts" "$GALET_FCLIB/pile2d.hdf5" 1 | tee "$out/pile2d.csv"
      else
        "$bin/benchmarks/solver_profile" "$GALET_FCLIB" "$out" 0.7
      fi ;;
    *) echo "no benchmark called $name" >&2; exit 2 ;;
  esac
  # Paths of this run say nothing to a reader.
  sed -i '/^wrote /d' "$out"/*.txt 2>/dev/null || true
  benchmarks/machine.sh >"$out/machine.txt"
done
benchmarks/validation.sh >docs/validation.md
benchmarks/verification.sh >docs/verification.md
echo "wrote docs/validation.md, docs/verification.md"
