#!/bin/sh
# Where three.js and OpenCV themselves put points, with the cameras as files, into FOLDER/threejs.jsonl, opencv.jsonl and
# lenses.jsonl, of LENSES lenses.
#   sh judge.sh tests/importers/fixtures     writes the stored numbers anew, for git diff to show
#   sh judge.sh FOLDER three|opencv          only that judge's
# 77: a judge is not there (node, tests/node_modules, or python3-opencv); sh samples/setup.sh tests installs it.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
folder=$(cd "$1" && pwd)
missing() {
  echo "$1"
  exit 77
}

if [ "${2-three}" = three ]; then
  command -v node >/dev/null || missing "node is not installed"
  [ -d "$here/../node_modules/three" ] || missing "three.js is not in tests/node_modules"
  node "$here/threejs.mjs" >"$folder/threejs.jsonl.new"
  mv "$folder/threejs.jsonl.new" "$folder/threejs.jsonl"
fi
if [ "${2-opencv}" = opencv ]; then
  for python in python3 /usr/bin/python3 none; do
    [ $python != none ] || missing "python3-opencv is not installed"
    if $python -c 'import cv2' 2>/dev/null; then break; fi
  done
  $python "$here/opencv.py" >"$folder/opencv.jsonl.new"
  mv "$folder/opencv.jsonl.new" "$folder/opencv.jsonl"
  $python "$here/lenses.py" "${LENSES-60}" >"$folder/lenses.jsonl.new"
  mv "$folder/lenses.jsonl.new" "$folder/lenses.jsonl"
fi
