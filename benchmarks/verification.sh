#!/bin/sh
# Prints docs/verification.md from benchmarks/results/verify:  benchmarks/verification.sh >docs/verification.md
set -eu
root=$(CDPATH='' cd -- "$(dirname "$0")/.." && pwd)
results=$root/benchmarks/results/verify
cat <<'END_OF_HEAD'
# Verification

Made by `benchmarks/verification.sh` from the results of `benchmarks/run.sh verify` (`galet verify --all`). Every case has an answer that is
known, exactly or from an independent computation. A bound follows from the scheme's order, the solver's tolerance or the scatter of a mean; an error is absolute, or
relative where value and exact value are no zeros and the bound says so. Costs are processor seconds of one thread.

END_OF_HEAD
cat "$results/verify.md"
echo
echo "Measured on:"
echo
echo '```'
cat "$results/machine.txt"
echo '```'
peers=$root/benchmarks/results/siconos_hard_cases
[ -f "$peers/summary.csv" ] || exit 0
cat <<'END_OF_PEERS'

## Hard cases and another solver

`benchmarks/run.sh siconos_hard_cases`: the contact problem of the first step of hard cases (spheres; the three cylinders: disks), exported to FCLIB and given to
Siconos (Debian's python3-siconos 4.4; all options but tolerance and the limit of iterations at their defaults) and to `galet solve`'s solvers, from r = 0 and with 10 s of
processor time for a solve. What should be zero is the motion, `motion` = largest |u|/(g Δt) of a contact; `force` is the largest error of a normal force over the
weight on the floor, where statics says it. `seconds`: the first answer, of those asked for by tens from 10⁻³ on, that has both below 10⁻³; `asked` is what its solver was
asked for, in its own measure; `least_`: the best of all answers.

END_OF_PEERS
awk -F, '{ gsub(/"/, ""); printf "|"; for (k = 1; k <= NF; ++k) printf " %s |", $k; print "";
           if (NR == 1) { printf "|"; for (k = 1; k <= NF; ++k) printf "---|"; print "" } }' "$peers/summary.csv"
[ ! -f "$peers/reading.md" ] || { echo; cat "$peers/reading.md"; }
echo
echo "Measured on:"
echo
echo '```'
cat "$peers/machine.txt"
echo '```'
