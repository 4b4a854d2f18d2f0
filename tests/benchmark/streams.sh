#!/bin/sh
# The same points through viewproj and through other filters, as ratios of one run.
#
#   sh tests/benchmark/streams.sh [VIEWPROJ] [POINTS]
#
# VIEWPROJ is the executable (build/viewproj), POINTS how many (1000000). All have the same camera, 4x4 matrix times
# point, division and viewport, and print screen x, y and depth so that they read back to the same doubles, behind each
# record's own fields; cct affine goes to view coordinates only, and cct topocentric and CartConvert do a job of their
# own kind. What they print is compared with viewproj's first. Slow ones get a tenth of the points, f64 has five times as
# many. Programs take turns, ROUNDS times (5; 0: once, and no times), their output to /dev/null unless it says otherwise.
# Tools that are missing are left out with a word, and the status is 77; a C++ compiler is needed for the clock. On Debian:
# jq miller mawk gawk proj-bin geographiclib-tools nodejs.
set -eu
here=$(cd "$(dirname "$0")" && pwd)/streams
# shellcheck source=tests/benchmark/streams/race.sh
. "$here/race.sh"
points=${2:-1000000}
prepare "${1:-build/viewproj}" points timed answer
camera=$here/camera.json
# Interpreters are slower under them.
unset PYTHONUNBUFFERED NODE_EXTRA_CA_CERTS
for form in ndjson csv text; do
  ./points $form "$points" >p.$form
  ./points $form $((points / 10)) >few.$form
done
./points f64 $((5 * points)) >p.f64

# Rows of the matrix, separated by blanks, and by commas.
rows() { "$viewproj" matrix "$camera" --which "$1" --to text | awk '!/^#/ { $1 = $1; print }' | tr '\n' ' ' | sed 's/ $//'; }
m=$(rows viewProjection)
m_json="[$(echo "$m" | tr ' ' ',')]"
affine=$(rows view | awk '{ printf "+s11=%s +s12=%s +s13=%s +xoff=%s +s21=%s +s22=%s +s23=%s +yoff=%s +s31=%s +s32=%s +s33=%s +zoff=%s",
                             $1, $2, $3, $4, $5, $6, $7, $8, $9, $10, $11, $12 }')

# inlined PROGRAM MATRIX FIRST: with the camera's numbers in place of variables, which is faster; MATRIX is the pattern of
# the matrix's name, FIRST its first index.
inlined() {
  i=$3
  script=""
  for number in $m; do
    script="$script; s/$2\\[$i\\]/($number)/g"
    i=$((i + 1))
  done
  sed "s/\\\$width/1920/g; s/\\\$height/1080/g; s/ \\* width/ * 1920/; s/ \\* height/ * 1080/$script" "$here/$1"
}
# shellcheck disable=SC2016  # a pattern
inlined project.jq '\$m' 0 >inlined.jq
inlined project.awk a 1 >inlined.awk

has() { command -v "$1" >/dev/null; }
absent=""
for tool in jq mlr mawk gawk cct CartConvert node; do has $tool || absent="$absent $tool"; done
if [ -n "$absent" ]; then echo "left out:$absent"; fi
few=$((points / 10))
jq="jq -c --argjson m '$m_json' --argjson width 1920 --argjson height 1080 -f $here/project.jq <"
awk_options="-v m='$m' -v width=1920 -v height=1080 -f $here/project.awk"
mlr_put="put -s m='$m' -s width=1920 -s height=1080 -f $here/project.mlr"
node="node $here/project.js '$m' 1920 1080 <"
cct="cct -d 12 +proj=affine $affine"
project="$viewproj project -c $camera --fields screen,depth"
# The rows that both text forms have: text FORM
text() {
  add "$1|viewproj|$points|$project --jobs 1 p.$1"
  add "$1|viewproj --precision standard|$points|$project --jobs 1 --precision standard p.$1"
  add "$1|viewproj --jobs 2|$points|$project --jobs 2 p.$1"
  add "$1|viewproj, results as by default|$points|$viewproj project -c $camera --jobs 1 p.$1"
}

text ndjson
if has node; then add "ndjson|node, JSON.parse a line|$points|$node p.ndjson"; fi
if has jq; then
  add "ndjson|$(jq --version)|$few|$jq few.ndjson"
  add "ndjson|jq, constants inlined|$few|jq -c -f inlined.jq few.ndjson"
fi
if has mlr; then add "ndjson|mlr|$few|mlr --ijsonl --ojsonl $mlr_put few.ndjson"; fi
add "ndjson|cat|$points|cat p.ndjson"
add "ndjson in pipes|cat, viewproj and cat|$points|cat p.ndjson | $project --jobs 1 | cat"
add "ndjson in pipes|cat, cat and cat|$points|cat p.ndjson | cat | cat"

