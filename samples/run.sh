#!/bin/sh
# Runs setup.sh, then every sample, and shows each command and its result.
set -eu
cd "$(dirname "$0")"
sh setup.sh
PATH="$(cd .. && pwd)/build:$PATH"
export PATH
for sample in */; do
  printf '\n== %s\n' "${sample%/}"
  sed 's/^\([^#]\)/$ \1/' "$sample/cmd"
  (cd "$sample" && sh ./cmd)
done
