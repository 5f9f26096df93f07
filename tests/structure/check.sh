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

# on_files COMMAND...: runs it with the file names that are read, many at once, if there are any.
on_files() {
  tr '\n' '\0' | xargs -0 -r "$@"
}

# offences PATTERN WHAT: reads file names, prints the lines that match and what is wrong with them.
offences() {
  on_files grep -nIE -e "$1" -- /dev/null | sed "s|\$|    <- $2|"
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
  files | grep -E '\.[ch]pp$' | on_files awk 'FNR == 501 { print FILENAME ":501    <- longer than 500 lines" }'
}

check_paths() {
  files | offences '(^|[^[:alnum:]_.~$}-])/(work|root|home)/' "a path of one machine"
}

check_once() {
  files | grep -E '\.hpp$' | on_files grep -L '^#pragma once' -- | sed 's|$|:1    <- no #pragma once|'
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
