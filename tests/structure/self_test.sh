#!/bin/sh
# The rules of check.sh can fail: each finds the one offence of a small tree made for it, and nothing in a sound tree.
set -u

check=$(CDPATH='' cd -- "$(dirname -- "$0")" && pwd)/check.sh
tree=$(mktemp -d) || exit 2
trap 'rm -rf "$tree"' EXIT
status=0

sound_tree() {
  rm -rf "$tree/t"
  mkdir -p "$tree/t/common/core" "$tree/t/md" "$tree/t/cd" "$tree/t/src"
  printf '#include "common/core/parallel.hpp"\n#include <omp.h>\n#pragma omp parallel\n' >"$tree/t/common/core/parallel.cpp"
  printf '#pragma once\n' >"$tree/t/common/core/parallel.hpp"
  printf '#include "md/engine.hpp"\n' >"$tree/t/md/engine.cpp"
  printf '#pragma once\n#include "common/core/parallel.hpp"\n' >"$tree/t/md/engine.hpp"
  printf '#pragma once\n#include "common/core/parallel.hpp"\n' >"$tree/t/cd/engine.hpp"
  printf '#include "md/engine.hpp"\n#include "cd/engine.hpp"\n' >"$tree/t/src/simulation.cpp"
  printf 'see docs/%s/notes and https://example.org/%s/\n' work home >"$tree/t/README.md"
}

# expect RULE FILE LINE: a sound tree with LINE appended to FILE breaks RULE there, and no other rule.
expect() {
  sound_tree
  printf '%s\n' "$3" >>"$tree/t/$2"
  if sh "$check" --root "$tree/t" "$1" >"$tree/found"; then
    echo "rule $1 did not see '$3' in $2"
    status=1
  elif ! grep -q "^$2:" "$tree/found"; then
    echo "rule $1 did not name $2:"
    cat "$tree/found"
    status=1
  fi
  for other in engines openmp length paths once; do
    [ "$other" = "$1" ] || sh "$check" --root "$tree/t" "$other" || { echo "rule $other saw '$3' in $2"; status=1; }
  done
}

sound_tree
sh "$check" --root "$tree/t" || { echo "the sound tree is not sound"; status=1; }
expect engines md/engine.cpp '#include "cd/engine.hpp"'
expect engines cd/engine.hpp '#include "md/engine.hpp"'
expect engines cd/engine.hpp '  #  include <galet/src/simulation.hpp>'
expect engines common/core/parallel.hpp '#include "md/engine.hpp"'
expect engines common/core/parallel.hpp '#include "src/simulation.hpp"'
expect engines src/simulation.cpp '#include "../md/engine.hpp"'
expect openmp md/engine.cpp '#include <omp.h>'
expect openmp src/simulation.cpp '  #pragma omp simd'
expect length md/engine.cpp "$(awk 'BEGIN { for (i = 0; i < 500; ++i) print "//" }')"
expect paths README.md "$(printf 'kept in /%s/main' work)"
expect paths md/engine.cpp "$(printf '// /%s/someone/data.csv' home)"
expect once cd/problem.hpp '// no guard'
exit $status
