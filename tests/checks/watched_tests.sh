#!/bin/sh
# Runs a build's tests, which sanitizers watch.
#   sh tests/checks/watched_tests.sh BUILD [OPTIONS OF CTEST...]
# Random tests get fewer cases here.
set -eu
build=$(cd "$1" && pwd)
shift
export VIEWPROJ_JSON_LINES=5000 VIEWPROJ_STREAM_TRIALS=40 VIEWPROJ_BOUND_POINTS=20000 VIEWPROJ_RANDOM_LENSES=300 VIEWPROJ_SHAPE_CASES=6000
# Reports go to files: a test may hold the standard error, and expect a failure.
rm -rf "$build/reports"
mkdir "$build/reports"
export ASAN_OPTIONS="strict_string_checks=1:hard_rss_limit_mb=4096:log_path=$build/reports/asan"
export UBSAN_OPTIONS="print_stacktrace=1:log_path=$build/reports/ubsan"
export TSAN_OPTIONS="second_deadlock_stack=1:log_path=$build/reports/tsan"
status=0
ctest --test-dir "$build" --output-on-failure --no-tests=error --parallel "$(nproc)" "$@" || status=1
for report in "$build"/reports/*; do
  [ -f "$report" ] || continue
  head -n 80 "$report"
  status=1
done
exit "$status"
