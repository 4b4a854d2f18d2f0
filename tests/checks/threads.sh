#!/bin/sh
# The pipeline under ThreadSanitizer, built with clang: the tests of streams, and the samples.
#   sh tests/checks/threads.sh [BUILD FOLDER]     build-threads
set -eu
cd "$(dirname "$0")/../.."
build=${1:-build-threads}

cmake -S . -B "$build" -DCMAKE_CXX_COMPILER=clang++ -DCMAKE_BUILD_TYPE=Debug \
  -DCMAKE_CXX_FLAGS_DEBUG='-O1 -gline-tables-only' \
  -DVIEWPROJ_TESTS=ON -DVIEWPROJ_WERROR=ON -DVIEWPROJ_SANITIZE=thread >/dev/null
cmake --build "$build" --parallel "$(nproc)" --target viewproj tool_tests
exec sh tests/checks/watched_tests.sh "$build" -R '^(stream|samples)$'
