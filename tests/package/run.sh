#!/bin/sh
# Installs a build of Galet into a temporary prefix, then configures, builds and runs the project beside this script
# against that prefix and nothing else of the repository.
#
#   run.sh CMAKE BUILD_DIR GENERATOR CXX
set -eu

cmake=$1 build=$2 generator=$3 compiler=$4
source=$(CDPATH='' cd -- "$(dirname -- "$0")" && pwd)
prefix=$(mktemp -d)
trap 'rm -rf "$prefix"' EXIT

# A copy, so that nothing is found through a relative path into the repository.
cp "$source/CMakeLists.txt" "$source/main.cpp" "$prefix"
"$cmake" --install "$build" --prefix "$prefix/installed" >"$prefix/install.log" || {
  cat "$prefix/install.log"
  exit 1
}
"$cmake" -S "$prefix" -B "$prefix/build" -G "$generator" -DCMAKE_BUILD_TYPE=Release \
  -DCMAKE_CXX_COMPILER="$compiler" -DCMAKE_PREFIX_PATH="$prefix/installed"
"$cmake" --build "$prefix/build"
"$prefix/build/outside"
"$prefix/installed/bin/galet" --version
