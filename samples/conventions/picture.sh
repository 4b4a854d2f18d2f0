#!/bin/sh
# The picture of a convention: a camera's view volume with NDC at its corners, view space at the eye, the world beside it.
#   sh picture.sh PRESET > PRESET.svg
# Every number in it comes from viewproj; awk only draws the lines.
set -eu
preset=$1

# Right, up and forward of the camera in the usual world of that convention.
case $preset in
  opengl-lh | d3d | unity) frame='1 0 0  0 1 0  0 0 1' ;;
  unreal) frame='0 1 0  0 0 1  1 0 0' ;;
  opencv) frame='1 0 0  0 -1 0  0 0 1' ;;
  *) frame='1 0 0  0 1 0  0 0 -1' ;;
esac
# place RIGHT UP FORWARD: prints that place in world coordinates.
place() {
  echo "$frame $*" | awk '{ for (i = 1; i <= 3; ++i) printf "%s%g", (i > 1 ? ", " : ""), $10 * $i + $11 * $(i + 3) + $12 * $(i + 6) }'
}
camera() {  # camera EYE DIRECTION FOVY NEAR FAR WIDTH HEIGHT
  printf '{"convention": "%s", "position": [%s], "direction": [%s], "up": [%s],
    "projection": {"type": "perspective", "fovY": %s, "near": %s, "far": %s},
    "viewport": {"width": %s, "height": %s, "pixelCenter": 0.5}}' "$preset" "$1" "$2" "$(place 0 1 0)" "$3" "$4" "$5" "$6" "$7"
}
seen=$(camera "$(place 0 0 0)" "$(place 0 0 1)" 44 1 3 300 200)
from=$(camera "$(place 6.2 3.1 -3.2)" "$(place -6.4 -3.1 4.6)" 28 0.1 100 720 430)

# Prints NAME,TEXT,X,Y,Z: the corners n0 to n3 and f0 to f3 around the picture from its top left, and the axes' ends.
points() {
  for distance in 1 3; do
    for corner in 0,0 300,0 300,200 0,200; do echo "{\"pixel\":[$corner],\"viewDistance\":$distance}"; done
  done | viewproj ray -c "$seen" --to csv | awk -F, 'NR == 1 { print "x,y,z" } NR > 1 { print $10 "," $11 "," $12 }' |
    viewproj project -c "$seen" --fields ndc |
    awk -F, 'NR > 1 { printf "%s%d,%.3g %.3g %.3g,%s,%s,%s\n", NR < 6 ? "n" : "f", (NR - 2) % 4, $4, $5, $6, $1, $2, $3 }'
  echo "eye,,$(place 0 0 0 | tr -d ' ')"
  # The columns of the view's inverse: where view x, y and z point.
  viewproj matrix -c "$seen" --which view --inverse --to glsl |
    awk '/viewInverse/ { inside = 1; next } inside && n < 3 { gsub(/[, ]+/, " "); print "v" n++ ",view " substr("xyz", n, 1) "," .8 * $1 "," .8 * $2 "," .8 * $3 }'
  place -2.4 -2.1 -0.4 | tr -d ' ' | awk -F, '{
    print "world,," $1 "," $2 "," $3
    for (i = 1; i <= 3; ++i) print "w" i - 1 ",world " substr("xyz", i, 1) "," $1 + .6 * (i == 1) "," $2 + .6 * (i == 2) "," $3 + .6 * (i == 3) }'
}

# The description of the convention in the comments of `viewproj matrix`.
words=$(viewproj matrix -c "$seen" --which projection --to c | sed -n 's|^/\* \(.*\)\. \*/$|\1|p')

{ echo name,text,x,y,z; points; } | viewproj project -c "$from" --fields screen,visible | awk -F, -v preset="$preset" -v words="$words" '
  function line(from, to, class) { printf "<path class=\"%s\" d=\"M%.1f %.1fL%.1f %.1f\"/>\n", class, x[from], y[from], x[to], y[to] }
  function face(side) {
    printf "<path class=\"%s\" d=\"M%.1f %.1fL%.1f %.1fL%.1f %.1fL%.1f %.1fz\"/>\n", side,
      x[side 0], y[side 0], x[side 1], y[side 1], x[side 2], y[side 2], x[side 3], y[side 3]
  }
  function label(name, toX, toY, anchor) {
    printf "<text x=\"%.1f\" y=\"%.1f\" text-anchor=\"%s\">%s</text>\n", x[name] + toX, y[name] + toY, anchor, text[name]
  }
  function axes(from, names,   i, far) {
    for (i = 0; i < 3; ++i) line(from, names i, "axis " substr("xyz", i + 1, 1))
    for (i = 0; i < 3; ++i) {
      far = sqrt((x[names i] - x[from]) ^ 2 + (y[names i] - y[from]) ^ 2)
      label(names i, 20 * (x[names i] - x[from]) / far, 13 * (y[names i] - y[from]) / far + 4, "middle")
    }
  }
  NR > 1 && $8 != "true" { print preset ": " $1 " is not in the picture" >"/dev/stderr"; exit 1 }
  NR > 1 { text[$1] = $2; x[$1] = $6; y[$1] = $7 }
  END {
    print "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 720 472\" font-family=\"sans-serif\" font-size=\"14\">"
    print "<title>" preset ": NDC at the corners of the view volume, and the axes of view space and of the world</title>"
    print "<style>.ground{fill:#fff}text{fill:#222;paint-order:stroke;stroke:#fff;stroke-width:3px}.name{font-weight:bold;font-size:16px}" \
      ".f,.n{fill:#4477aa;fill-opacity:.1;stroke:#4477aa}.n{fill-opacity:.3}.edge{stroke:#4477aa}.ray{stroke:#4477aa;stroke-dasharray:3 3}" \
      ".axis{stroke-width:2.5;marker-end:url(#tip)}.x{stroke:#cc3311}.y{stroke:#117733}.z{stroke:#332288}#tip{fill:context-stroke}</style>"
    print "<marker id=\"tip\" viewBox=\"0 0 8 8\" refX=\"6\" refY=\"4\" markerWidth=\"4\" markerHeight=\"4\" orient=\"auto\"><path d=\"M0 0L8 4L0 8z\"/></marker>"
    print "<rect class=\"ground\" width=\"720\" height=\"472\"/>"
    print "<text class=\"name\" x=\"16\" y=\"30\">" preset "</text>"
    for (i = split(words, sentence, "\n"); i > 0; --i) print "<text x=\"16\" y=\"" 418 + 20 * i "\">" sentence[i] "</text>"
    face("f")
    for (i = 0; i < 4; ++i) { line("n" i, "f" i, "edge"); line("eye", "n" i, "ray") }
    face("n")
    axes("eye", "v")
    axes("world", "w")
    for (i = 0; i < 4; ++i) {
      label("f" i, i == 3 ? 34 : 8, i < 2 ? -8 : i == 2 ? 18 : 2, "middle")
      label("n" i, i % 3 ? 8 : -8, i < 2 ? -8 : 18, "middle")
    }
    print "</svg>"
  }'
