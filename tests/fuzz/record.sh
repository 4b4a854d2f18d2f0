#!/bin/sh
# Stands in for viewproj where golden cases run, and keeps what it is given as seeds of the fuzz targets: in $SEEDS a
# folder for each target. Prints nothing.
set -u
most=4096

# seed TARGET: keeps standard input, under a name made of its content.
seed() {
  mkdir -p "$SEEDS/$1"
  head -c "$most" >"$SEEDS/new.$$"
  if [ -s "$SEEDS/new.$$" ]; then mv "$SEEDS/new.$$" "$SEEDS/$1/$(cksum <"$SEEDS/new.$$" | tr ' ' '-')"; fi
  rm -f "$SEEDS/new.$$"
}

# What an option's value stands for: JSON, or the content of a file.
content() {
  case $1 in
    '{'* | '['*) printf %s "$1" ;;
    -) cat "$SEEDS/input.$$" ;;
    *) if [ -f "${1%%#*}" ]; then head -c "$most" "${1%%#*}"; fi ;;
  esac
}

# The form of a stream by its first bytes, and two choices for the target behind it.
records() {
  content "$1" >"$SEEDS/records.$$"
  case $1 in
    *.csv) form=csv ;;
    *.f64) form=f64 ;;
    *) case $(head -c 1 "$SEEDS/records.$$" | tr -d '\0') in
      '{' | '[') form=json ;;
      [a-z\"]*) form=csv ;;
      '') form=f64 ;;
      *) form=text ;;
    esac ;;
  esac
  choice='!!'
  if [ "$command" = ray ]; then choice='?@'; fi
  if [ "$command" = cull ]; then choice='?\200'; fi
  # shellcheck disable=SC2059  # the choice has an escape
  (cat "$SEEDS/records.$$" && printf "$choice") | seed "$form"
  rm -f "$SEEDS/records.$$"
}

command=${1-}
: >"$SEEDS/input.$$"
if [ ! -t 0 ]; then head -c "$most" >"$SEEDS/input.$$"; fi
# A file becomes its content where that will do.
(
  for argument in "$@"; do
    if [ -f "${argument%%#*}" ] && [ "$(head -c 1 "${argument%%#*}" | tr -d '\0')" = '{' ]; then
      content "$argument" | tr -d '\0'
    else
      printf %s "$argument"
    fi
    printf '\0'
  done
  cat "$SEEDS/input.$$"
) | seed arguments
sets=
file=-
while [ $# -gt 1 ]; do
  shift
  case $1 in
    --camera | -c | --scene | --model)
      if [ $# -gt 1 ]; then
        case $1 in
          --scene) content "$2" | seed scene ;;
          --model) content "$2" | seed model ;;
          *) content "$2" >"$SEEDS/camera.$$" ;;
        esac
        shift
      fi
      ;;
    --*) # an option of a camera's field patches it as --set does
      if [ "$1" = --set ]; then patch=${2-}; else patch="$1 ${2-}"; fi
      sets="$sets${sets:+
}$patch"
      ;;
    *) if [ -f "${1%%#*}" ]; then file=$1; fi ;;
  esac
done
case $command in
  inspect) content "$file" | seed matrices ;;
  matrix | depth) if [ ! -f "$SEEDS/camera.$$" ]; then content "$file" >"$SEEDS/camera.$$"; fi ;;
  *) records "$file" ;;
esac
if [ -f "$SEEDS/camera.$$" ]; then
  seed camera <"$SEEDS/camera.$$"
  if [ -n "$sets" ]; then
    (cat "$SEEDS/camera.$$" && printf '%s\n' "$sets" | while read -r line; do printf '\0%s' "$line"; done) | seed camera
  fi
fi
rm -f "$SEEDS/camera.$$" "$SEEDS/input.$$"
