#!/bin/sh
# What a release takes beyond .ci/run, part by part. A part that has passed on this tree is not run again; its result and
# time stand in a folder outside of the tree, under the tree's hash, where release.sh looks for them.
#   sh tests/checks/deep.sh [PART...]     default: all
#   sh tests/checks/deep.sh --list        what has passed on this tree
# `sh samples/setup.sh deep` gets what they need.
set -eu
cd "$(dirname "$0")/../.."
parts="gate tidy coverage mutants platforms debian long fuzz benchmark"
[ -z "$(git status --porcelain)" ] || { echo 'deep: the tree has changes that are not committed' >&2; exit 2; }
tree=$(git rev-parse 'HEAD^{tree}')
results=${XDG_STATE_HOME:-$HOME/.local/state}/viewproj/deep/$tree
mkdir -p "$results"

gate() { .ci/run; }
tidy() { sh tests/checks/tidy.sh; }
coverage() { sh tests/checks/coverage.sh; }
mutants() { python3 -B tests/checks/mutants.py; }
platforms() { sh tests/checks/platforms.sh; }
# The package in a bare Debian.
debian() { sh tests/checks/install.sh build "$(mktemp -d)/debian"; }
# Long bounds, growth, and processors under qemu.
long() {
  cmake -B build -DVIEWPROJ_TESTS=ON -DVIEWPROJ_DEEP_TESTS=ON -DVIEWPROJ_REQUIRE_ALL=ON >/dev/null
  cmake --build build --parallel "$(nproc)"
  ctest --test-dir build --output-on-failure --no-tests=error -L deep
}
# Thirty minutes, of other inputs each time.
fuzz() {
  FUZZ_SEED=$(date +%s)
  echo "FUZZ_SEED=$FUZZ_SEED"
  FUZZ_SECONDS=1800 FUZZ_SEED=$FUZZ_SEED sh tests/checks/fuzz.sh
}
benchmark() { sh tests/checks/benchmark.sh; }

if [ "${1-}" = --list ]; then
  for part in $parts; do echo "$part: $(cat "$results/$part" 2>/dev/null || echo 'has not passed')"; done
  exit 0
fi
if [ "${1-}" = --run ]; then
  "$2"
  exit
fi
[ $# -gt 0 ] || {
  # shellcheck disable=SC2086  # a list of words
  set -- $parts
}
failed=""
for part; do
  case " $parts " in *" $part "*) ;; *) echo "deep: no part is called $part: $parts" >&2; exit 2 ;; esac
  if [ -f "$results/$part" ]; then
    echo "== $part: $(cat "$results/$part")"
    continue
  fi
  echo "== $part"
  start=$(date +%s)
  if sh tests/checks/deep.sh --run "$part"; then
    echo "passed, $(($(date +%s) - start)) s, $(date -u +%Y-%m-%d)" >"$results/$part"
  else
    failed="$failed $part"
  fi
done
[ -z "$failed" ] || { echo "failed:$failed"; exit 1; }
