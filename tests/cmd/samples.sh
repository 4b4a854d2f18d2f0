#!/bin/sh
# Every sample prints the expout that stands beside its cmd, and the experr, where there is one, as errors; its status is 0.
#   sh samples.sh VIEWPROJ SAMPLES [NAME]
# REGENERATE=1 in the environment writes what they print instead, for git diff to show.
set -eu
# shellcheck source=tests/cmd/limits.sh
. "$(dirname "$0")/limits.sh"
limit_memory "$1"
PATH=$(cd "$(dirname "$1")" && pwd):$PATH
LC_ALL=C
export PATH LC_ALL
unset COLUMNS
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

passed=0
failed=0
for cmd in "$2"/${3:-*}/cmd; do
  folder=${cmd%/cmd}
  status=0
  (cd "$folder" && limited sh ./cmd) >"$work/expout" 2>"$work/experr" </dev/null || status=$?
  if [ "${REGENERATE-}" = 1 ]; then
    cp "$work/expout" "$folder/expout"
    rm -f "$folder/experr"
    if [ -s "$work/experr" ]; then cp "$work/experr" "$folder/experr"; fi
  fi
  cat "$folder/expout" >"$work/out"
  if [ -f "$folder/experr" ]; then cat "$folder/experr" >"$work/err"; else : >"$work/err"; fi
  if diff -u "$work/out" "$work/expout" && diff -u "$work/err" "$work/experr" && [ "$status" = 0 ]; then
    passed=$((passed + 1))
  else
    failed=$((failed + 1))
    echo "--- $folder: that, and status $status"
  fi
done
echo "$passed passed, $failed failed"
[ "$failed" = 0 ]
