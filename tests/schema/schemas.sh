#!/bin/sh
# What the JSON Schemas accept the readers accept, and the other way round, as ajv judges; and what is printed is what the
# schemas say.
#   sh schemas.sh VIEWPROJ SCHEMA_READER RECORDER
# 77: node or tests/node_modules is not there; sh samples/setup.sh tests installs them.
set -eu
viewproj=$(cd "$(dirname "$1")" && pwd)/$(basename "$1")
tests=$(cd "$(dirname "$0")/.." && pwd)
missing() {
  echo "$1"
  exit 77
}
command -v node >/dev/null || missing "node is not installed"
[ -d "$tests/node_modules/ajv" ] || missing "ajv is not in tests/node_modules"

scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
mkdir "$scratch/bin" "$scratch/recorded"
cp "$3" "$scratch/bin/viewproj"

# Every run of the golden cases and of the samples, with what goes in and out, but for those that make more than the judge
# reads.
# What the cases' own tests say of them is not asked again.
export PATH="$scratch/bin:$PATH" VIEWPROJ_TOOL="$viewproj" VIEWPROJ_RECORDED="$scratch/recorded" LC_ALL=C
python3 -B "$tests/cmd/transcripts.py" "$viewproj" --folders "$scratch/cases"
# shellcheck disable=SC2016  # for a shell of its own
find "$scratch/cases" "$tests/../samples" -mindepth 2 -name cmd -exec grep -LE 'yes |/dev/zero|-c [0-9]{6}|\* [0-9]{6}' {} + |
  sed 's/cmd$//' | xargs -r -P "$(nproc)" -n 1 sh -c '
  status=0
  (cd "$0" && exec timeout -s KILL 30 sh ./cmd) </dev/null >/dev/null 2>&1 || status=$?
  [ "$status" -lt 124 ] || { echo "$0: status $status"; exit 1; }'

node "$tests/schema/judge.mjs" "$viewproj" "$2" "$scratch"
