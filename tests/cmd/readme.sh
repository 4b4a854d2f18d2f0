#!/bin/sh
# Runs the ```console blocks of a Markdown file and compares what they print with what it shows.
#   sh readme.sh VIEWPROJ README.md      (in the folder that the commands are run in)
set -eu
PATH="$(cd "$(dirname "$1")" && pwd):$PATH"
export PATH
readme=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

awk -v shown="$work/shown" -v commands="$work/commands" '
  /^```console$/ { inside = 1; next }
  /^```$/        { inside = 0 }
  inside         { print > shown; if (sub(/^\$ /, "")) print > commands }
' "$readme"

while IFS= read -r command; do
  printf '$ %s\n' "$command"
  sh -c "$command" 2>&1 || true
done <"$work/commands" >"$work/printed"

if ! diff -u "$work/shown" "$work/printed"; then
  echo "The README shows something else than the commands print."
  exit 1
fi
echo "$(wc -l <"$work/commands") commands of the README print what it shows"
