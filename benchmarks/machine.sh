#!/bin/sh
# What the results beside it were measured on: machine, compiler, commit, date. Prints to standard output.
set -eu
root=$(CDPATH='' cd -- "$(dirname "$0")/.." && pwd)
echo "machine:  $(sed -n 's/^model name[^:]*: //p' /proc/cpuinfo | head -n 1), $(nproc) processors, $(awk '/MemTotal/ {printf "%.0f GiB", $2 / 1048576}' /proc/meminfo)"
echo "system:   $(. /etc/os-release && echo "$PRETTY_NAME")"
echo "compiler: $(c++ --version | head -n 1)"
echo "flags:    preset release (-O3 -ffp-contract=off, no -march)"
echo "commit:   $(git -C "$root" rev-parse HEAD 2>/dev/null || echo unknown)$(git -C "$root" diff --quiet HEAD -- '*.cpp' '*.hpp' '*.toml' 2>/dev/null || echo ' with changes')"
echo "date:     $(date -u +%Y-%m-%d)"
