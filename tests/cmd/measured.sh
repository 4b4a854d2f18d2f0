#!/bin/sh
# The table of `measure` on the page of accuracy: what of it does not depend on the machine must be what the command prints.
#   sh measured.sh VIEWPROJ ACCURACY.md SAMPLE_DIR
set -eu
# Rows of numbers without the time: mode, error, bound, count.
untimed() { sed -nE 's/^ *((standard|exact|matrix (double|float32)) +)[0-9.]+ +/\1/p' | tr -s ' '; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
awk '/^```text$/ { inside = 1; next } /^```$/ { inside = 0 } inside' "$2" | untimed >"$work/shown"
PATH=$(cd "$(dirname "$1")" && pwd):$PATH
(cd "$3" && sh points.sh | viewproj measure -c camera.json) | untimed >"$work/printed"
[ "$(wc -l <"$work/shown")" = 4 ] || { echo "the page shows $(wc -l <"$work/shown") rows, not 4"; exit 1; }
diff -u "$work/shown" "$work/printed"
echo "the errors and bounds of the page's table are those measured"
