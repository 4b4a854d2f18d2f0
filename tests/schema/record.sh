#!/bin/sh
# Stands for viewproj on the PATH: runs $VIEWPROJ_TOOL, and keeps its arguments, input and output in $VIEWPROJ_RECORDED.
kept=$VIEWPROJ_RECORDED/$$
mkdir "$kept" || exit 1
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
