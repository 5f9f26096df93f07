#!/bin/sh
# Prints docs/validation.md from the results under benchmarks/results:  benchmarks/validation.sh >docs/validation.md
set -eu
root=$(CDPATH='' cd -- "$(dirname "$0")/.." && pwd)
results=$root/benchmarks/results

# block FILE...: the files' contents as a block of code.
block() { echo '```'; cat "$@"; echo '```'; echo; }
measured_on() { echo "Measured on:"; echo; block "$results/$1/machine.txt"; }
# siconos_ratios TIMES.csv: per problem and measure Siconos' best time over that of auto at 1e-4, 1e-6 and 1e-8.
siconos_ratios() {
  awk -F, '
    NR == 1 { print "problem,contacts,measure,ratio at 1e-4,at 1e-6,at 1e-8,quickest of Siconos at 1e-4"; next }
    $2 < 10 { next }
    { key = $1 "," $2 "," $5; if (!(key in seen)) { seen[key] = 1; order[++count] = key } }
    $4 == "auto" { for (k = 0; k < 3; ++k) own[key, k] = $(6 + k) }
    $4 ~ /^siconos / {
      for (k = 0; k < 3; ++k)
        if ($(6 + k) != "" && (!((key, k) in best) || $(6 + k) + 0 < best[key, k])) { best[key, k] = $(6 + k) + 0; who[key, k] = substr($4, 9) }
    }
    END {
      for (n = 1; n <= count; ++n) {
        key = order[n]; row = key
        for (k = 0; k < 3; ++k)
          row = row "," (own[key, k] == "" ? "-" : (key, k) in best ? sprintf("%.3g", best[key, k] / own[key, k]) : "none")
        print row "," who[key, 0]
      }
    }' "$1"
}

# csv_table FILE: a CSV file as a Markdown table.
csv_table() { awk -F, '{ gsub(/"/, ""); printf "|"; for (k = 1; k <= NF; ++k) printf " %s |", $k; print "";
                       if (NR == 1) { printf "|"; for (k = 1; k <= NF; ++k) printf "---|"; print "" } }' "$1"; echo; }

cat <<'END'
# Validation

Made by `benchmarks/validation.sh` from the results under `benchmarks/results`, which `benchmarks/run.sh` makes again.
Times are of one machine and one run: only their ratios mean something elsewhere. Errors are standard errors.

## Plane shear of disks: both engines, speed against error

`galet compare scenes/plane_shear_2d.toml`. Literature for this material: μ* = 0.26 + 1.1 I, Φ = 0.82 − 0.37 I between
rough walls (the chapter, after da Cruz et al. 2005): 0.37 and 0.783 at I = 0.1, 0.271 and 0.816 at I = 0.01.

END
block "$results/plane_shear_2d/table.txt"
cat <<'END'
![error against cost](../benchmarks/results/plane_shear_2d/error_cost.svg)

![force chains, rigid engine](../benchmarks/results/plane_shear_2d/sample_cd.svg)

END
measured_on plane_shear_2d
if [ -f "$results/work_precision/work.csv" ]; then
  cat <<'END'
## Speed against error, class by class

`benchmarks/run.sh work_precision`: both engines answer one question about rigid grains in each of eight classes of scenes, at many settings (md: κ and
steps per contact; cd: dt and tolerance). Errors of the first three are against exact answers; of the others they are relative to the rigid limit that both
engines tend to, and never counted smaller than their standard error.

