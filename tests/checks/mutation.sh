#!/bin/sh
# Whether the tests would notice: the rows of mutations/*.txt, each a small bug, are built into a copy of the sources behind
# one switch, and the tests run under each. tests/README.md says how a row is written.
#   sh tests/checks/mutation.sh                 as many as five minutes allow, another choice at each commit
#   sh tests/checks/mutation.sh --all           every one (ALL=1 in the environment: the same)
#   sh tests/checks/mutation.sh NAME...         these
#   sh tests/checks/mutation.sh --named ...     by the tests that the rows name alone, which takes minutes
#   sh tests/checks/mutation.sh --list          checks that each row's text stands in its file, once
set -eu
cd "$(dirname "$0")/../.."
[ "${ALL-}" != 1 ] || set -- --all "$@"
exec python3 -B tests/checks/mutations/run.py "$@"
