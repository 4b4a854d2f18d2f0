#!/bin/sh
# What GNU parallel costs on one machine, against viewproj's own threads: medians of one run, in turns.
#
#   sh tests/benchmark/parallel.sh [VIEWPROJ] [POINTS]
#
# VIEWPROJ is the executable (build/viewproj), POINTS how many (10000000, 500 MB of NDJSON). All must print the same bytes,
# which is looked at first. ROUNDS=3 in the environment sets how many turns (5; 0: once, and no times). 77: no GNU parallel.
set -eu
here=$(cd "$(dirname "$0")" && pwd)/streams
# shellcheck source=tests/benchmark/streams/race.sh
. "$here/race.sh"
points=${2:-10000000}
prepare "${1:-build/viewproj}" points timed
command -v parallel >/dev/null || {
  echo 'parallel is not here: nothing to measure'
  exit 77
}
for form in ndjson csv f64; do ./points $form "$points" >p.$form; done

project="$viewproj project -c $here/camera.json --fields screen,depth"
add "ndjson|viewproj, all threads|$points|$project p.ndjson"
add "ndjson|viewproj --jobs 1|$points|$project --jobs 1 p.ndjson"
for block in 1M 10M 50M; do
  add "ndjson|--pipe --block $block|$points|parallel --pipe -k --block $block $project --jobs 1 <p.ndjson"
  add "ndjson|--pipepart --block $block|$points|parallel --pipepart -a p.ndjson -k --block $block $project --jobs 1"
done
add "ndjson|--pipe --block 50M -j1, all threads|$points|parallel --pipe -k --block 50M -j1 $project <p.ndjson"
add "ndjson|--pipe -N 100000 --block 10M|$points|parallel --pipe -k -N 100000 --block 10M $project --jobs 1 <p.ndjson"
csv="$project --jobs 1 --no-header"
add "csv|viewproj, all threads|$points|$project p.csv"
add "csv|--pipepart --header : --block 10M|$points|parallel --pipepart -a p.csv -k --header : --block 10M $csv"
f64="--recend '' --block 24M $project --jobs 1 --from f64"
add "f64|viewproj, all threads|$points|$project p.f64"
add "f64|--pipepart --block 24M|$points|parallel --pipepart -a p.f64 -k $f64"
add "f64|--pipe --block 24M|$points|parallel --pipe -k $f64 <p.f64"

# The first of each form says what the others must print. Only it has a header.
of=""
while IFS='|' read -r form name _ command; do
  sh -c "$command" </dev/null >printed
  if [ "$form" != "$of" ]; then
    of=$form
    if [ "$form" = csv ]; then sed -i 1d printed; fi
    [ -s printed ]
    mv printed first
  else
    cmp first printed || { echo "$form: $name prints something else" >&2; exit 1; }
  fi
done <contenders
rm first printed
race
