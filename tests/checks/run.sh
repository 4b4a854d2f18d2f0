#!/bin/sh
# The checks that are more than ctest, in turn, and the time each took. `sh samples/setup.sh checks` gets what they need.
#   sh tests/checks/run.sh [NAME...]
set -eu
cd "$(dirname "$0")/../.."
[ $# -gt 0 ] || set -- benchmark static sanitized coverage threads fuzz install mutation

times=""
failed=""
for name; do
  script=tests/checks/$name.sh
  echo "== $name"
  start=$(date +%s)
  sh "$script" || failed="$failed $name"
  times="$times $name $(($(date +%s) - start)) s,"
done
echo "== times:${times%,}"
[ -z "$failed" ] || { echo "failed:$failed"; exit 1; }
