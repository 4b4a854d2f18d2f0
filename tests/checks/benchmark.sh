#!/bin/sh
# The benchmarks are built, and run once in a small size: they must give the right answers. What they take is not judged.
#   sh tests/checks/benchmark.sh [BUILD FOLDER]     build
set -eu
cd "$(dirname "$0")/../.."
build=${1:-build}

cmake -S . -B "$build" -DVIEWPROJ_BENCHMARK=ON >/dev/null
cmake --build "$build" --parallel "$(nproc)" --target viewproj projection_benchmark
"$build/projection_benchmark" 0 4096
"$build/projection_benchmark" 1 4096 >/dev/null
ROUNDS=0 python3 tests/benchmark/streams.py "$build/viewproj" 10000
