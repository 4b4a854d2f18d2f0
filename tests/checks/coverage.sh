#!/bin/sh
# Tells how many lines of lib and cmd the tests reach, and which not: a report, no gate.
#   sh tests/checks/coverage.sh [BUILD FOLDER]     build-coverage
set -eu
cd "$(dirname "$0")/../.."
build=${1:-build-coverage}
cmake -S . -B "$build" -DCMAKE_CXX_COMPILER=clang++ -DCMAKE_BUILD_TYPE=Debug -DCMAKE_CXX_FLAGS_DEBUG='-O1 -gline-tables-only' \
  -DVIEWPROJ_TESTS=ON -DVIEWPROJ_COVERAGE=ON >/dev/null
cmake --build "$build" --parallel "$(nproc)"
rm -rf "$build/profiles"
ctest --test-dir "$build" --output-on-failure --no-tests=error --parallel "$(nproc)" -E '^(kernels_share_no_code|faults_Limits|faults_Calls)$'

# Debian's LLVM has a number.
llvm() {
  tool=$1
  shift
  command -v "$tool" >/dev/null || tool=$tool-14
  "$tool" "$@"
}
llvm llvm-profdata merge -sparse -o "$build/profile" "$build"/profiles/*.profraw
set -- "$build/viewproj"
for program in "$build"/*_tests; do set -- "$@" -object "$program"; done
llvm llvm-cov export -summary-only -instr-profile "$build/profile" "$@" >"$build/coverage.json"
python3 - "$build/coverage.json" <<'SUMS'
import json, os, sys
files = json.load(open(sys.argv[1]))["data"][0]["files"]
for part in ("lib", "cmd"):
    rows = [f["summary"]["lines"] for f in files if os.path.normpath(f["filename"]).startswith(os.path.join(os.getcwd(), part, ""))]
    total, covered = (sum(row[key] for row in rows) for key in ("count", "covered"))
    if total == 0:
        sys.exit(f"{part}: no lines in the profile")
    print(f"{part}: {100 * covered / total:.2f} % of {total} lines reached")
SUMS
llvm llvm-cov show -instr-profile "$build/profile" "$@" lib cmd 2>/dev/null | grep -E '^/|\| +0\|' >"$build/coverage.lines" || true
echo "the lines that no test reaches: $build/coverage.lines"
