#!/bin/sh
# Makes the package of a release, build/viewproj_*.deb, from a tree of which every part of deep.sh has passed.
#   sh tests/checks/release.sh
set -eu
cd "$(dirname "$0")/../.."
lacking=$(sh tests/checks/deep.sh --list | sed -n 's/: has not passed$//p' | tr '\n' ' ')
[ -z "$lacking" ] || { echo "release: these parts of deep.sh have not passed on this tree: $lacking" >&2; exit 1; }
sh samples/setup.sh
(cd build && cpack)
