#!/bin/sh
# What the JSON Schemas accept the readers accept, and the other way round, as ajv judges; and what is printed is what the
# schemas say.
#   sh schemas.sh VIEWPROJ SCHEMA_READER FOLDER
# FOLDER keeps ajv between runs. 77: node, npm or the network is not there.
set -eu
tests=$(cd "$(dirname "$0")/.." && pwd)
missing() {
  echo "skipped: $1"
  exit 77
}
for needed in node npm; do
  command -v "$needed" >/dev/null 2>&1 || missing "$needed is not installed"
done
mkdir -p "$3"
if [ ! -d "$3/node_modules/ajv" ]; then
  (cd "$3" && npm install --silent --no-save --no-package-lock ajv@8.17.1 >/dev/null 2>&1) ||
    missing "ajv cannot be fetched from npm"
fi

scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
mkdir "$scratch/bin" "$scratch/recorded"
cp "$tests/schema/record.sh" "$scratch/bin/viewproj"
chmod +x "$scratch/bin/viewproj"

# Every run of the golden cases and of the samples, with what goes in and out.
for directory in "$tests"/cmd/cases/*/ "$tests"/../samples/*/; do
  (
    cd "$directory"
    [ -f cmd ] || exit 0
    PATH=$scratch/bin:$PATH VIEWPROJ_TOOL=$1 VIEWPROJ_RECORDED=$scratch/recorded LC_ALL=C \
      timeout -s KILL 30 sh ./cmd </dev/null >/dev/null 2>&1
  ) || true
done

node "$tests/schema/judge.mjs" "$1" "$2" "$3" "$scratch"
