#!/bin/sh
# The judged tests once more, against judges run here and now. 77: a judge is not there.
#   sh judged.sh IMPORTERS_TESTS three|opencv
set -eu
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
LENSES=1000 sh "$(dirname "$0")/judge.sh" "$scratch" "$2"
if [ "$2" = three ]; then named='three.js*' cases='1 test case'; else named='Calibrations*' cases='2 test cases'; fi
VIEWPROJ_FIXTURES=$scratch "$1" "$named" >"$scratch/said" || { cat "$scratch/said"; exit 1; }
# Catch2 2 passes where no test has that name.
grep -q "passed ([0-9]* assertions in $cases)" "$scratch/said" || { cat "$scratch/said"; exit 1; }
