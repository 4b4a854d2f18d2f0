#!/bin/sh
# Sets up, then runs all tests.
set -eu
cd "$(dirname "$0")/.."
sh samples/setup.sh tests
status=0
ctest --test-dir build --output-on-failure --no-tests=error -LE deep --parallel "$(($(nproc) + 1))" || status=1  # some wait, for processes and for time
cat build/left-out
exit "$status"
