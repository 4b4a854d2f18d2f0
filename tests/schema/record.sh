#!/bin/sh
# Stands for viewproj on the PATH: runs $VIEWPROJ_TOOL, and keeps its arguments, input and output in $VIEWPROJ_RECORDED.
kept=$VIEWPROJ_RECORDED/$$
while ! mkdir "$kept" 2>/dev/null; do
  [ -d "$kept" ] || exit 125  # nothing can be kept
  kept=$kept-  # a process of before had that number
done
echo "$PWD" >"$kept/cwd"
printf '%s\0' "$@" >"$kept/args"
run() {
  "$VIEWPROJ_TOOL" "$@"
  echo $? >"$kept/status"
}
# Most read nothing.
if [ -c /dev/stdin ]; then
  : >"$kept/in"
  run "$@"
else
  tee "$kept/in" 2>/dev/null | run "$@"
fi | tee "$kept/out"
read -r status <"$kept/status"
exit "$status"
