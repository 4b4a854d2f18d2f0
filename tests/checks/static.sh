#!/bin/sh
# What reads the sources and runs nothing: the includes (layers.py), clang-format, shellcheck, cppcheck, clang-tidy. (Both compilers' warnings are
# errors where the tests are built: .ci/run with g++, sanitized.sh with clang++.)
#   sh tests/checks/static.sh [BUILD FOLDER]     build-static, for the compile commands alone
# clang-tidy reads lib and cmd, whose headers the tests include; the tests themselves would cost as much again.
set -eu
cd "$(dirname "$0")/../.."
build=${1:-build-static}
failed=""
# Files as Git knows them; without Git, all.
files() {
  git ls-files --cached --others --exclude-standard "$@" 2>/dev/null || {
    for pattern; do find .ci cmd lib samples tests -name node_modules -prune -o \( -path "*/$pattern" -o -name "$pattern" \) -print; done
  }
}
# None is passed over for want of a list.
for pattern in 'lib/*.cpp' 'cmd/*.cpp' 'tests/*.cpp' '*.sh'; do
  count=$(files "$pattern" | wc -l)
  [ "$count" -ge 20 ] || { echo "only $count files $pattern" >&2; exit 1; }
done

echo "layers"
python3 -B tests/checks/layers.py || failed="$failed layers"

echo "clang-format"
# shellcheck disable=SC2046  # lists of names without blanks, here and below
clang-format --dry-run --Werror $(files '*.cpp' '*.hpp' '*.inc') || failed="$failed clang-format"

echo "shellcheck"
# shellcheck disable=SC2046
shellcheck --external-sources .ci/run $(files '*.sh') || failed="$failed shellcheck"

echo "cppcheck"
# Not heard:
#   missingReturn          it does not know that members called fail are [[noreturn]]; the compilers do
#   noExplicitConstructor  a double is a double-double, and every other kind of number here
#   shadowFunction         a local may be named as a function is that is not meant there
#   unusedStructMember     it looks at one source at a time
#   useStlAlgorithm        a loop may be the plainer of the two
#   uninitMemberVar        the terms of an expansion are those that are counted
#   legacyUninitvar        it overlooks the initialisers of arrays of pointers
#   unreadVariable         the last row of a table written by a macro shifts a bit that no row follows
#   unassignedVariable     it overlooks constructors
#   unreachableCode        raise() returns where nothing comes of it
#   syntaxError            the kernels' lambdas have template parameters, which it cannot read
cppcheck --enable=warning,performance,portability,style --std=c++20 --language=c++ -j "$(nproc)" --quiet --error-exitcode=1 \
  --inline-suppr --suppress=missingReturn --suppress=noExplicitConstructor --suppress=shadowFunction \
  --suppress=unusedStructMember --suppress=useStlAlgorithm --suppress='uninitMemberVar:*/expansion.hpp' \
  --suppress='legacyUninitvar:*/pose_*.cpp' --suppress='unreadVariable:*/kernels/*' --suppress='unassignedVariable:*/block_reader.cpp' \
  --suppress='unreachableCode:*/system_posix.cpp' --suppress='syntaxError:*/kernel_source.inc' \
  --suppress=unmatchedSuppression -I lib -I cmd lib cmd || failed="$failed cppcheck"

echo "clang-tidy"
cmake -S . -B "$build" -DCMAKE_CXX_COMPILER=clang++ >/dev/null
# The large ones first. The kernels of later processors are those of this one.
# CI=true: a third of them, others at each commit.
share=1
if [ "${CI-}" = true ] && [ "${LONG-}" != 1 ]; then share=3; fi
turn=$(git rev-list --count HEAD 2>/dev/null || echo 0)
files 'lib/*.cpp' 'cmd/*.cpp' | grep -v -e kernel_v -e system_windows | xargs wc -c | grep -v ' total$' | sort -rn |
  awk -v share=$share -v turn="$turn" '(NR + turn) % share == 0 { print $2 }' |
  xargs -P "$(nproc)" -n 4 clang-tidy --quiet -p "$build" 2>"$build/counts" || {
  sed '/warnings\{0,1\} \(generated\|treated\)/d' "$build/counts"
  failed="$failed clang-tidy"
}

[ -z "$failed" ] || { echo "failed:$failed"; exit 1; }
