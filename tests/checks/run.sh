#!/bin/sh
# The checks that are more than ctest, one after the other, and the time each took. `sh samples/setup.sh checks` gets what
# they need.
#   sh tests/checks/run.sh [NAME...]
# Of the long ones CI=true runs a third, another after each commit; LONG=1 in the environment: all.
set -eu
cd "$(dirname "$0")/../.."
if [ $# -eq 0 ]; then
  set -- benchmark static install sanitized coverage fuzz threads mutation
  if [ "${CI-}" = true ] && [ "${LONG-}" != 1 ]; then
    turn=$(git rev-list --count HEAD 2>/dev/null || echo 0)
    case $((turn % 3)) in
      0) set -- benchmark static install sanitized coverage ;;
      1) set -- benchmark static install threads fuzz ;;
      2) set -- benchmark static install mutation ;;
    esac
  fi
fi

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
