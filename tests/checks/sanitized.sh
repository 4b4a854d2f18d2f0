#!/bin/sh
# All tests under AddressSanitizer, LeakSanitizer and UndefinedBehaviorSanitizer, built with clang; counts lines for
# coverage.sh on the way.
#   sh tests/checks/sanitized.sh [BUILD FOLDER]     build-sanitized
# Random tests get fewer cases here; LONG=1 in the environment: as many as everywhere.
set -eu
cd "$(dirname "$0")/../.."
build=${1:-build-sanitized}

# Beyond undefined behaviour: numbers that do not fit where they go.
watched=address,undefined,float-cast-overflow,implicit-conversion,local-bounds
cmake -S . -B "$build" -DCMAKE_CXX_COMPILER=clang++ -DCMAKE_BUILD_TYPE=Debug \
  -DCMAKE_CXX_FLAGS="-fsanitize-ignorelist=$PWD/tests/checks/sanitizers-skip.txt" \
  -DCMAKE_CXX_FLAGS_DEBUG='-O1 -gline-tables-only -D_GLIBCXX_ASSERTIONS' \
  -DVIEWPROJ_TESTS=ON -DVIEWPROJ_WERROR=ON -DVIEWPROJ_SANITIZE=$watched -DVIEWPROJ_COVERAGE=ON -DVIEWPROJ_FUZZ=ON >/dev/null
cmake --build "$build" --parallel "$(nproc)"

# An object file has more symbols than its own with them, and memory is theirs: no call fails for want of it, no limit
# holds it. The rest is mostly other programs' work.
others='kernels_share_no_code|faults_call|faults_limit|parallel_recipes|pasted|schemas|importers_judged_by_[a-z]*'
echo "left out: $others" | tr '|' ' '
if [ "${LONG-}" != 1 ]; then
  export VIEWPROJ_BOUND_POINTS=500000 VIEWPROJ_JSON_LINES=20000
fi
# Reports go to files: a test may hold the standard error, and expect a failure.
build=$(cd "$build" && pwd)
rm -rf "$build/profiles" "$build/reports"
mkdir "$build/reports"
ASAN_OPTIONS=strict_string_checks=1:log_path=$build/reports/asan
UBSAN_OPTIONS=print_stacktrace=1:log_path=$build/reports/ubsan
export ASAN_OPTIONS UBSAN_OPTIONS
status=0
ctest --test-dir "$build" --output-on-failure --parallel "$(nproc)" -E "^($others)\$" || status=1
for report in "$build"/reports/*; do
  [ -f "$report" ] || continue
  head -n 40 "$report"
  status=1
done
exit $status
