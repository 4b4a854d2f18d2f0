#!/bin/sh
# The judged tests once more, against judges run here and now. 77: a judge is not there.
#   sh judged.sh IMPORTERS_TESTS three|opencv
set -eu
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
LENSES=1000 sh "$(dirname "$0")/judge.sh" "$scratch" "$2"
if [ "$2" = three ]; then named='three.js and glTF*'; else named='Calibrations*'; fi
VIEWPROJ_FIXTURES=$scratch "$1" "$named" # no test of that name: an error of Catch2's
