#!/bin/sh
# The pipeline under ThreadSanitizer, built with clang: the tests of streams, the golden cases, the samples.
#   sh tests/checks/threads.sh [BUILD FOLDER]     build-threads
# Random tests get fewer cases here; LONG=1 in the environment: as many as everywhere.
set -eu
cd "$(dirname "$0")/../.."
build=${1:-build-threads}

cmake -S . -B "$build" -DCMAKE_CXX_COMPILER=clang++ -DCMAKE_BUILD_TYPE=Debug \
  -DCMAKE_CXX_FLAGS_DEBUG='-O1 -gline-tables-only' \
  -DVIEWPROJ_TESTS=ON -DVIEWPROJ_WERROR=ON -DVIEWPROJ_SANITIZE=thread >/dev/null
cmake --build "$build" --parallel "$(nproc)" --target viewproj stream_tests

if [ "${LONG-}" != 1 ]; then
  VIEWPROJ_JSON_LINES=20000
  export VIEWPROJ_JSON_LINES
fi
# Reports go to files: a test may hold the standard error, and expect a failure.
build=$(cd "$build" && pwd)
rm -rf "$build/reports"
mkdir "$build/reports"
TSAN_OPTIONS=second_deadlock_stack=1:log_path=$build/reports/tsan
export TSAN_OPTIONS
status=0
ctest --test-dir "$build" --output-on-failure --parallel "$(nproc)" -R '^(stream|cmd|samples)$' || status=1
for report in "$build"/reports/*; do
  [ -f "$report" ] || continue
  head -n 80 "$report"
  status=1
done
exit $status
