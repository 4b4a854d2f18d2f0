#!/bin/sh
# The public headers, twice, beside the macros that windows.h has, and a user of them, with no warning of any compiler. (That each compiles alone the build shows: headers_compile_alone.)
#   sh headers.sh HEADERS COMPILER...
set -eu
headers=$1
shift
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
{
  printf '#define near\n#define far\n'
  for time in once again; do
    for header in "$headers"/viewproj/*.hpp; do echo "#include <viewproj/$(basename "$header")>  // $time"; done
  done
  cat <<'END'

static_assert(VIEWPROJ_VERSION >= 100);
static_assert(viewproj::conventions::d3d == viewproj::findPreset("d3d")->convention);

// With braces for vectors.
double user() {
  using namespace viewproj;
  const Pose pose = lookAt({3, 2, 5}, {0, 0, 0}, {0, 1, 0}, Handedness::right);
  const Projection lens = perspective(60, Aspect(3, 2), 0.1);
  const Camera camera = makeCamera(pose, lens, {.width = 600, .height = 400}, conventions::opengl);
  return worldToScreen(camera, {1, 1, 1}).x + worldToScreen(camera, {1, 1, 1, 0}).x + camera.pose().eye().x;
}
END
} >"$work/user.cpp"
status=0
for compiler; do
  "$compiler" -std=c++20 -fsyntax-only -Wall -Wextra -Wconversion -Wshadow -Werror -I"$headers" "$work/user.cpp" || {
    echo "$compiler"
    status=1
  }
done
[ "$status" -ne 0 ] || echo "the headers compile"
exit $status
