#!/bin/sh
# The checks that are more than ctest, one after the other, and the time each took. `sh samples/setup.sh checks` gets what
# they need.
#   sh tests/checks/run.sh [NAME...]
# CI=true runs a part of them, another after each commit, so that it ends within half an hour; LONG=1: all.
set -eu
cd "$(dirname "$0")/../.."
if [ $# -eq 0 ]; then
  set -- benchmark proofs static install sanitized coverage fuzz threads mutation platforms
  if [ "${CI-}" = true ] && [ "${LONG-}" != 1 ]; then
    turn=$(git rev-list --count HEAD 2>/dev/null || echo 0)
    case $((turn % 5)) in
      0) set -- benchmark proofs sanitized coverage ;;
      1) set -- benchmark proofs static install threads ;;
      2) set -- benchmark proofs static install fuzz ;;
      3) set -- benchmark proofs static mutation ;;
      4) set -- benchmark proofs static platforms ;;
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
