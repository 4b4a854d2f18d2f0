#!/bin/sh
# Each public header compiles alone, twice, beside the macros that windows.h has, without exceptions, and with no warning; a
# user of all of them with exceptions too.
#   sh headers.sh HEADERS COMPILER...
set -eu
headers=$1
shift
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
status=0
count=0
for header in "$headers"/viewproj/*.hpp; do
  name=viewproj/$(basename "$header")
  printf '#define near\n#define far\n#include <%s>\n#include <%s>\n' "$name" "$name" >"$work/$(basename "$header" .hpp).cpp"
  count=$((count + 1))
done
cat >"$work/user.cpp" <<'END'
#include <viewproj/geodesy.hpp>
#include <viewproj/scene.hpp>
#include <viewproj/viewproj.hpp>

static_assert(VIEWPROJ_VERSION >= 100);
static_assert(viewproj::conventions::d3d == viewproj::conventionPreset("d3d"));

// Without exceptions, and with braces for vectors.
double user() {
  using namespace viewproj;
  const auto pose = tryLookAt({3, 2, 5}, {0, 0, 0}, {0, 1, 0}, Handedness::right);
  const auto lens = tryPerspectiveFovY(60, 1.5, 0.1, kInfiniteFar);
  if (!pose || !lens) return 0;
  const auto camera = tryMakeCamera(*pose, *lens, {.width = 600, .height = 400}, conventions::opengl);
  if (!camera) return static_cast<double>(camera.fault().message.size());
  return worldToScreen(*camera, {1, 1, 1}).x + worldToScreen(*camera, {1, 1, 1, 0}).x + camera->pose().eye().x;
}
END
for compiler; do
  for source in "$work"/*.cpp; do
    for exceptions in -fno-exceptions -fexceptions; do
      if [ $exceptions = -fexceptions ] && [ "$source" != "$work/user.cpp" ]; then continue; fi
      "$compiler" -std=c++20 -fsyntax-only -Wall -Wextra -Wconversion -Wshadow -Werror "$exceptions" -I"$headers" "$source" || {
        echo "$compiler $exceptions: $(basename "$source" .cpp)"
        status=1
      }
    done
  done
done
[ "$status" -ne 0 ] || echo "$count headers compile alone, and users without exceptions"
exit $status
