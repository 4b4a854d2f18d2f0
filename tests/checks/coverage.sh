#!/bin/sh
# Which lines of lib and cmd the tests of sanitized.sh reach: those they do not, and the share of those they do.
#   sh tests/checks/coverage.sh [BUILD FOLDER]     build-sanitized, after sanitized.sh
# A comment "uncounted: WHY" says why a line is not among them; alone on a line, why all up to the next empty line are not.
# Functions that are consteval run in the compiler, and are not among them either.
# So are lines that are compiled for AVX-512 alone, where this processor lacks it.
# Less than this many percent of the lines is an error.
least=99.8
set -eu
cd "$(dirname "$0")/../.."
build=${1:-build-sanitized}
# Debian's LLVM has a number.
llvm() {
  tool=$1
  shift
  command -v "$tool" >/dev/null || tool=$tool-14
  "$tool" "$@"
}

ls "$build"/profiles/*.profraw >/dev/null 2>&1 || sh tests/checks/sanitized.sh "$build"
llvm llvm-profdata merge -sparse -o "$build/profile" "$build"/profiles/*.profraw
set -- "$build/viewproj"
for program in "$build"/*_tests; do set -- "$@" -object "$program"; done
llvm llvm-cov export -format=lcov -instr-profile "$build/profile" "$@" lib cmd 2>"$build/coverage.err" >"$build/coverage.lcov" || {
  cat "$build/coverage.err"
  exit 1
}
lacking='^$'
grep -qw avx512dq /proc/cpuinfo || lacking='^#if defined\\(__AVX512F__\\)'
awk -F '[:,]' -v root="$PWD/" -v least=$least -v lacking="$lacking" '
  # As ccache has it, the path goes by way of the build folder.
  $1 == "SF" { file = substr($0, 4); while (sub(/\/[^\/]+\/\.\.\//, "/", file)); if (index(file, root) == 1) file = substr(file, length(root) + 1) }
  $1 == "DA" && file ~ /^(lib|cmd)\// { if (!((file, $2) in runs)) { runs[file, $2] = 0; lines[file] = lines[file] " " $2 } runs[file, $2] += $3 }
  function readReasons(file,   line, number, span, inCompiler, isLacking) {
    for (number = 1; (getline line <file) > 0; ++number) {
      if (line ~ /^#/) isLacking = line ~ lacking
      if (isLacking) excused[file, number] = 1
      if (line == "") span = 0
      if (line ~ /^ *consteval /) { match(line, /^ */); inCompiler = line ~ /}$/ ? "" : "^" substr(line, 1, RLENGTH) "}"; excused[file, number] = 1 }
      if (inCompiler) excused[file, number] = 1
      if (inCompiler && line ~ inCompiler) inCompiler = ""
      if (line ~ /^ *\/\/ uncounted: /) span = 1
      if (span || line ~ /\/\/ uncounted: /) excused[file, number] = 1
    }
    close(file)
  }
  END {
    for (file in lines) {
      readReasons(file)
      part = substr(file, 1, 3)
      n = split(lines[file], at, " ")
      missed = ""
      count = 0
      for (i = 1; i <= n; ++i) {
        if ((file, at[i]) in excused) continue
        ++all[part]
        if (runs[file, at[i]] == 0) { missed = missed " " at[i]; ++count }
      }
      unreached[part] += count
      if (count) print file ":" missed | "sort"
    }
    close("sort")
    for (part in all) {
      total += all[part]
      missing += unreached[part]
      printf "%s: %d of %d lines reached, %.2f %%\n", part, all[part] - unreached[part], all[part], 100 - 100 * unreached[part] / all[part]
    }
    printf "all: %.2f %%, %d lines unreached\n", 100 - 100 * missing / total, missing
    if (!(total > 0 && 100 - 100 * missing / total >= least)) { print "less than " least " %"; exit 1 }
  }' "$build/coverage.lcov"
