#!/bin/bash
# Completion in bash: what is offered at the end of a command line; the other shells' files are well formed where they
# are here.
#   bash completion.sh FOLDER     with viewproj, _viewproj and viewproj.fish
set -eu
# shellcheck source=/dev/null
. "$1/viewproj"
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
touch camera.json points.csv

# offered WORD...: what is offered for the last of these.
offered() {
  COMP_WORDS=(viewproj "$@")
  COMP_CWORD=$#
  _viewproj
  echo "${COMPREPLY[*]-}"
}

# expect WORDS WORD...
expect() {
  local expected=$1 got
  shift
  got=$(offered "$@")
  [ "$got" = "$expected" ] || { echo "viewproj $*: offered '$got', expected '$expected'" >&2; exit 1; }
}

expect 'project' pro
expect 'measure' me
expect '--help' --h
expect '--convention' matrix --conv
expect 'd3d d3d-rh' matrix --convention d3
expect '0..1' matrix --ndc-z 0
expect 'camera.json' matrix cam
expect 'camera.json' project -c cam
expect 'points.csv' project -c camera.json po
expect '' project --prefix x
expect 'exact' project --precision e
expect 'cull camera conventions' help c
expect 'scene' schema s
expect '' project --no-such
for command in project ray cull matrix inspect explain depth measure draw schema help; do
  case " $(offered "$command" --) " in
    *' --output '*) ;;
    *) echo "$command has no --output to offer" >&2; exit 1 ;;
  esac
done
if command -v zsh >/dev/null; then zsh -n "$1/_viewproj"; fi
if command -v fish >/dev/null; then fish -n "$1/viewproj.fish"; fi
