#!/bin/sh
# Runs the ```console blocks of a page and compares what they print with what it shows; what it links to must be there.
#   sh page.sh VIEWPROJ PAGE.md      (in the folder that the commands are run in: a folder of links to what is in it)
set -eu
# shellcheck source=tests/cmd/limits.sh
. "$(dirname "$0")/limits.sh"
limit_memory "$1"
PATH="$(cd "$(dirname "$1")" && pwd):$PATH"
export PATH
page=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir "$work/folder"
for entry in "$PWD"/*; do ln -s "$entry" "$work/folder"; done

touch "$work/shown" "$work/commands" "$work/printed"
awk -v shown="$work/shown" -v commands="$work/commands" '
  /^```console$/ { inside = 1; next }
  /^```$/        { inside = 0 }
  inside         { print > shown; if (sub(/^\$ /, "")) print > commands }
' "$page"

# A command may fail where the page shows the message.
while IFS= read -r command; do
  printf '$ %s\n' "$command" >>"$work/printed"
  status=0
  (cd "$work/folder" && limited sh -c "$command") >"$work/one" 2>&1 </dev/null || status=$?
  cat "$work/one" >>"$work/printed"
  if [ "$status" -ge 124 ] || { [ "$status" != 0 ] && ! grep -q '^viewproj: ' "$work/one"; }; then
    echo "$page: status $status of: $command"
    exit 1
  fi
done <"$work/commands"

if ! diff -u "$work/shown" "$work/printed"; then
  echo "$page shows something else than the commands print."
  exit 1
fi

folder=$(dirname "$page")
# shellcheck disable=SC2016  # backquotes of Markdown
sed 's/`[^`]*`//g; s/](\([^)]*\)/\n](\1\n/g' "$page" | sed -n 's/^](//p' | sort -u >"$work/links"
while IFS= read -r link; do
  case $link in http*) continue ;; esac
  file=${link%%#*}
  target=$folder/$file
  if [ -z "$file" ]; then target=$page; fi
  [ -e "$target" ] || { echo "$page links to $link, which is not there"; exit 1; }
  # A heading is named by its words, in lower case, with hyphens between.
  case $link in
    *"#"*) sed -n 's/^##* //p' "$target" | tr 'A-Z ' 'a-z-' | tr -cd 'a-z0-9_\n-' | grep -qx -- "${link#*#}" ||
      { echo "$page links to $link, which is no heading"; exit 1; } ;;
  esac
done <"$work/links"
[ -s "$work/commands" ] || [ -s "$work/links" ] || { echo "$page has neither commands nor links"; exit 1; }
echo "$page: $(wc -l <"$work/commands") commands print what it shows, $(wc -l <"$work/links") links lead somewhere"
