#!/bin/sh
# East, north and up of points as a level camera sees them that looks north, against GeographicLib's own CartConvert:
# from places all over the Earth, poles and antimeridian among them, to 10 nm.
#   sh geodetic_tools.sh VIEWPROJ CARTCONVERT
set -eu
viewproj=$1
cartconvert=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

compared=0
for eye in '55 5 200' '0 0 0' '90 0 10' '90 137.5 10' '-90 -60 2800' '45.98333 7.785 3185' '-16.5 180 0' '-16.5 -180 900' \
  '71.25 179.9999999 40' '-33.9 18.4 1000' '0.000000001 -120 5' '-45 -45 400000' '89.99999 12 0' '27.98806 -273.07472 8848'; do
  # shellcheck disable=SC2086  # three numbers
  set -- $eye
  # No exponents: the e of 1e-7 stands for east there.
  awk -v lat="$1" -v lon="$2" -v height="$3" -v seed="$compared" 'BEGIN {
    srand(seed + 1)
    for (i = 0; i < 50; ++i) {
      size = exp(log(1e-7) + rand() * log(1e8))  # degrees
      a = lat + size * (2 * rand() - 1)
      if (a > 90) a = 180 - a
      if (a < -90) a = -180 - a
      b = lon + size * (2 * rand() - 1)
      if (b > 360) b -= 360
      printf "%.15f %.15f %.9f\n", a, b, height + size * 1e4 * (2 * rand() - 1)
    }
  }' >"$work/points"
  "$cartconvert" -l "$1" "$2" "$3" -p 9 <"$work/points" >"$work/theirs"
  sed 's/^\([^ ]*\) \([^ ]*\) \(.*\)$/{"lat": \1, "lon": \2, "height": \3}/' "$work/points" |
    "$viewproj" project --fields view --to csv -c "{\"position\": {\"lat\": $1, \"lon\": $2, \"height\": $3}, \"heading\": 0,
      \"projection\": {\"type\": \"perspective\", \"fovY\": 60, \"near\": 1}, \"viewport\": {\"width\": 1, \"height\": 1}}" |
    sed 1d | cut -d, -f4- | tr , ' ' >"$work/ours"
  paste -d' ' "$work/theirs" "$work/ours" | awk -v eye="$eye" '
    function off(a, b) { return a > b ? a - b : b - a }
    NF != 6 || off($1, $4) > 1e-8 || off($2, -$6) > 1e-8 || off($3, $5) > 1e-8 {
      print "from " eye ": CartConvert has " $1, $2, $3 "; viewproj (east, up, south) " $4, $5, $6; bad = 1
    }
    END { exit bad || NR != 50 }'
  compared=$((compared + 50))
done
echo "$compared points agree with CartConvert to 10 nm"
