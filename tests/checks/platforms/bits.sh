#!/bin/sh
# Prints what a tool makes of ten thousand points and cameras of every convention, in every precision: the bits of its
# doubles, and texts. The bytes are the same on every platform; PLACES=0 in the environment leaves out places on the Earth.
#   sh tests/checks/platforms/bits.sh TOOL [ARGUMENT...] >BYTES      the tool may be a command with arguments
set -eu
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
trap 'exit 1' HUP INT TERM

# Decimal texts of up to 15 digits, from 1e-9 to 1e9 around the origin, the same in every awk.
awk 'BEGIN {
  seed = 1
  print "x,y,z"
  for (i = 0; i < 10000; ++i) {
    line = ""
    for (j = 0; j < 3; ++j) {
      seed = (seed * 48271) % 2147483647
      high = seed
      seed = (seed * 48271) % 2147483647
      e = i % 10 < 8 ? -9 : (i + j) % 18 - 18
      line = line (j > 0 ? "," : "") (seed % 2 ? "-" : "") sprintf("%d%05de%d", high, seed % 100000, e - 5)
    }
    print line
  }
}' >"$work/points.csv"
awk 'BEGIN {
  seed = 2
  print "pixel_x,pixel_y"
  for (i = 0; i < 2000; ++i) {
    seed = (seed * 48271) % 2147483647
    x = seed % 2560000
    seed = (seed * 48271) % 2147483647
    printf "%.3f,%.3f\n", x / 1000 - 640, seed % 1440000 / 1000 - 360
  }
}' >"$work/pixels.csv"
awk 'BEGIN {
  seed = 3
  print "lat,lon,height"
  for (i = 0; i < 2000; ++i) {
    seed = (seed * 48271) % 2147483647
    lat = seed % 1800001
    seed = (seed * 48271) % 2147483647
    printf "%.4f,%.4f,%d\n", lat / 10000 - 90, seed % 3600001 / 10000 - 180, seed % 9000
  }
}' >"$work/places.csv"

turn=0
for convention in opengl opengl-lh d3d d3d-rh vulkan metal webgpu unity unreal opencv ps2; do
  turn=$((turn + 1))
  case $((turn % 4)) in
    0) lens="--fov-y 4.$turn --near 1e-3 --far 1e9" ;;
    1) lens="--fov-y 60.$turn --near 0.1" ;;
    2) lens="--ortho-height 3.$turn --near -7 --far 1e3" ;;
    3) lens="--fov-x 117.$turn --near 0.1 --far 1000 --shift 0.1,-0.2" ;;
  esac
  camera="--position 3.1,2.$turn,5.3 --target 0.1,0.2,0.3 --viewport 1280x720 --read-as $convention $lens"
  for precision in standard exact; do
    echo "== $convention project $precision"
    # shellcheck disable=SC2086  # a list of words
    "$@" project $camera --precision $precision --to f64 "$work/points.csv"
  done
  echo "== $convention ray"
  # shellcheck disable=SC2086
  "$@" ray $camera --to f64 "$work/pixels.csv"
  echo "== $convention matrix"
  # shellcheck disable=SC2086
  "$@" matrix $camera --convention $convention --inverse
done
camera="--position 3,2,5 --target 0,0,0 --fov-y 60 --near 0.1 --viewport 1280x720"
for form in csv ndjson table; do
  echo "== $form"
  # shellcheck disable=SC2086
  "$@" project $camera --fields all --to $form "$work/points.csv"
done
# GeographicLib takes sines and the like from the system.
[ "${PLACES-}" != 0 ] || exit 0
echo '== places'
"$@" project --position lat=47.1,lon=8.2,height=1500 --heading 98 --pitch -10 --fov-y 40 --near 1 --viewport 1280x720 \
  --to f64 "$work/places.csv"
