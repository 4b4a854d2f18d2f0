#!/bin/sh
# The examples of every command's and every topic's help work as they stand, beside samples/, and give what they are there
# to show. `help COMMAND` is `COMMAND --help`.
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

# NAME: what its examples show, in what they print or write.
shows() {
  case $1 in
    project) pattern='"screen":\[687\.08[0-9]*,291\.25' ;;
    ray) pattern='"hit":{"id":0,"distance":9,' ;;
    cull) pattern='"cull":"inside"' ;;
    matrix) pattern='1\.7320508' ;;
    convert) pattern='camera_matrix: !!opencv-matrix' ;;
    check | mistakes) pattern='y-flipped' ;;
    info | camera) pattern='fovY  *60$' ;;
    footprint) pattern='^area  *[1-9]' ;;
    triangulate) pattern='1\.142857' ;;
    explain) pattern='screen.x .* 687\.08' ;;
    depth) pattern='0\.90009' ;;
    measure) pattern='matrix float32 .*[1-9]' ;;
    draw) pattern='<circle class="dot" cx="[0-9.]*" cy' ;;
    fit) pattern='"position": \[8\.6' ;;
    schema) pattern='"fovY"' ;;
    help) pattern='--fov-y' ;;
    points) pattern='"screen":\[4\.89' ;;
    conventions) pattern='0\.8660254' ;;
    formats) pattern='np\.array' ;;
    parts) pattern='"fovY": 50' ;;
    precision) pattern='"bound":[1-9]' ;;
    *) fail 'nobody has said what its examples show' ;;
  esac
  grep -rhq -e "$pattern" . || fail "its examples do not show $pattern: $(cat out)"
}

ran=0
for command in $(viewproj --help | sed -n '/^Usage:/,/^Topics/s/^  \([a-z][a-z]*\) .*/\1/p'); do
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
  shows "$command"
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
  shows "$command"
  ran=$((ran + 1))
done
command=viewproj
[ "$ran" -ge 19 ] || fail "only $ran commands are listed"
echo "$ran examples work"
