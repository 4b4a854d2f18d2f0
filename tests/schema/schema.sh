#!/bin/sh
# The JSON Schema of a camera file, as ajv judges.
#   sh schema.sh VIEWPROJ SOURCE_FOLDER
# 77: node or tests/node_modules is not there; sh samples/setup.sh tests installs them.
set -eu
tests=$2/tests
missing() {
  echo "$1"
  exit 77
}
command -v node >/dev/null || missing "node is not installed"
[ -d "$tests/node_modules/ajv" ] || missing "ajv is not in tests/node_modules"
node "$tests/schema/schema.mjs" "$1" "$2"
