#!/bin/sh
# Golden tests of a command: runs every case and compares what it prints with what it should print, byte for byte.
#
#   sh run.sh VIEWPROJ CASES_DIR [CASE]
#
# VIEWPROJ is the executable. Every directory in CASES_DIR is a case:
#
#   cmd      shell lines, run inside the case's directory; the word viewproj is the executable
#   expout   the standard output they must give
#   experr   the standard error output; no file: none
#   status   the exit status; no file: 0
#
# Other files in the directory are the case's own; files beside the cases are shared. Prints the cases that fail, as
# differences, and a closing line. A case that takes more than a minute or 2 GiB fails. JOBS=N in the environment: so
# many cases at a time, 2 by default. REGENERATE=1 writes what the cases give instead, for git diff to show.
set -eu
# shellcheck source=tests/cmd/limits.sh
. "$(dirname "$0")/limits.sh"

complain() {
  echo "run.sh: $1" >&2
  exit 1
}

if [ $# -lt 2 ] || [ $# -gt 3 ]; then
  echo 'usage: sh run.sh VIEWPROJ CASES_DIR [CASE]' >&2
  exit 2
fi
if [ ! -f "$1" ] || [ ! -x "$1" ]; then complain "$1 is no executable"; fi
if [ "$(basename "$1")" != viewproj ]; then complain "$1: the executable must be called viewproj"; fi
limit_memory "$1"
bin=$(cd "$(dirname "$1")" && pwd)
cases=$(cd "$2" && pwd)
one=${3-}
one=${one%/}
one=${one##*/}
PATH=$bin:$PATH
LC_ALL=C
export PATH LC_ALL
unset COLUMNS

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
trap 'exit 1' HUP INT TERM
cd "$work"

# Of one case, in the folder of a worker: expout, experr and status.
give() {
  status=0
  (cd "$directory" && limited sh ./cmd) >expout 2>experr </dev/null || status=$?
}

# keep FILE: stores what the case gave; no file where that is nothing.
keep() {
  if [ -s "$1" ]; then cp "$1" "$directory/$1"; else rm -f "$directory/$1"; fi
}

regenerate() {
  give
  if [ "$status" = 0 ]; then : >status; else echo "$status" >status; fi
  cp expout "$directory/expout"
  keep experr
  keep status
}

# differs FILE: shows the differences from the expected FILE of the case, which is empty where there is none.
differs() {
  expected=$directory/$1
  if [ ! -f "$expected" ]; then
    [ -s "$1" ] || return 1
    expected=/dev/null
  fi
  cmp -s "$expected" "$1" && return 1
  echo "--- $name: $1"
  diff -u "$expected" "$1" | sed 1,2d
}

# Prints what is wrong with a case; whether it is right.
right() {
  for file in cmd expout; do
    [ -f "$directory/$file" ] || {
      echo "--- $name: has no $file"
      return 1
    }
  done
  give
  bad=0
  wanted=0
  if [ -f "$directory/status" ]; then read -r wanted <"$directory/status"; fi
  if [ "$status" = 124 ] || [ "$status" = 137 ]; then echo "--- $name: took more than $patience seconds"; fi
  if differs expout; then bad=1; fi
  if differs experr; then bad=1; fi
  if [ "$status" != "$wanted" ]; then
    echo "--- $name: status $status, not $wanted"
    bad=1
  fi
  return "$bad"
}

# worker N: every case whose turn it is, in a folder of its own; the names of those that passed and failed.
worker() {
  mkdir "$1"
  cd "$1"
  : >passed
  : >failed
  turn=0
  for directory in "$cases"/${one:-*}/; do
    [ -d "$directory" ] || continue
    directory=${directory%/}
    name=${directory##*/}
    turn=$(((turn + 1) % jobs))
    [ "$turn" = "$1" ] || continue
    if [ "${REGENERATE-}" = 1 ]; then
      regenerate
      echo "$name" >>passed
    elif right >>report; then
      echo "$name" >>passed
    else
      echo "$name" >>failed
    fi
  done
  : >finished
}

jobs=${JOBS:-2}
workers=$(seq 0 $((jobs - 1)))
for number in $workers; do worker "$number" & done
wait
for number in $workers; do
  [ -f "$number/finished" ] || complain 'ended before its time'
  if [ -f "$number/report" ]; then cat "$number/report"; fi
done
passed=$(cat ./*/passed | wc -l)
failed=$(cat ./*/failed | wc -l)
if [ $((passed + failed)) = 0 ]; then complain "no case${one:+ $one} in $2"; fi
if [ "${REGENERATE-}" = 1 ]; then echo "$passed written"; else echo "$passed passed, $failed failed"; fi
# Each folder is a case; none is passed over.
if [ -z "$one" ]; then
  set -- "$cases"/*/
  [ $# = $((passed + failed)) ] || complain "$# cases, and $((passed + failed)) run"
fi
[ "$failed" = 0 ]
