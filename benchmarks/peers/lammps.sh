#!/usr/bin/env bash
# The same packing and law in LAMMPS and in the md engine:  benchmarks/peers/lammps.sh [OUT.csv]
#
# Skipped, with a message, where LAMMPS (Debian: apt-get install lammps) is not there. About five minutes on one core.
set -euo pipefail
root=$(CDPATH='' cd -- "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
cd "$root"
if ! command -v lmp >/dev/null; then
  echo "skipped: there is no program lmp (Debian: apt-get install lammps)"
  exit 0
fi
cmake --preset release -DGALET_BUILD_BENCHMARKS=ON >/dev/null
cmake --build --preset release --target lammps_peer
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
if [ $# -gt 0 ]; then
  build/release/benchmarks/lammps_peer "$folder" | tee "$1"
else
  build/release/benchmarks/lammps_peer "$folder"
fi
