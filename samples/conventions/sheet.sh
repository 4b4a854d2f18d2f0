#!/bin/sh
# The conventions side by side, with what differs from opengl in vermilion: a camera's view volume with NDC at its corners,
# view space at the eye, the world beside it.
#   sh sheet.sh > conventions.svg
# Every number in it comes from viewproj; awk only draws the lines.
set -eu

# place RIGHT UP FORWARD: prints that place of the camera in the usual world of $preset.
place() {
  case $preset in
    opengl-lh | d3d | unity) frame='1 0 0  0 1 0  0 0 1' ;;
    unreal) frame='0 1 0  0 0 1  1 0 0' ;;
    opencv | ps2) frame='1 0 0  0 -1 0  0 0 1' ;;
    *) frame='1 0 0  0 1 0  0 0 -1' ;;
  esac
  echo "$frame $*" | awk '{ for (i = 1; i <= 3; ++i) printf "%s%g", (i > 1 ? "," : ""), $10 * $i + $11 * $(i + 3) + $12 * $(i + 6) }'
}
camera() {  # camera EYE DIRECTION FOVY NEAR FAR WIDTH HEIGHT
  printf '{"convention": "%s", "position": [%s], "direction": [%s], "up": [%s],
    "projection": {"type": "perspective", "fovY": %s, "near": %s, "far": %s},
    "viewport": {"width": %s, "height": %s, "pixelCenter": 0.5}}' "$preset" "$1" "$2" "$(place 0 1 0)" "$3" "$4" "$5" "$6" "$7"
}

# Prints NAME,TEXT,X,Y,Z: the corners n0 to n3 and f0 to f3 around the picture from its top left, and the axes' ends.
points() {
  echo name,text,x,y,z
  for distance in 1 3; do
    for corner in 0,0 300,0 300,200 0,200; do echo "{\"pixel\":[$corner],\"viewDistance\":$distance}"; done
  done | viewproj ray -c "$seen" --to csv | awk -F, 'NR == 1 { print "x,y,z" } NR > 1 { print $10 "," $11 "," $12 }' |
    viewproj project -c "$seen" --fields ndc |
    awk -F, 'NR > 1 { printf "%s%d,%.3g %.3g %.3g,%s,%s,%s\n", NR < 6 ? "n" : "f", (NR - 2) % 4, $4, $5, $6, $1, $2, $3 }'
  echo "eye,,$(place 0 0 0)"
  # The columns of the view's inverse: where view x, y and z point.
  viewproj matrix -c "$seen" --which view --inverse --to glsl |
    awk '/viewInverse/ { inside = 1; next } inside && n < 3 { gsub(/[, ]+/, " "); print "v" n++ ",view " substr("xyz", n, 1) "," .6 * $1 "," .6 * $2 "," .6 * $3 }'
  place -1.85 0.72 -0.4 | awk -F, '{
    print "world,," $1 "," $2 "," $3
    for (i = 1; i <= 3; ++i) print "w" i - 1 ",world " substr("xyz", i, 1) "," $1 + .5 * (i == 1) "," $2 + .5 * (i == 2) "," $3 + .5 * (i == 3) }'
}

for preset in opengl opengl-lh d3d d3d-rh vulkan metal webgpu unity unreal opencv ps2; do
  seen=$(camera "$(place 0 0 0)" "$(place 0 0 1)" 44 1 3 300 200)
  from=$(camera "$(place 6.2 3.1 -3.2)" "$(place -6.4 -3.1 4.6)" 28 0.1 100 720 430)
  # The description of the convention in the comments of `viewproj matrix`: its clauses, a line each.
  viewproj matrix -c "$seen" --which projection --to c | sed -n "s|^/\* \(.*\)\. \*/\$|\1|p" | tr ';' '\n' | sed "s/^ */$preset,words,/"
  points | viewproj project -c "$from" --fields screen,visible | sed "1d; s/^/$preset,/"
