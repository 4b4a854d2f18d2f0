#!/bin/sh
# Arithmetic that is not IEEE's is refused: by the headers where a compiler tells, by the command where it begins.
#   sh arithmetic.sh VIEWPROJ LIBRARY_TO_PRELOAD HEADERS COMPILER...
set -eu
tool=$1
preloaded=$2
headers=$3
shift 3
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
status=0
wrong() {
  echo "$1"
  status=1
}

cat >"$work/sum.cpp" <<'END'
#include <numbers/double_double.hpp>
int main(int count, char**) {
  volatile double one = count, small = 0x1p-60, smaller = 0x1p-110;
  const viewproj::detail::DoubleDouble sum = viewproj::detail::DoubleDouble(one, small) + viewproj::detail::DoubleDouble(-one, smaller);
  return viewproj::detail::twoSum(one, small).lo == small && sum.hi == 0x1p-60 + 0x1p-110 ? 0 : 1;
}
END

# refused COMPILER FLAGS...: by an #error of ours.
refused() {
  if "$@" -std=c++20 -I"$headers" -fsyntax-only "$work/sum.cpp" 2>"$work/errors"; then return 1; fi
  grep -q 'error.*viewproj needs' "$work/errors"
}
# strict COMPILER FLAGS...: compiles, and has the right sums.
strict() { "$@" -std=c++20 -ffp-contract=off -I"$headers" -O2 "$work/sum.cpp" -o "$work/sum" && "$work/sum"; }

for compiler; do
  strict "$compiler" || wrong "$compiler is refused, or wrong"
  strict "$compiler" -frounding-math -fno-trapping-math || wrong "$compiler -frounding-math is refused, or wrong"
  flags="-ffast-math -Ofast -ffinite-math-only"
  if "$compiler" -mfpmath=387 -dM -E -x c++ /dev/null 2>/dev/null | grep -q '__FLT_EVAL_METHOD__ 2'; then
    flags="$flags -mfpmath=387"
  fi
  for flag in $flags; do
    refused "$compiler" "$flag" || wrong "$compiler $flag is not refused"
  done
  # Where the compiler does not tell, the headers are right all the same.
  for flags in -funsafe-math-optimizations '-fassociative-math -fno-signed-zeros -fno-trapping-math' -freciprocal-math; do
    # shellcheck disable=SC2086  # words
    refused "$compiler" $flags || strict "$compiler" $flags || wrong "$compiler $flags is neither refused nor right"
  done
done

# The preloaded library comes first, whatever a sanitizer says.
export ASAN_OPTIONS="${ASAN_OPTIONS-}:verify_asan_link_order=0"
modes="upward downward zero"
case $(uname -m) in x86_64) modes="$modes flush denormals" ;; esac
for mode in $modes; do
  code=0
  said=$(VIEWPROJ_ARITHMETIC=$mode LD_PRELOAD=$preloaded "$tool" --version 2>&1) || code=$?
  case $code:$said in
    1:"viewproj: floating-point arithmetic "*here) ;;
    *) wrong "$mode: status $code, '$said'" ;;
  esac
done
VIEWPROJ_ARITHMETIC=nearest LD_PRELOAD=$preloaded "$tool" --version >/dev/null || wrong 'nearest is refused'
[ "$status" -ne 0 ] || echo 'only IEEE arithmetic is taken'
exit $status
