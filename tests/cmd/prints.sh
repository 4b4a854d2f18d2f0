#!/bin/sh
# A program prints just these words, and its status is 0.
#   sh prints.sh PROGRAM WORDS...
set -eu
program=$1
shift
printed=$("$program")
[ "$printed" = "$*" ] || {
  echo "$program prints '$printed', not '$*'"
  exit 1
}
