#!/bin/sh
# The examples of every command's and every topic's help work as they stand, beside samples/, and `help COMMAND` is
# `COMMAND --help`.
#   sh examples.sh VIEWPROJ SAMPLES
set -eu
# shellcheck source=tests/cmd/limits.sh
. "$(dirname "$0")/limits.sh"
limit_memory "$1"
PATH=$(cd "$(dirname "$1")" && pwd):$PATH
export PATH
samples=$(cd "$2" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"

fail() {
  echo "$command: $1" >&2
  exit 1
}

ran=0
for command in $(viewproj --help | sed -n '/^Commands:/,/^$/s/^  \([a-z][a-z]*\) .*/\1/p'); do
  # Each in a folder of its own, so that what it writes is seen.
  mkdir "$work/of-$command"
  cd "$work/of-$command"
  ln -s "$samples" samples
  viewproj "$command" --help >../help
  viewproj help "$command" | cmp - ../help || fail 'help COMMAND says something else than COMMAND --help'
  sed '1,/^Examples*:$/d' ../help >../example
  grep -q "viewproj $command" ../example || fail 'the help ends with no example of the command'
  limited sh -e ../example >out 2>../err || fail "the example fails: $(cat ../example ../err)"
  if [ -s ../err ]; then fail "the example complains: $(cat ../err)"; fi
  if [ -z "$(find . -type f -size +0)" ]; then fail 'the example writes nothing'; fi
  ran=$((ran + 1))
done
for command in $(viewproj help | sed -n '/^Topics/,/^$/s/^  \([a-z][a-z]*\) .*/\1/p'); do
  mkdir "$work/of-$command"
  cd "$work/of-$command"
  ln -s "$samples" samples
  viewproj help "$command" | sed '1,/^Examples:$/d' >../example
  [ "$(grep -c 'viewproj' ../example)" = 2 ] || fail 'the page has not two examples'
  limited sh -e ../example >out 2>../err || fail "an example fails: $(cat ../example ../err)"
  if [ -s ../err ]; then fail "an example complains: $(cat ../err)"; fi
  [ -s out ] || fail 'the examples write nothing'
  ran=$((ran + 1))
done
command=viewproj
[ "$ran" -ge 19 ] || fail "only $ran commands are listed"
echo "$ran examples work"
