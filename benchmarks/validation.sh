#!/bin/sh
# Prints docs/validation.md from the results under benchmarks/results:  benchmarks/validation.sh >docs/validation.md
set -eu
root=$(CDPATH='' cd -- "$(dirname "$0")/.." && pwd)
results=$root/benchmarks/results

# block FILE...: the files' contents as a block of code.
block() { echo '```'; cat "$@"; echo '```'; echo; }
measured_on() { echo "Measured on:"; echo; block "$results/$1/machine.txt"; }
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
echo "## Layouts"
printf '\nThe same sample and the same motion (mu = 0) in the frictionless layout and in the frictional one, and with friction.\n'
printf '`grain_steps`: grains times steps per second of processor time.\n\n'
awk -F, '/^name,/ || /^"/ { gsub(/"/, ""); print $1 "," $4 "," $5 "," $(NF-1) "," $NF }' "$results/layouts/layouts.csv" >"${TMPDIR:-/tmp}/layouts.$$"
csv_table "${TMPDIR:-/tmp}/layouts.$$"
rm -f "${TMPDIR:-/tmp}/layouts.$$"
measured_on layouts
echo "## Contact solver"
printf '\nSweeps from a cold start on a dense packing under pressure, plain and with momentum.\n\n'
csv_table "$results/solver_sweeps/solver_sweeps.csv"
measured_on solver_sweeps
