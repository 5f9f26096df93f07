#!/bin/sh
# The rules of the tree that no compiler checks.
#
#   check.sh [--root DIR] [RULE...]     default: the repository that holds this script, every rule
#
# engines   md and cd never include each other nor src; common includes none of md, cd, src; no "../" includes
# openmp    only common/core/parallel.cpp knows OpenMP
# length    no .hpp or .cpp file is longer than 500 lines
# paths     no file names a folder of somebody's machine
# once      every .hpp says #pragma once
#
# Prints each offence as file:line and exits with 1 if there is any.
set -u

root=$(CDPATH='' cd -- "$(dirname -- "$0")/../.." && pwd) || exit 2
if [ "${1:-}" = --root ]; then
  root=$2
  shift 2
fi
cd "$root" || exit 2
[ $# -gt 0 ] || set -- engines openmp length paths once

# Files that are, or are about to be, part of the repository; without git, everything but built files.
files() {
  if [ -e .git ] && git rev-parse --git-dir >/dev/null 2>&1; then
    git ls-files --cached --others --exclude-standard
  else
    find . \( -path ./build -o -path ./out -o -path ./.git \) -prune -o -type f -print | sed 's|^\./||'
  fi | while IFS= read -r file; do
    if [ -f "$file" ]; then printf '%s\n' "$file"; fi
  done
}

# offences PATTERN WHAT: reads file names, prints the lines that match and what is wrong with them.
offences() {
  while IFS= read -r file; do
    grep -nIE -e "$1" -- "$file" /dev/null | sed "s|\$|    <- $2|"
  done
}

include='^[[:space:]]*#[[:space:]]*include[[:space:]]*[<"]'

check_engines() {
  files | grep -E '^common/.*\.[ch]pp$' | offences "$include(galet/)?(md|cd|src)/" "common may not use md, cd or src"
  files | grep -E '^md/.*\.[ch]pp$' | offences "$include(galet/)?(cd|src)/" "md may use only common"
  files | grep -E '^cd/.*\.[ch]pp$' | offences "$include(galet/)?(md|src)/" "cd may use only common"
  files | grep -E '\.[ch]pp$' | offences "$include[^>\"]*\\.\\./" "include from the root of the repository"
}

check_openmp() {
  files | grep -E '\.[ch]pp$' | grep -vx common/core/parallel.cpp |
    offences "${include}omp\\.h|^[[:space:]]*#[[:space:]]*pragma[[:space:]]+omp" "only common/core/parallel.cpp knows OpenMP"
}

check_length() {
  files | grep -E '\.[ch]pp$' | while IFS= read -r file; do
    awk -v file="$file" 'END { if (NR > 500) print file ":" NR "    <- longer than 500 lines" }' "$file"
  done
}

check_paths() {
  files | offences '(^|[^[:alnum:]_.~$}-])/(work|root|home)/' "a path of one machine"
}

check_once() {
  files | grep -E '\.hpp$' | while IFS= read -r file; do
    grep -q '^#pragma once' -- "$file" || printf '%s\n' "$file:1    <- no #pragma once"
  done
}

status=0
for rule in "$@"; do
  case $rule in
    engines | openmp | length | paths | once) ;;
    *) echo "check.sh: unknown rule '$rule'" >&2; exit 2 ;;
  esac
  found=$("check_$rule")
  if [ -n "$found" ]; then
    printf '%s\n' "$found"
    status=1
  fi
done
exit $status
