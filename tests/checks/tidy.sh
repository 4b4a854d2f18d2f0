#!/bin/sh
# clang-tidy over lib and cmd, whose headers the tests include; the tests themselves would cost as much again.
#   sh tests/checks/tidy.sh [BUILD FOLDER]     build-tidy, for the compile commands alone
set -eu
cd "$(dirname "$0")/../.."
# shellcheck source=tests/checks/sources.sh
. tests/checks/sources.sh
build=${1:-build-tidy}
cmake -S . -B "$build" -DCMAKE_CXX_COMPILER=clang++ -DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON -DCMAKE_UNITY_BUILD=OFF >/dev/null
# The large ones first. The kernels of later processors are those of this one.
sources 'lib/*.cpp' 'cmd/*.cpp' | grep -v -e kernel_v -e point_v -e system_windows | xargs wc -c | grep -v ' total$' | sort -rn |
  awk '{ print $2 }' | xargs -P "$(nproc)" -n 4 clang-tidy --quiet -p "$build" 2>"$build/counts" || {
  sed '/warnings\{0,1\} \(generated\|treated\)/d' "$build/counts"
  exit 1
}
