#!/bin/sh
# Stands for viewproj on the PATH: runs $VIEWPROJ_TOOL, and keeps its arguments, input and output in $VIEWPROJ_RECORDED.
kept=$(mktemp -d "$VIEWPROJ_RECORDED/XXXXXXXX") || exit 1
pwd >"$kept/cwd"
printf '%s\0' "$@" >"$kept/args"
tee "$kept/in" 2>/dev/null | {
  "$VIEWPROJ_TOOL" "$@"
  echo $? >"$kept/status"
} | tee "$kept/out"
exit "$(cat "$kept/status")"
