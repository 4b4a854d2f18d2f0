#!/bin/sh
# Stands in for viewproj where golden cases run, and keeps what it is given as seeds: in $SEEDS a folder for each target.
set -u
new=$SEEDS/new.$$
# seed TARGET...: keeps standard input for each, under a name made of its content.
seed() {
  head -c 4096 >"$new"
  for target; do
    mkdir -p "$SEEDS/$target"
    if [ -s "$new" ]; then cp "$new" "$SEEDS/$target/$(cksum <"$new" | tr ' ' '-')"; fi
  done
}
# What an argument stands for: JSON, or the content of a file.
content() {
  case $1 in
    '{'* | '['*) printf %s "$1" ;;
    *) if [ -f "${1%%#*}" ]; then head -c 4096 "${1%%#*}"; fi ;;
  esac
}
# records TARGET: standard input, and behind it two bytes that choose what is done with it.
records() {
  # shellcheck disable=SC2059  # one has an escape
  (cat && printf "$choice") | seed "$1"
}

# patches ARGUMENT...: options with their values, and --set assignments, each after a NUL.
patches() {
  open=
  for patch; do
    case $patch in
      --set) ;;
      --*) printf '\0%s' "$patch" && open=1 ;;
      [a-z]*=*) printf '\0%s' "$patch" && open= ;;
      -*) open= ;;
      *) if [ -n "$open" ]; then printf ' %s' "$patch"; fi ;;
    esac
  done
}

case ${1-} in ray) choice='?@' ;; cull) choice='?\200' ;; *) choice='!!' ;; esac
input=$SEEDS/input.$$
if [ -t 0 ]; then : >"$input"; else head -c 4096 >"$input"; fi
{
  for argument; do
    case $(content "$argument" | head -c 1 | tr -d '\0') in
      '{') content "$argument" | tr -d '\0' ;;
      *) printf %s "$argument" ;;
    esac
    printf '\0'
  done
  cat "$input"
} | seed arguments
for argument in "$input" "$@"; do
  text=$SEEDS/text.$$
  content "$argument" >"$text"
  case $(head -c 1 "$text" | tr -d '\0') in
    '{' | '[')
      records json <"$text"
      { cat "$text" && patches "$@"; } | seed camera
      seed camera scene model matrices <"$text"
      ;;
    [a-zA-Z\"%]) records csv <"$text" && seed camera matrices <"$text" ;;
    [-+.0-9#\ ]) records text <"$text" && records csv <"$text" && seed matrices <"$text" ;;
    *) records f64 <"$text" ;;
  esac
done
rm -f "$new" "$input" "$SEEDS/text.$$"
