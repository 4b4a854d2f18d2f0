#!/bin/sh
# All tests under AddressSanitizer, LeakSanitizer and UndefinedBehaviorSanitizer, built with clang; counts lines for
# coverage.sh on the way, and builds what fuzz.sh runs.
#   sh tests/checks/sanitized.sh [BUILD FOLDER]     build-sanitized
# LONG=1 in the environment: as watched_tests.sh has it.
set -eu
cd "$(dirname "$0")/../.."
build=${1:-build-sanitized}

# Beyond undefined behaviour: numbers that do not fit where they go.
watched=address,undefined,float-cast-overflow,implicit-conversion,local-bounds
cmake -S . -B "$build" -DCMAKE_CXX_COMPILER=clang++ -DCMAKE_BUILD_TYPE=Debug \
  -DCMAKE_CXX_FLAGS="-fsanitize-ignorelist=$PWD/tests/checks/sanitizers-skip.txt" \
  -DCMAKE_CXX_FLAGS_DEBUG='-O1 -gline-tables-only -D_GLIBCXX_ASSERTIONS' -DVIEWPROJ_TESTS=ON \
  -DVIEWPROJ_WERROR=ON -DVIEWPROJ_SANITIZE=$watched -DVIEWPROJ_COVERAGE=ON -DVIEWPROJ_FUZZ=ON >/dev/null
cmake --build "$build" --parallel "$(nproc)"

# An object file has more symbols than its own with them, and memory is theirs: no call fails for want of it, no limit
# holds it. explain's two thousand runs of the tool are those of the golden cases. The rest is mostly other programs' work.
others='kernels_share_no_code|faults_call|faults_limit|growth|parallel_recipes|pasted_[a-z]*|schemas|importers_judged_by_[a-z]*|explain|opengl|vulkan'
echo "left out: $others" | tr '|' ' '
rm -rf "$build/profiles"
exec sh tests/checks/watched_tests.sh "$build" -E "^($others)\$"
