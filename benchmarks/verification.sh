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
