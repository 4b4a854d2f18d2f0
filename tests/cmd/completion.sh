#!/bin/bash
# Completion in bash: what is offered at the end of a command line.
#   bash completion.sh VIEWPROJ COMPLETION_FILE
set -eu
# shellcheck source=/dev/null
. "$2"

# offered WORD...: what is offered for the last of these.
offered() {
  COMP_WORDS=(viewproj "$@")
  COMP_CWORD=$#
  _viewproj "$tool"
  echo "${COMPREPLY[*]-}"
}

# expect WORDS WORD...
expect() {
  local expected=$1 got
  shift
  got=$(offered "$@")
  [ "$got" = "$expected" ] || { echo "viewproj $*: offered '$got', expected '$expected'" >&2; exit 1; }
}

tool=$1
expect 'project' pro
expect 'measure' me
expect 'check' ch
expect '--help' --h
expect 'cull convert check camera conventions' help c
expect '--convention' matrix --conv
expect '--read-as --reverse-z' project --re
expect '-c' project -c
expect '' project --no-such
expect '' nothing --h
for command in $(offered ''); do
  case $command in
    --*) continue ;;
  esac
  case " $(offered "$command" --) " in
    *' --output '*) ;;
    *) echo "$command has no --output to offer" >&2; exit 1 ;;
  esac
done
# A file's name is bash's own to complete, which knows of blanks in it.
expect '' project my
case $(complete -p viewproj) in
  *'-o default'*) ;;
  *) echo 'file names are not completed' >&2; exit 1 ;;
esac