- impact: where 100 disks are after an oblique, sliding impact on a plane (rms over them, d);
- column: forces (over the weight) and heights (over the column's) of 30 disks at rest that start touching, the larger error of both;
- packing: contact forces of 40 frictionless disks after a change of load, which statics determines (rms over the mean force);
- gas: kinetic energy left of 500 disks, e = 0.9, after six collisions each, eight seeds;
- biaxial: q/P of six packings of 100 disks, mean over axial strains from 1 % to 2 %;
- triaxial: σ_zz/P − 1 of six packings of 100 spheres, mean over axial strains from 1 % to 2 %;
- flow_0.1, flow_0.01: μ* of 300 disks in plane shear at that I.

md: processor seconds of the steps per unit of the column `per`; cd likewise. A cost between two settings is interpolated along the front of the best ones.

END
  csv_table "$results/work_precision/at_error.csv"
  cat <<'END'
Where which engine is cheaper: ranges of errors, and by which factors (`alone`: the other engine does not get there with the settings tried).

END
  grep -v '^#' "$results/work_precision/crossover.csv" >"${TMPDIR:-/tmp}/crossover.$$"
  csv_table "${TMPDIR:-/tmp}/crossover.$$"
  rm -f "${TMPDIR:-/tmp}/crossover.$$"
  if [ -f "$results/work_precision/crossings.csv" ]; then
    cat <<'END_OF_CROSSINGS'
The errors at which one engine overtakes the other, and md's κ and cd's settings there: `low` to `high` hold the middle two thirds of what 400 redrawings of
the rows give (errors moved by their standard errors, costs by a tenth), `share` says how many of them cross at all.

END_OF_CROSSINGS
    csv_table "$results/work_precision/crossings.csv"
  fi
  for class in impact column packing gas biaxial triaxial flow_0.1 flow_0.01; do
    printf '![%s: error against cost](../benchmarks/results/work_precision/%s.svg)\n\n' "$class" "$class"
  done
  printf 'Cost laws: exponents of cost in one parameter, the others fixed, with the error that the scatter about the law gives.\n\n'
  csv_table "$results/work_precision/cost.csv"
  measured_on work_precision
  cat <<'END'
## Rigid limit

Deviations of md from the rigid limit at κ = 10² to 10⁷, from the same runs, and the exponent of κ with which they shrink (of those that stand out of
their noise). Units as in the classes; [theory](theory.md#rigid-limit) says why.

END
  csv_table "$results/work_precision/limit.csv"
fi
if [ -f "$results/rigid_limit/forces.csv" ]; then
  cat <<'END'
Forces of a hyperstatic packing (`benchmarks/run.sh rigid_limit`; columns at the head of `benchmarks/rigid_limit.cpp`): md and elastic cd take the same
ones, contact by contact, and both tend to one limit; rigid cd takes another set that is in equilibrium as well.

END
  grep -v '^#' "$results/rigid_limit/forces.csv" >"${TMPDIR:-/tmp}/forces.$$"
  csv_table "${TMPDIR:-/tmp}/forces.$$"
  rm -f "${TMPDIR:-/tmp}/forces.$$"
  printf '![differences of forces against the stiffness level](../benchmarks/results/rigid_limit/forces.svg)\n\n'
  measured_on rigid_limit
fi
if [ -f "$results/same_packing/same_packing.csv" ]; then
  cat <<'END'
## The same packings in both engines

Spheres of state A (frictionless assembly, then μ = 0.3; κ = 39000) assembled by md and by rigid cd, each loaded by md, elastic cd and rigid cd: the axial
stress rises slowly from P. Strains are of type I (carried by the contacts there are) until the structure breaks. `benchmarks/run.sh same_packing`; columns
at the head of `benchmarks/same_packing.cpp`.

END
  csv_table "$results/same_packing/same_packing.csv"
  measured_on same_packing
fi
for name in isotropic_3d frictionless_2d; do
  case $name in
    isotropic_3d) echo "## Isotropic compression of frictional spheres (3D)"
      literature="Slow compression with friction 0.3 gives Φ about 0.593, z* about 4.5 and 11 % rattlers at N = 4000 (Agnolin and Roux 2007)." ;;
    frictionless_2d) echo "## Isotropic compression of frictionless disks (2D)"
      literature="Jamming of frictionless disks: Φ = 0.84 and z* close to 4 (O'Hern et al. 2003)." ;;
  esac
  printf '\n`galet run scenes/%s.toml --engine md` and `--engine cd`. %s\n\n' "$name" "$literature"
  for engine in md cd; do block "$results/$name/$engine.txt"; done
  measured_on "$name"
done
echo "## Isotropic compression of frictionless Hertz spheres"
cat <<'END'

Glass beads (E = 70 GPa, ν = 0.3) assembled from a gas at 10 kPa, then compressed further; each row at rest (kinetic energy per grain
below 5e-8 P d³). Agnolin and Roux (2007), state A, N = 4000, about: Φ = 0.637, z* = 6.07, 1.3 % rattlers at κ = 39000; the chapter: z*
grows by about 5 % down to κ = 2000. `benchmarks/run.sh hertz_compression`, or `hertz_compression N SEED`.

