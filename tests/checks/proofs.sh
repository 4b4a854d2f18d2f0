#!/bin/sh
# Proves the error bounds of standard, and what exact certifies: Gappa runs the scripts of tests/proofs with
# the constants that the headers have now.
#   sh tests/checks/proofs.sh [NAME...]     some scripts, such as dot
# In a script "#: RUN: DEFINITIONS" is a run with these definitions, and "#! RUN: NAME = VALUE" the same run with another
# value of one of them, or of a constant, which must not be proved. Each run has one at least: premises that contradict
# each other would prove anything.
set -eu
cd "$(dirname "$0")/../.."
headers="lib/projection/kernels/error_model.hpp lib/projection/kernels/formulas.hpp lib/viewproj/screen.hpp"
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
status=0
proofs=0
controls=0
fail() {
  echo "proofs.sh: $*" >&2
  status=1
}

# What Gappa says to the definitions, on standard input, and the script: nothing of what it has proved. An identity that
# does not hold and a name without a definition are warnings. Without searching for cases, which no script needs.
gappa_says() {
  cat - "$1" >"$folder/whole"
  timeout 60 gappa -Eno-auto-dichotomy "$folder/whole" >"$folder/words" 2>&1 || [ -s "$folder/words" ] || echo 'it failed'
  sed '/^Warning: renaming identifier/d; /^Warning: maximum number of iterations/d' "$folder/words"
}

# shellcheck disable=SC2086  # a list of words
sed -n -e 's/^inline constexpr double \(k[A-Za-z]*\) = \([^;]*\);.*/\1 = \2;/p' \
  -e 's/^  static constexpr double \(k[A-Za-z]*\) = \([^;?]*\);.*/\1 = \2;/p' $headers >"$folder/constants"
[ $# -gt 0 ] || set -- tests/proofs/*.g
for script; do
  name=$(basename "$script" .g)
  script=tests/proofs/$name.g
  sed -n 's/^#: //p' "$script" >"$folder/runs"
  [ -s "$folder/runs" ] || fail "$name has no run"
  while IFS=: read -r run definitions; do
    { cat "$folder/constants"; echo "$definitions" | tr ';' '\n' | sed -n 's/^ *\(.*[^ ]\)/\1;/p'; } >"$folder/definitions"
    words=$(gappa_says "$script" <"$folder/definitions")
    proofs=$((proofs + 1))
    [ -z "$words" ] || fail "$name, $run, is not proved: $words"
    sed -n "s/^#! $run: //p" "$script" >"$folder/controls"
    [ -s "$folder/controls" ] || fail "$name, $run, has no control"
    while read -r control; do
      constant=${control%% *}
      grep -q "^$constant = " "$folder/definitions" || fail "$name, $run: there is no $constant"
      words=$(sed "s/^$constant = .*/$control;/" "$folder/definitions" | gappa_says "$script")
      controls=$((controls + 1))
      case $words in
        'Error: some properties were not satisfied'* | 'Error: no contradiction was found'*) ;;
        *) fail "$name, $run, with $control: ${words:-proved, and should not be}" ;;
      esac
    done <"$folder/controls"
  done <"$folder/runs"
done
echo "$proofs proofs, and $controls controls"
exit "$status"
