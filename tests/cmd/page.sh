#!/bin/sh
# Runs the ```console blocks of a page and compares what they print with what it shows; what it links to must be there.
#   sh page.sh VIEWPROJ PAGE.md      (in the folder that the commands are run in)
set -eu
PATH="$(cd "$(dirname "$1")" && pwd):$PATH"
export PATH
page=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

touch "$work/shown" "$work/commands"
awk -v shown="$work/shown" -v commands="$work/commands" '
  /^```console$/ { inside = 1; next }
  /^```$/        { inside = 0 }
  inside         { print > shown; if (sub(/^\$ /, "")) print > commands }
' "$page"

while IFS= read -r command; do
  printf '$ %s\n' "$command"
  sh -c "$command" 2>&1 || true
done <"$work/commands" >"$work/printed"

if ! diff -u "$work/shown" "$work/printed"; then
  echo "$page shows something else than the commands print."
  exit 1
fi

folder=$(dirname "$page")
# shellcheck disable=SC2016  # backquotes of Markdown
sed 's/`[^`]*`//g' "$page" | grep -o '](\([^)#]*\)' | sed 's/^](//' | sort -u >"$work/links" || true
while IFS= read -r link; do
  case $link in http*) continue ;; esac
  [ -e "$folder/$link" ] || { echo "$page links to $link, which is not there"; exit 1; }
done <"$work/links"
echo "$page: $(wc -l <"$work/commands") commands print what it shows, $(wc -l <"$work/links") links lead somewhere"