END
for file in "$results"/hertz_compression/*.csv; do
  case $file in */n*_seed_*) size=${file##*/n} size=${size%%_*} ;; *) size=4000 ;; esac
  printf 'N = %s:\n\n' "$size"
  csv_table "$file"
done
measured_on hertz_compression
echo "## The same packing in LAMMPS"
cat <<'END'

A packing of 500 spheres (μ = 0.3, K_T = 2/7 K_N, `total` convention) sheared in the solid regime by both codes from the same state
(`benchmarks/peers/lammps.sh`; what differs and why is at the head of `benchmarks/peers/lammps.cpp`). `position_*`: rms distance from md's
run at the finest step, over the rms non-affine displacement; `stress_*`: largest difference of a component over the largest component.

END
grep -v '^#' "$results/lammps_peer/table.csv" >"${TMPDIR:-/tmp}/peer.$$"
csv_table "${TMPDIR:-/tmp}/peer.$$"
rm -f "${TMPDIR:-/tmp}/peer.$$"
echo '```'
grep '^#' "$results/lammps_peer/table.csv"
echo '```'
echo
measured_on lammps_peer
if [ -f "$results/lammps_speed/cases.csv" ]; then
  echo "## Speed against LAMMPS"
  cat <<'END'

Grain-steps per second of processor time, in millions, of both codes in turn on one core: the same packing, law, step and rate, LAMMPS
with the best settings found (`benchmarks/peers/lammps_speed.cpp` says which were tried); `ratio_usual`: with the settings of its own granular
example. `*_difference`: between the ends of both runs.

END
  csv_table "$results/lammps_speed/cases.csv"
  printf 'Two threads against one, by wall time:\n\n'
  csv_table "$results/lammps_speed/threads.csv"
  measured_on lammps_speed
  printf 'The same on other processors (`side_by_side`: speedup of two runs that share nothing):\n\n'
  for other in lammps_speed_zen5 lammps_speed_xeon; do
    csv_table "$results/$other/cases.csv"
    csv_table "$results/$other/threads.csv"
    measured_on $other
  done
  printf 'The same with AVX2 (four lanes), on a host that others load, before grains stepped behind their contacts:\n\n'
  csv_table "$results/lammps_speed_avx2/cases.csv"
  measured_on lammps_speed_avx2
fi
if [ -f "$results/md_accuracy/orders.csv" ]; then
  echo "## Error against the time step"
  cat <<'END'

Errors at 10.4 to 320.4 steps per collision of md and of the usual scheme (collisions: a program of its own; packings: LAMMPS), observed
orders, and steps per collision at which an error is reached (~: extrapolated). What is measured against what stands at the head of
`benchmarks/md_accuracy.cpp`; `check`: how far the limits of both programs lie apart. Don't take the ratios of the sheared packings for the
codes': LAMMPS's errors there are far above those of its scheme; a lag of its deforming cell is suspected, not proven.

END
  csv_table "$results/md_accuracy/orders.csv"
  printf 'Work to reach an error: ratio of steps times ratio of speeds.\n\n'
  csv_table "$results/md_accuracy/work.csv"
  measured_on md_accuracy
fi
echo "## Layouts and terms"
printf '\nThe same sample and the same motion (mu = 0) in the frictionless layout and in the frictional one, with friction, and what\n'
printf 'each term of the law of md adds (a term that is off has no code in the kernel that runs).\n'
printf '`grain_steps`: grains times steps per second of processor time.\n\n'
awk -F, '/^name,/ || /^"/ { gsub(/"/, ""); print $1 "," $4 "," $5 "," $(NF-1) "," $NF }' "$results/layouts/layouts.csv" >"${TMPDIR:-/tmp}/layouts.$$"
csv_table "${TMPDIR:-/tmp}/layouts.$$"
rm -f "${TMPDIR:-/tmp}/layouts.$$"
measured_on layouts
if [ -f "$results/stages/stages.csv" ]; then
  cat <<'END'
## Stages

`benchmarks/run.sh stages` (Google Benchmark): what each stage of a step costs per item on packings of 2000 disks and 2000 spheres, processor time, medians of
five. The passes of md are those of a run in shear; a sweep of cd is one of fifty from a cold start.

END
  csv_table "$results/stages/stages.csv"
  measured_on stages
fi
echo "## Contact solver"
printf '\nSweeps from a cold start on a dense packing under pressure, plain and with momentum.\n\n'
csv_table "$results/solver_sweeps/solver_sweeps.csv"
measured_on solver_sweeps
if [ -f "$results/cd_compliance/cd_compliance.csv" ]; then
  cat <<'END'
## Elastic contacts in both engines

A packing of 125 spheres takes up a small deviatoric stress increment with friction, in md and in cd with compliance, from the same positions.
`change`: largest change of a deflection over the mean one; `deflection`, `force`: largest difference between the engines over the
largest change. With friction 10 no contact slides. Where a weak contact slides or opens on the way it keeps a shear force of that way, and cd's
coarse steps go another way than md: this is what the larger differences are.

END
  csv_table "$results/cd_compliance/cd_compliance.csv"
  measured_on cd_compliance
fi
if [ -f "$results/cd_cell_inertia/cd_cell_inertia.csv" ]; then
  cat <<'END'
## Inertia of the stress-driven cell

Plane shear of 400 disks at I = 0.1 with the cell's inertia a tenth to ten times the default: means over a strain of 30 with their
standard errors.

END
  csv_table "$results/cd_cell_inertia/cd_cell_inertia.csv"
  printf '![mu* and Phi against the inertia of the cell](../benchmarks/results/cd_cell_inertia/cd_cell_inertia.svg)\n\n'
  measured_on cd_cell_inertia
fi
if [ -f "$results/rough_wall/flows.csv" ]; then
  cat <<'END'
## Rough walls against the periodic cell

`benchmarks/run.sh rough_wall`: plane shear of 1000 disks between rough walls, the upper one pressed by a force, and in the periodic cell at the I of
the middle half between the walls; there the walls order no layers. Means with block errors; `seconds`: processor time. Then walls less cell, with the
standard error (that of I included), and whether they agree within two of these.

END
  csv_table "$results/rough_wall/flows.csv"
  csv_table "$results/rough_wall/verdict.csv"
  measured_on rough_wall
fi
if [ -f "$results/cd_piles/growth.csv" ]; then
  cat <<'END'
## Contact solver on packings under gravity

Piles cut out of one packing of spheres, cold starts to errS = 1e-4, and a pile of another code from seven perturbed starts (empty: not reached in
14000 sweeps). Processor seconds.

END
  csv_table "$results/cd_piles/growth.csv"
  printf '![time against contacts](../benchmarks/results/cd_piles/growth.svg)\n\n'
  [ ! -f "$results/cd_piles/pile3d.csv" ] || csv_table "$results/cd_piles/pile3d.csv"
  measured_on cd_piles
fi
if [ -f "$results/cd_runs/cd_runs.csv" ]; then
  cat <<'END'
## Contact solver in whole runs

2000 spheres that settle on a floor (first and second half of the time) and 1000 disks in plane shear at I = 0.01. Every step is solved to the
tolerance (relative error of the impulses) or counts as missed.

END
  csv_table "$results/cd_runs/cd_runs.csv"
  measured_on cd_runs
fi
if [ -f "$results/neighbour_sizes/neighbour_sizes.csv" ]; then
  cat <<'END'
## Neighbour lists of unlike grains

Cost of making a list from nothing.

END
  csv_table "$results/neighbour_sizes/neighbour_sizes.csv"
  measured_on neighbour_sizes
fi
if [ -f "$results/presets/presets.csv" ]; then
  cat <<'END'
## Every ready scene, both engines

`benchmarks/run.sh presets`. Stresses, μ*, Φ and z are those of the run's summary (of stages before the last: their last sample). `held`: what the loading asks
for at the end of a stage and what was there (mean and scatter of the rows of its last third; between walls and down a slope: of the middle of
the profile; under gravity: stress over the weight above; between rings: radial stress, and the moment ring by ring). `budget`: md: energy not accounted for over energy dissipated; cd: energy that contacts made over energy they dissipated.
`missed`: steps of cd above the solver's tolerance. `penetration`: the largest, over d. `changes`: fields of the scene that were changed for the table, to
make runs shorter; empty: the scene as it is.

END
  csv_table "$results/presets/presets.csv"
  missing=
  for scene in "$root"/scenes/*.toml; do
    name=$(basename "$scene" .toml)
    grep -q "^$name," "$results/presets/presets.csv" || missing="$missing $name"
  done
  [ -z "$missing" ] || printf 'Not in the table, because not yet run for it:%s.\n\n' "$missing"
  if [ -f "$results/presets/finding.md" ]; then cat "$results/presets/finding.md"; echo; fi
  measured_on presets
  cat <<'END'
### Assembled states against the literature

Scenes of the table (500 spheres, 1000 disks) and, for state A at N = 4000 with Hertz contacts, [the section above](#isotropic-compression-of-frictionless-hertz-spheres). Published: about; the
protocols, sizes and contact laws differ. Grade S: stated in the chapter; P: digits read in the source; M+, M: digits not read again in the source, of high and of medium confidence.

| state | published | grade | scene, stage | engine | Φ | z | z* |
|---|---|---|---|---|---|---|---|
END
  # state_rows STATE PUBLISHED GRADE SCENE STAGE
  state_rows() {
    awk -F, -v state="$1" -v published="$2" -v grade="$3" -v scene="$4" -v stage="$5" '
      $1 == scene && $3 == stage { printf "| %s | %s | %s | %s%s | %s | %s | %s | %s |\n", state, published, grade, scene,
                                   stage == "" ? "" : ", " stage, $2, $10, $11, $12 }' "$results/presets/presets.csv"
  }
  state_rows "2D, frictionless" "Φ = 0.842 ± 0.002 (50:50 disks 1:1.4, O'Hern et al. 2003); chapter: 0.85" "M+, S" frictionless_2d ""
  state_rows "3D, frictionless (A)" "Φ = 0.639 ± 0.001 (O'Hern et al. 2003); A: 0.637, z* = 6.07, 1.3 % rattlers (Agnolin and Roux 2007)" "M+/P; M" assembly_3d A
  state_rows "C" "Φ = 0.635, z* = 4.56, 13.3 % rattlers (Agnolin and Roux 2007)" "M" assembly_3d C
  state_rows "D" "Φ = 0.5923, z* = 4.55, 11.1 % rattlers (Agnolin and Roux 2007)" "P/M" isotropic_3d ""
  echo
fi
if [ -f "$results/gradient_flows/slope.csv" ]; then
  cat <<'END'
## Stop and flow on a rough inclined plane

`benchmarks/run.sh gradient_flows`; what was run stands at the head of `benchmarks/gradient_flows.cpp`: a layer of disks 12 d deep.

END
  csv_table "$results/gradient_flows/slope.csv"
  cat <<'END'
`cd` takes a coarse step (0.02 of the unit of time, 0.07 inertial times at the floor); near rest it goes on trembling at 1e-5. It flows slower than md. The
step is not the cause: see the study [inclined-plane](reproduction.md#flow-down-a-rough-inclined-plane-and-the-law-of-homogeneous-shear), which has the local law too; annular shear is
[a study](reproduction.md#annular-shear-the-local-law-at-several-radii-and-creep) as well.

END
  measured_on gradient_flows
fi
if [ -f "$results/faults/faults.txt" ]; then
  cat <<'END'
## Faults

`benchmarks/run.sh faults`: programs killed (SIGKILL) at random moments, interrupted, or left without room, and damaged files. Each kill: every file that was
finished before is whole, the checkpoint loads, and the run that goes on from it ends with the bits of the run that nobody disturbed.
Damaged checkpoints are refused or have the sound one's bits; scenes with mistakes are refused or read as they are written.

END
  block "$results/faults/faults.txt"
  measured_on faults
fi
cat <<'END'
## Cost of md against the number of grains

`benchmarks/run.sh md_scaling`: packings tiled from one of 1000 grains, at rest, in shear, and at rest with grains numbered at random.
Times in ns per grain and step, listed pair, and touching pair, then by stage; memory in bytes per grain and per listed pair that the arrays
hold; `moved`: bytes that a grain-step moves by the layout; `floor`: the ns that these take at the measured `stream` rate (GB/s).

END
csv_table "$results/md_scaling/md_scaling.csv"
measured_on md_scaling
if [ -f "$results/engine_scaling/engine_scaling.csv" ]; then
  cat <<'END'
## Cost of both engines against the number of grains, and the ratio of sizes

`benchmarks/run.sh engine_scaling`; what was run stands at the head of `benchmarks/engine_scaling.cpp`. ns of processor time per grain and step (median of
five batches, least and most), resident bytes per grain.

END
  csv_table "$results/engine_scaling/engine_scaling.csv"
  printf '![cost per grain and step](../benchmarks/results/engine_scaling/cost.svg)\n\n![memory per grain](../benchmarks/results/engine_scaling/memory.svg)\n\n'
  if [ -f "$results/engine_scaling/finding.md" ]; then cat "$results/engine_scaling/finding.md"; echo; fi
  measured_on engine_scaling
fi
if [ -f "$results/md_drift/md_drift.csv" ]; then
  cat <<'END'
## Drift of md over many steps

`benchmarks/run.sh md_drift`: packings that nothing drives. `energy`: change of the mean total energy over the energy of the kick (at rest: of the
elastic energy over itself); `moved`, `farthest`: distance of the grains with a contact from their places, over d, the common motion taken off.
Without friction and damping what heats is the kink of the force where contacts open and close; half the step heats eight times less in the same time.

END
  csv_table "$results/md_drift/md_drift.csv"
  measured_on md_drift
fi
cat <<'END'
## Contact solvers on problems of other codes

`GALET_FCLIB=FOLDER benchmarks/run.sh solver_profile`: processor seconds until each error was reached, automatic choice of solver; empty: not
reached in the 0.7 s given (the two large piles and the rocks need more than that or are not solved to 1e-8 at all; an earlier run on a quieter
machine brought fc2d_..._02020 to 1e-8 in 0.6 s and RockPile to errS 1e-6 in 0.7 s). The figures show the automatic choice, one method of each
kind and Siconos (whose Newton method and ADMM are for problems in space only): the share of the problems that each brought to 1e-6 within a
factor of the fastest one's time; `times.csv` has every solver.

END
{ head -1 "$results/solver_profile/times.csv"; grep ',auto,' "$results/solver_profile/times.csv"; } >"${TMPDIR:-/tmp}/galet_auto_$$.csv"
csv_table "${TMPDIR:-/tmp}/galet_auto_$$.csv"
rm -f "${TMPDIR:-/tmp}/galet_auto_$$.csv"
if grep -q ',siconos ' "$results/solver_profile/times.csv"; then
  cat <<'END'
Beside Siconos 4.4 (Debian), in the same run on the same W, q and μ: time of the quickest of its solvers tried (Gauss-Seidel; in space also
Alart and Curnier's Newton method and ADMM, with rolling ADMM; its own defaults, W in blocks) over that of the automatic choice, at equal errors
by our code. Siconos' times are those of its driver alone, its own tests of the error included (ours leave them out: ratios below 1.5 mean nothing); it
may take three times as long. `none`: none of its solvers got there; `-`: the automatic choice
did not get there in its time. Problems of a few contacts are not shown: their times are those of calls.

END
  siconos_ratios "$results/solver_profile/times.csv" >"${TMPDIR:-/tmp}/galet_siconos_$$.csv"
  csv_table "${TMPDIR:-/tmp}/galet_siconos_$$.csv"
  rm -f "${TMPDIR:-/tmp}/galet_siconos_$$.csv"
fi
cat <<'END'
![performance profile, errS](../benchmarks/results/solver_profile/profile_errS.svg)
![performance profile, errP](../benchmarks/results/solver_profile/profile_errP.svg)

END
measured_on solver_profile
if [ -f "$results/solver_settings/solver_settings.csv" ]; then
  cat <<'END'
### Settings of momentum, chosen on one half of these problems

`GALET_FCLIB=FOLDER benchmarks/run.sh solver_settings`: problems by name in turn in half 1 and half 2; solved: errS = 1e-6 within half a second;
means of the times, unsolved problems as twice that.

END
  grep -v '^#' "$results/solver_settings/solver_settings.csv" >"${TMPDIR:-/tmp}/galet_settings_$$.csv"
  csv_table "${TMPDIR:-/tmp}/galet_settings_$$.csv"
  rm -f "${TMPDIR:-/tmp}/galet_settings_$$.csv"
  echo '```'
  grep '^#' "$results/solver_settings/solver_settings.csv"
  echo '```'
  echo
  measured_on solver_settings
fi
if [ -f "$results/solver_starts/pile2d.csv" ]; then
  cat <<'END'
### A pile of disks from seven perturbed starts

`GALET_FCLIB=FOLDER benchmarks/run.sh solver_starts`: pile2d (5442 contacts, W stored), 1 second each; how many starts came to the error, median and largest of
their processor times.

END
  csv_table "$results/solver_starts/pile2d.csv"
  measured_on solver_starts
fi
if [ -f "$results/solver_bodies/solver_bodies.csv" ]; then
  cat <<'END'
### Matrices of bodies and of contacts

`[GALET_FCLIB=FOLDER] benchmarks/run.sh solver_bodies`: single steps of sphere packings under gravity. Each method starts from the impulses of momentum at errS =
2e-5 (`ipm` from the middle of the cones) and has three seconds of processor time, or 400 steps (`ipm`: 200); numbers and freedoms are the rows of the matrices
of contacts and of bodies (`-bodies`); an iteration of the Newton methods and of `ipm` has one factorisation. With the term of De Saxcé frozen the matrix
of bodies goes to CHOLMOD, else all go to UMFPACK, or to a dense factorisation (contacts, up to 400 numbers). The machine was shared: times are one run's, to a factor of two.

END
  csv_table "$results/solver_bodies/solver_bodies.csv"
  measured_on solver_bodies
fi