done | awk -F, '
  function style(differs) { return differs ? " differs" : "" }
  function line(from, to) { return sprintf("M%.1f %.1fL%.1f %.1f", x[from], y[from], x[to], y[to]) }
  function face(side) {
    return sprintf("<path class=\"%s\" d=\"M%.1f %.1fL%.1f %.1fL%.1f %.1fL%.1f %.1fz\"/>\n", side,
      x[side 0], y[side 0], x[side 1], y[side 1], x[side 2], y[side 2], x[side 3], y[side 3])
  }
  function label(name, toX, toY, differs) {
    printf "<text class=\"label%s\" x=\"%.1f\" y=\"%.1f\">%s</text>\n", style(differs), x[name] + toX, y[name] + toY, text[name]
  }
  # The view volume: where all conventions put it, once.
  function volume(   i, edges, rays, drawn) {
    for (i = 0; i < 4; ++i) { edges = edges line("n" i, "f" i); rays = rays line("eye", "n" i) }
    drawn = face("f") "<path class=\"edge\" d=\"" edges "\"/>\n<path class=\"ray\" d=\"" rays "\"/>\n" face("n")
    if (drawn == ofOpengl["volume"]) { print "<use href=\"#volume\"/>"; return }
    if (preset == "opengl") ofOpengl["volume"] = drawn
    printf "<g%s>\n%s</g>\n", preset == "opengl" ? " id=\"volume\"" : "", drawn
  }
  # An axis differs where its end does.
  function axes(from, names,   i, far, differs) {
    for (i = 0; i < 3; ++i) {
      differs = (x[names i] - ofOpengl["x" names i]) ^ 2 + (y[names i] - ofOpengl["y" names i]) ^ 2 > 1
      printf "<path class=\"axis%s\" d=\"%s\"/>", style(differs), line(from, names i)
      far = sqrt((x[names i] - x[from]) ^ 2 + (y[names i] - y[from]) ^ 2)
      label(names i, 32 * (x[names i] - x[from]) / far, 20 * (y[names i] - y[from]) / far + 7, differs)
    }
  }
  function panel(   i) {
    printf "<svg x=\"%d\" y=\"%d\" width=\"400\" height=\"290\" viewBox=\"-16 0 720 522\">\n", 10 + 400 * (panels % 3), 60 + 300 * int(panels / 3)
    printf "<rect class=\"panel\" x=\"-12\" y=\"3\" width=\"708\" height=\"516\"/><text class=\"name\" x=\"4\" y=\"36\">%s</text>\n", preset
    volume()
    axes("eye", "v")
    axes("world", "w")
    for (i = 0; i < 4; ++i) {
      label("f" i, i == 3 ? 40 : 8, i < 2 ? -10 : i == 2 ? 28 : 8, text["f" i] != ofOpengl["f" i])
      label("n" i, i == 3 ? 6 : i == 2 ? 46 : i ? 26 : -26, i < 2 ? -14 : i == 2 ? 26 : 78, text["n" i] != ofOpengl["n" i])
    }
    printf "<text>"
    for (i = 0; i < clauses; ++i)
      printf "<tspan class=\"words%s\" x=\"4\" y=\"%d\">%s</tspan>", style(words[i] != ofOpengl["words" i]), 408 + 24 * i, words[i]
    print "</text>\n</svg>"
    ++panels
  }
  $1 != preset { if (preset) panel(); preset = $1; clauses = 0 }
  $2 == "words" {
    words[clauses] = $3; for (i = 4; i <= NF; ++i) words[clauses] = words[clauses] "," $i
    if (preset == "opengl") ofOpengl["words" clauses] = words[clauses]
    ++clauses
    next
  }
  $9 != "true" { print preset ": " $2 " is not in the picture" >"/dev/stderr"; failed = 1; exit 1 }
  {
    text[$2] = $3; x[$2] = $7; y[$2] = $8
    if (preset == "opengl") { ofOpengl[$2] = $3; ofOpengl["x" $2] = $7; ofOpengl["y" $2] = $8 }
  }
  BEGIN {
    print "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 1220 1270\" font-family=\"Helvetica, Arial, DejaVu Sans, sans-serif\">"
    print "<title>Eleven conventions: the same camera in each, and what differs from opengl</title>"
    print "<style>.ground{fill:#fff}.panel{fill:none;stroke:#d5dbe1}text{fill:#1d2733;font-size:19px;paint-order:stroke;stroke:#fff;stroke-width:4px}" \
      ".title{font-size:20px;font-weight:600}.name{font-weight:600;font-size:26px}.label{text-anchor:middle}.words{fill:#4a5663}" \
      "text.differs,.words.differs,.mark{fill:#b93a08;font-weight:600}.f,.n{fill:#4477aa;fill-opacity:.1;stroke:#4477aa}.n{fill-opacity:.3}.edge{stroke:#4477aa}" \
      ".ray{stroke:#4477aa;stroke-dasharray:4 4}.axis{stroke:#1d2733;stroke-width:3.5;marker-end:url(#tip)}.axis.differs{stroke:#c2410c}#tip{fill:context-stroke}" \
      "@media(prefers-color-scheme:dark){.ground{fill:#12181f}.panel{stroke:#33404d}text{fill:#e6edf3;stroke:#12181f}.words{fill:#9aa7b4}" \
      "text.differs,.words.differs,.mark{fill:#ffa37c}.f,.n{fill:#7fb0e0;stroke:#7fb0e0;fill-opacity:.12}.n{fill-opacity:.3}.edge,.ray{stroke:#7fb0e0}.axis{stroke:#e6edf3}.axis.differs{stroke:#ff8a57}}</style>"
    print "<marker id=\"tip\" viewBox=\"0 0 8 8\" refX=\"6\" refY=\"4\" markerWidth=\"4\" markerHeight=\"4\" orient=\"auto\"><path d=\"M0 0L8 4L0 8z\"/></marker>"
    print "<rect class=\"ground\" width=\"1220\" height=\"1270\"/><text class=\"title\" x=\"12\" y=\"36\">The same camera in eleven conventions, " \
      "and <tspan class=\"mark\">what differs from opengl</tspan></text>"
  }
  END {
    if (failed) exit 1
    panel()
    print "</svg>"
  }'
