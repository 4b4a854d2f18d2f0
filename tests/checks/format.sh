#!/bin/sh
# What reads the sources and builds nothing: the arrows between rooms, clang-format, shellcheck, cppcheck.
#   sh tests/checks/format.sh
set -eu
cd "$(dirname "$0")/../.."
# shellcheck source=tests/checks/sources.sh
. tests/checks/sources.sh
failed=""

echo "includes"
python3 -B tests/checks/includes.py || failed="$failed includes"

echo "clang-format"
# shellcheck disable=SC2046  # lists of names without blanks, here and below
clang-format --dry-run --Werror $(sources '*.cpp' '*.hpp' '*.inc') || failed="$failed clang-format"

echo "shellcheck"
# shellcheck disable=SC2046
shellcheck --external-sources .ci/run $(sources '*.sh') || failed="$failed shellcheck"

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
  --suppress='unreachableCode:*/system_posix.cpp' --suppress='syntaxError:*_source.inc' \
  --suppress=unmatchedSuppression -I lib -I cmd lib cmd || failed="$failed cppcheck"

[ -z "$failed" ] || { echo "failed:$failed"; exit 1; }