text csv
for awk in mawk gawk; do
  if has $awk; then
    add "csv|$awk|$points|$awk $awk_options p.csv"
    add "csv|$awk, constants inlined|$points|$awk -f inlined.awk p.csv"
  fi
done
if has cct; then
  add "csv|cct affine, to view coordinates|$points|$cct p.text"
  add "csv|cct topocentric|$points|cct -d 12 +proj=topocentric +ellps=WGS84 +X_0=6378137 +Y_0=1 +Z_0=2 p.text"
fi
if has CartConvert; then add "csv|CartConvert|$few|CartConvert -l 1 2 3 --input-file few.text"; fi
if has mlr; then add "csv|mlr|$few|mlr --icsv --ocsv $mlr_put few.csv"; fi
add "csv|cat|$points|cat p.csv"

many=$((5 * points))
f64="$viewproj project -c $camera --from f64 --precision standard --jobs"
add "f64|viewproj --precision standard|$many|$f64 1 p.f64"
add "f64|viewproj --precision standard, 2 jobs|$many|$f64 2 p.f64"
add "f64|viewproj|$many|$viewproj project -c $camera --jobs 1 p.f64"
add "f64|cat|$many|cat p.f64"
add "f64 in pipes|cat, viewproj standard and cat|$many|cat p.f64 | $f64 1 | cat"
add "f64 in pipes|cat, cat and cat|$many|cat p.f64 | cat | cat"
add "f64 to a file|viewproj --precision standard|$many|$f64 1 p.f64 >$out/f64"
add "f64 to a file|cat|$many|cat p.f64 >$out/f64"

# A start, a hundred after each other.
# shellcheck disable=SC2016  # for a shell of its own
starts='i=0; while [ $i -lt 100 ]; do'
# shellcheck disable=SC2016
ends='; i=$((i + 1)); done'
add "one shot|true|100|$starts /bin/true$ends"
add "one shot|viewproj matrix|100|$starts $viewproj matrix $camera$ends"
add "one shot|viewproj project, a point|100|$starts echo 1 2 3 | $viewproj project -c $camera$ends"
if has jq; then add "one shot|jq|100|$starts jq -n 1$ends"; fi

# agree NAME TOLERANCE: standard input and the file `ours` have the same numbers on a line, in the same order.
agree() {
  paste -d ' ' ours - | awk -v name="$1" -v tolerance="$2" '
    NF % 2 { print name ": line " NR " has other numbers: " $0; exit failed = 1 }
    { for (i = 1; i <= NF / 2; ++i) { d = $i - $(i + NF / 2); if (d < 0) d = -d; if (!(d <= worst)) worst = d } }
    END {
      if (failed) exit 1
      if (!(NR > 0 && worst <= tolerance)) { print name " differs by " worst " in " NR " lines"; exit 1 }
      printf "%-12s agrees on %d points within %.1e\n", name, NR, worst
    }'
}
numbers_of_json() { tr -d ' ' | sed 's/.*"screen":\[//; s/\],"depth":/ /; s/}$//; s/,/ /g'; }
numbers_of_csv() { sed '1d; s/^[^,]*,[^,]*,[^,]*,[^,]*,//; s/,/ /g'; }
$project few.text >ours
$project few.ndjson | numbers_of_json | agree "ndjson" 0
$project few.csv | numbers_of_csv | agree "csv" 0
if has jq; then
  eval "$jq few.ndjson" | numbers_of_json | agree jq 1e-9
  jq -c -f inlined.jq few.ndjson | numbers_of_json | agree "jq inlined" 1e-9
fi
if has node; then eval "$node few.ndjson" | numbers_of_json | agree node 1e-9; fi
if has mlr; then eval "mlr --ijsonl --ojsonl $mlr_put few.ndjson" | numbers_of_json | agree mlr 1e-9; fi
for awk in mawk gawk; do
  if has $awk; then
    eval "$awk $awk_options few.csv" | numbers_of_csv | agree $awk 1e-9
    $awk -f inlined.awk few.csv | numbers_of_csv | agree "$awk inlined" 1e-9
  fi
done
$viewproj project -c "$camera" --fields view few.text >ours
if has cct; then $cct few.text | awk '{ print $1, $2, $3 }' | agree "cct affine" 1e-9; fi

race
[ "${ROUNDS-}" = 0 ] || echo
# shellcheck disable=SC2046  # two numbers
set -- $(./answer 200 '{"id":"p1","x":1.25,"y":-3.5,"z":10.75}' "$viewproj" project -c "$camera")
[ $# = 2 ]
if [ "${ROUNDS-}" = 0 ]; then
  echo 'a record typed by hand is answered'
else
  echo "a record typed by hand is answered in $1 us (median of 200; the longest $2)"
fi
[ -z "$absent" ] || exit 77
