#!/bin/sh
# All tests but the outside judges under AddressSanitizer, LeakSanitizer and UndefinedBehaviorSanitizer, built with clang;
# builds what fuzz.sh runs.
#   sh tests/checks/sanitized.sh [BUILD FOLDER]     build-sanitized
set -eu
cd "$(dirname "$0")/../.."
build=${1:-build-sanitized}

# Beyond undefined behaviour: numbers that do not fit where they go.
watched=address,undefined,float-cast-overflow,implicit-conversion,local-bounds
cmake -S . -B "$build" -DCMAKE_CXX_COMPILER=clang++ -DCMAKE_BUILD_TYPE=Debug \
  -DCMAKE_CXX_FLAGS="-fsanitize-ignorelist=$PWD/tests/checks/sanitizers-skip.txt" \
  -DCMAKE_CXX_FLAGS_DEBUG='-O1 -gline-tables-only -D_GLIBCXX_ASSERTIONS' -DVIEWPROJ_TESTS=ON \
  -DVIEWPROJ_WERROR=ON -DVIEWPROJ_SANITIZE=$watched -DVIEWPROJ_FUZZ=ON -DVIEWPROJ_CATCH_OPTIONS="~[rates]" >/dev/null
cmake --build "$build" --parallel "$(nproc)"

# An object file has more symbols than its own with them, and memory is theirs: no call fails for want of it, no limit
# holds it. explain's, check's, mistakes' and obeyed's runs are those of the golden cases. The rest is mostly other programs' work.
# [rates] measures how often an answer is right, by code that the tests beside it run.
others='kernels_share_no_code|obeyed|parallel|importers_opencv|importers_three|converted_[a-z0-9]*|footprint|triangulate|faults_Calls|faults_Limits|pasted_[a-z]*|schema|explain|check|mistakes|opengl'
echo "left out: $others" | tr '|' ' '
exec sh tests/checks/watched_tests.sh "$build" -E "^($others)\$"
