#!/usr/bin/env bash
# Speed of LAMMPS and of the md engine in turn, and of two threads:  benchmarks/peers/lammps_speed.sh [OUT_FOLDER]
#
# Writes cases.csv and threads.csv to OUT_FOLDER (default: prints them). Skipped, with a message, where LAMMPS (Debian:
# apt-get install lammps) is not there. About eight minutes on a quiet machine.
set -euo pipefail
root=$(CDPATH='' cd -- "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
cd "$root"
if ! command -v lmp >/dev/null; then
  echo "skipped: there is no program lmp (Debian: apt-get install lammps)"
  exit 0
fi
cmake --preset release -DGALET_BUILD_BENCHMARKS=ON >/dev/null
cmake --build --preset release --target lammps_speed
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
program=build/release/benchmarks/lammps_speed
"$program" "$folder" packings
if [ $# -gt 0 ]; then
  mkdir -p "$1"
  "$program" "$folder" cases | tee "$1/cases.csv"
  "$program" "$folder" threads | tee "$1/threads.csv"
else
  "$program" "$folder" cases
  "$program" "$folder" threads
fi
