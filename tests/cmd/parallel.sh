#!/bin/sh
# The recipes for GNU parallel in the manual, with blocks of a tenth of the size: each must give what one run gives, byte for byte.
#   sh parallel.sh VIEWPROJ cmd/MANUAL.md
# 77: GNU parallel is not there. Recipes are the paragraphs of the sh blocks that call parallel.
set -eu
command -v parallel >/dev/null || { echo "parallel is not installed"; exit 77; }
PATH="$(cd "$(dirname "$1")" && pwd):$PATH"
LC_ALL=C
export PATH LC_ALL
page=$(cd "$(dirname "$2")" && pwd)/$(basename "$2")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
trap 'exit 1' HUP INT TERM
cd "$work"
HOME=$work
export HOME
mkdir .parallel recipes
: >.parallel/will-cite

cat >camera.json <<'END'
{"position": [30, 40, 150], "target": [0, 5, 0], "projection": {"type": "perspective", "fovY": 60, "near": 0.1, "far": 1000},
 "viewport": {"width": 1920, "height": 1080}}
END
# Just enough for several blocks of each form. Screen positions of one camera are the points of f64.
awk 'BEGIN {
  s = 1
  print "id,x,y,z" >"points.csv"
  for (i = 1; i <= 110000; ++i) {
    for (k = 0; k < 3; ++k) { s = s * 16807 % 2147483647; p[k] = s % 100001 / 1000 - 50 }
    print p[0], p[1], p[2] >"points.txt"
    if (i > 50000) continue
    printf "{\"id\":\"p%d\",\"x\":%g,\"y\":%g,\"z\":%g}\n", i, p[0], p[1], p[2] >"points.ndjson"
    printf "p%d,%g,%g,%g\n", i, p[0], p[1], p[2] >"points.csv"
  }
}'
viewproj project -c camera.json --to f64 points.txt >points.f64

awk '
  /^```sh$/ { inside = 1; text = ""; next }
  inside && (/^```$/ || /^$/) {
    sizes = gsub(/--block 10M/, "--block 1M", text) + gsub(/--block 24m/, "--block 2400000", text)
    if (sizes) printf "%s", text >("recipes/" ++count)
    else if (text ~ /parallel/) exit 1
    if (/^```$/) inside = 0
    text = ""
    next
  }
  inside { text = text $0 "\n" }' "$page"

failed=0
complain() {
  echo "--- $1"
  cat "$recipe"
  failed=1
}
# try STATUS: the recipe's output, and its status.
try() {
  rm -f out.*
  status=0
  sh "$recipe" 2>message || status=$?
  form=$(echo out.*)
  form=${form#out.}
  [ "$status" = "$1" ] || { complain "status $status, not $1"; cat message; }
}

count=0
for recipe in recipes/*; do
  try 0
  viewproj project -c camera.json "points.$form" >plain
  cmp plain "out.$form" || complain 'differs from one run'
  count=$((count + 1))
done

# Something wrong near the end: a number that is a word, or not a number.
sed -i '48000s/:\([-0-9.]*\),/:x\1,/' points.ndjson
sed -i '48000s/,/,x/' points.csv
{ head -c 2500008 points.f64; printf '\0\0\0\0\0\0\370\177'; tail -c +2500017 points.f64; } >bad && mv bad points.f64
for recipe in recipes/*; do
  try 1
  if viewproj project -c camera.json "points.$form" >plain 2>plainly; then complain 'one run takes it'; fi
  grep -q '^viewproj: ' plainly || complain 'nothing is wrong with the input'
  head -c "$(wc -c <plain)" "out.$form" | cmp plain - || complain 'what came before is not the same'
done
if [ $count -lt 5 ]; then
  echo "the page has $count recipes"
  exit 1
fi
[ $failed = 0 ]
echo "$count recipes give what one run gives"
