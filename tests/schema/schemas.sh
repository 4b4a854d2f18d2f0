#!/bin/sh
# What the JSON Schemas accept the readers accept, and the other way round, as ajv judges; and what is printed is what the
# schemas say.
#   sh schemas.sh VIEWPROJ SCHEMA_READER
# 77: node or tests/node_modules is not there; sh samples/setup.sh tests installs them.
set -eu
tests=$(cd "$(dirname "$0")/.." && pwd)
missing() {
  echo "$1"
  exit 77
}
command -v node >/dev/null || missing "node is not installed"
[ -d "$tests/node_modules/ajv" ] || missing "ajv is not in tests/node_modules"

scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
node "$tests/schema/judge.mjs" "$1" "$2" "$tests/cmd/transcripts" "$scratch"
