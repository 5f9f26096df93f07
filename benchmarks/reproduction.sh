#!/bin/sh
# Prints docs/reproduction.md from the results of the studies:  benchmarks/reproduction.sh >docs/reproduction.md
set -eu
root=$(CDPATH='' cd -- "$(dirname "$0")/.." && pwd)
results=$root/benchmarks/results/studies

cat <<'END'
# Published results, reproduced

Made by `benchmarks/reproduction.sh` from the results under `benchmarks/results/studies_full` or, where the published size has not been
run to its end, `benchmarks/results/studies`; `galet study NAME` makes them again (`benchmarks/run.sh studies`). Each study compares with published numbers: *yes*: within the stated uncertainty; *yes (2 errors)*:
only within two standard errors of ours; *NO*: neither. Where the source states no uncertainty, `findings.csv` says what stands for
it. The size that was run stands in each head; a quick size is a first look. Scenes (`scenes/*.toml`) run alone with `galet run`.

END
# place_of STUDY: the folder of its results. One of the published size takes the place of the quick one when it has finished (a
# report there may be of a run that was broken off; machine.txt comes last).
place_of() {
  full=benchmarks/results/studies_full/$1
  if [ -f "$root/$full/machine.txt" ]; then echo "$full"; else echo "benchmarks/results/studies/$1"; fi
}
# cost_row STUDY QUANTITY [awk's settings]: a row of the table of costs, if the study has results of both engines.
cost_row() {
  study=$1; quantity=$2; shift 2
  runs=$root/$(place_of "$study")/runs.csv
  [ -f "$runs" ] || return 0
  cells=$(awk "$@" -f "$root/benchmarks/study_costs.awk" "$runs")
  [ -n "$cells" ] && echo "| $study | $quantity | $cells |"
  return 0
}
cat <<'END'
## What each engine costs at equal error

Processor seconds to a standard error of 1 % of the quantity, geometric means over the states that both engines have, from `runs.csv` of each study
(`src/studies/costs.hpp` has the definitions). md / cd above 1: rigid grains are cheaper.

| study | quantity | states | md, s | cd, s | md / cd | from state to state |
|---|---|---|---|---|---|---|
END
for name in flow-law flow-kappa flow-friction flow-restitution; do cost_row $name 'mu\*' -v observable=mu_star; done
cost_row inclined-plane 'mu\* of its homogeneous shear' -v observable=mu_star -v need=I_set
cost_row annular-shear 'mu\* of its homogeneous shear' -v observable=mu_star -v need=I_set
cost_row annular-shear 'annuli: one sample' -v observable=mu_star -v need=R_i -v samples=1
cost_row cohesive-flow 'mu\*' -v observable=mu_star
cost_row critical-state 'mu\*' -v observable=mu_star
cost_row regimes 'mu\* of flows' -v observable=mu_star -v flows=1
cost_row regimes 'z\* of assemblies, q/P of type II: one sample' -v observable=z_star -v flows=0 -v samples=1
cost_row compression 'z\*: one sample' -v observable=z_star -v samples=1
cost_row triaxial 'q/P: one sample' -v observable=Phi -v samples=1
cost_row consolidation '1/Phi: one sample' -v observable=Phi -v samples=1
cat <<'END'

- *one sample*: what is uncertain there is the packing, not an average over its time. Packings of both engines scatter alike, so equal error needs equally many of
  them, and the seconds of one sample say what the engines cost.
- Errors are statistical. What the settings add (stiffness in md, time step and tolerance in cd) is not in them: `benchmarks/run.sh work_precision`
  ([validation](validation.md)) measures error against cost with both, and `galet compare --error X` chooses engine and settings for a scene.
- Rigid grains stand beside the stiffest contacts of md in `flow-kappa` and `triaxial`, elastic ones of cd beside equal stiffness. md takes steps as
  1 / sqrt(kappa): at kappa = 1e5 (`cohesive-flow`) it costs ten times what it does at 1e3 (`inclined-plane`, `annular-shear`), and that is what decides, with the
  inertial number: rigid grains are the better choice in fast flows and stiff ones, soft ones at kappa of a few thousand near rest, where cd's contacts want many
  sweeps.
- Walls and rings of glued grains are bodies with many contacts, which sweeps pass on slowly: between walls (`flow-law`) a step of cd takes about three
  times the seconds per grain that it takes in the cell, a step of md 1.0 to 1.7 times.
- Not to be had from these rows: local laws of slopes and annuli, whose errors are not kept row by row.

END
if [ -f "$results/compression/report.txt" ]; then
  cat <<'END'
In `compression` md goes on from the assembled state to lower kappa, cd does not: its row is an upper bound of md / cd.

END
fi
if ! ls "$results"/*/report.txt >/dev/null 2>&1; then echo "No results are here yet."; fi
# In the order of the chapter.
for name in flow-law flow-kappa flow-friction flow-restitution inclined-plane annular-shear cohesive-flow compression triaxial critical-state consolidation regimes; do
  place=$(place_of "$name")
  folder=$root/$place
  [ -f "$folder/report.txt" ] || continue
  title=$(sed -n '1s/^[^:]*: //p' "$folder/report.txt")
  printf '## %s\n\n`galet study %s`\n\n' "$title" "$name"
  for figure in "$folder"/*.svg; do
    [ -f "$figure" ] || continue
    stem=$(basename "$figure" .svg)
    printf '![%s](../%s/%s.svg)\n' "$stem" "$place" "$stem"
  done
  printf '\n```\n'
  cat "$folder/report.txt"
  printf '```\n\n'
  if [ -f "$folder/finding.md" ]; then cat "$folder/finding.md"; echo; fi
  if [ -f "$folder/machine.txt" ]; then
    printf 'Measured on:\n\n```\n'
    cat "$folder/machine.txt"
    printf '```\n\n'
  fi
done
