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
# differences, and a closing line. REGENERATE=1 in the environment writes what the cases give instead, for git diff to
# show.
set -u

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
bin=$(cd "$(dirname "$1")" && pwd) || exit 1
cases=$(cd "$2" && pwd) || exit 1
one=${3+$(basename "$3")}
PATH=$bin:$PATH
LC_ALL=C
export PATH LC_ALL

work=${TMPDIR:-/tmp}/viewproj-cases-$$
(umask 077 && mkdir "$work") || exit 1
trap 'rm -rf "$work"' EXIT
trap 'exit 1' HUP INT TERM

# The output of a case and its exit status, in the working directory of the runner.
give() {
  status=0
  (cd "$1" && exec sh ./cmd) >"$work/expout" 2>"$work/experr" </dev/null || status=$?
  echo "$status" >"$work/status"
}

# keep FILE UNLESS: stores what the case gave; no file where it gave only the content of UNLESS.
keep() {
  if [ -n "$2" ] && cmp -s "$work/$1" "$2"; then rm -f "$directory/$1"; else cp "$work/$1" "$directory/$1"; fi
}

# differs FILE DEFAULT: shows the differences from the expected FILE of the case, or from DEFAULT without one.
differs() {
  expected=$directory/$1
  [ -f "$expected" ] || expected=$2
  cmp -s "$expected" "$work/$1" && return 1
  echo "--- $name: $1"
  diff -u "$expected" "$work/$1" | sed 1,2d
  return 0
}

: >"$work/nothing"
echo 0 >"$work/zero"
passed=0
failed=0
written=0
for directory in "$cases"/${one:-*}/; do
  directory=${directory%/}
  name=${directory##*/}
  [ -d "$directory" ] || continue
  if [ ! -f "$directory/cmd" ]; then
    echo "--- $name: has no cmd"
    failed=$((failed + 1))
  elif [ "${REGENERATE-}" = 1 ]; then
    give "$directory"
    keep expout ''
    keep experr "$work/nothing"
    keep status "$work/zero"
    written=$((written + 1))
  elif [ ! -f "$directory/expout" ]; then
    echo "--- $name: has no expout"
    failed=$((failed + 1))
  else
    give "$directory"
    bad=0
    differs expout "$work/nothing" && bad=1
    differs experr "$work/nothing" && bad=1
    differs status "$work/zero" && bad=1
    if [ "$bad" = 1 ]; then failed=$((failed + 1)); else passed=$((passed + 1)); fi
  fi
done

if [ $((passed + failed + written)) = 0 ]; then complain "no case${one:+ $one} in $2"; fi
if [ "${REGENERATE-}" = 1 ]; then echo "$written written, $failed failed"; else echo "$passed passed, $failed failed"; fi
[ "$failed" = 0 ]
