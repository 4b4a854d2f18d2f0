#!/bin/sh
# What only Windows has: run by platforms.sh, with a tool that wine runs.
#   sh windows.sh VIEWPROJ
set -eu
tool=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
trap 'exit 1' HUP INT TERM
samples=$(pwd)/samples
cd "$work"
camera=$samples/picking-a-pixel/camera.json

fail() {
  echo "windows: $1" >&2
  exit 1
}
# expect WHAT FILE BYTES: the file has these, as printf writes them.
expect() {
  # shellcheck disable=SC2059  # a format
  printf "$3" | cmp -s - "$2" || fail "$1: $(od -c "$2" | head -n 5)"
}

row='687.0855266374657 291.25547058761947 0.9780820439080731\n'
# Names in UTF-8, of what is read, written and told.
printf '1 1 1\n' >'Kölner Brücke 橋.txt'
"$tool" project -c "$camera" 'Kölner Brücke 橋.txt' -o 'Übersicht 図.txt'
expect 'a name in UTF-8' 'Übersicht 図.txt' "$row"
[ "$(find . -type f | wc -l)" = 2 ] || fail 'something is left beside the output'
"$tool" project -c 'fehlt 欠.json' --point 1,1,1 2>message && fail 'a file that is not there is read'
expect 'the message of a missing file' message 'viewproj: fehlt 欠.json: No such file or directory\n'
# Bytes go as they are: no CR comes or goes, and Ctrl-Z ends nothing.
printf '1 1 1\r\n1 1 1\n' | "$tool" project -c "$camera" >seen
expect 'lines that end in CR LF' seen "$row$row"
printf '\032\015\012\000\000\000\044\100' >ten
cat ten ten ten ten ten ten | "$tool" project -c "$camera" --from f64 --to f64 >seen
[ "$(wc -c <seen)" = 48 ] || fail 'binary records change their length'
# What is no file is written as it is.
"$tool" project -c "$camera" --point 1,1,1 -o NUL >seen
expect 'NUL' seen ''
# A file is whole, or as it was.
printf 'before\n' >kept.txt
printf '1 1 1\n1 1 x\n' | "$tool" project -c "$camera" -o kept.txt 2>/dev/null && fail 'a bad record is none'
expect 'a file after an error' kept.txt 'before\n'
printf '1 1 1\n' | "$tool" project -c "$camera" -o kept.txt
expect 'a file that is replaced' kept.txt "$row"
# Who reads goes away.
{ yes '1 1 1' | head -n 100000 | "$tool" project -c "$camera" 2>message || echo "status $?" >>message; } | head -n 1 >seen
expect 'a reader that goes away' seen "$row"
expect 'messages when a reader goes away' message ''
echo 'names, bytes, NUL, -o and closed pipes are right'
