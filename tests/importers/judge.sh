#!/bin/sh
# Where three.js and OpenCV themselves put points, with the cameras as files, into FOLDER/threejs.jsonl and opencv.jsonl.
#   sh judge.sh tests/importers/fixtures     writes the stored numbers anew, for git diff to show
#   sh judge.sh FOLDER three|opencv          only that judge's
# 77: a judge is not there (node, npm, the network, or python3-opencv).
set -eu
here=$(cd "$(dirname "$0")" && pwd)
folder=$(cd "$1" && pwd)
missing() {
  echo "skipped: $1"
  exit 77
}

if [ "${2-three}" = three ]; then
  for tool in node npm; do command -v $tool >/dev/null 2>&1 || missing "$tool is not installed"; done
  scratch=$(mktemp -d)
  trap 'rm -rf "$scratch"' EXIT
  (cd "$scratch" && npm install --silent --no-save three@0.187.0 >/dev/null 2>&1) ||
    missing "three.js cannot be fetched from npm"
  node "$here/threejs.mjs" "$scratch" >"$scratch/threejs.jsonl"
  mv "$scratch/threejs.jsonl" "$folder/threejs.jsonl"
fi
if [ "${2-opencv}" = opencv ]; then
  for python in python3 /usr/bin/python3 none; do
    [ $python != none ] || missing "python3-opencv is not installed"
    if $python -c 'import cv2' 2>/dev/null; then break; fi
  done
  $python "$here/opencv.py" >"$folder/opencv.jsonl.new"
  mv "$folder/opencv.jsonl.new" "$folder/opencv.jsonl"
fi
