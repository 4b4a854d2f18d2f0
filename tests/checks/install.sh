#!/bin/sh
# Installs the project like any other tool, three ways, and uses what was installed: the command, the manual page, and
# the library by way of tests/install, a ten-line program.
#   sh tests/checks/install.sh [BUILD [CLEAN]]
# BUILD is a build folder; build/ by default, or build-install/, which is made. `cmake --install` and the Debian package
# are checked always. CLEAN is a folder with a bare Debian 12, made by debootstrap if it is not there: the package is
# installed in it (as root). Without CLEAN that is left out.
set -eu
cd "$(dirname "$0")/../.."
source=$(pwd)

fail() {
  echo "install: $1" >&2
  exit 1
}

for tool in cmake cpack dpkg-deb dpkg-shlibdeps lintian mandoc pkg-config file; do
  command -v "$tool" >/dev/null || fail "$tool is not installed; sh samples/setup.sh checks installs it"
done

build=${1:-build}
if [ ! -f "$build/CMakeCache.txt" ]; then
  build=${1:-build-install}
  cmake -B "$build" >/dev/null
fi
build=$(cd "$build" && pwd)
cmake --build "$build" --parallel "$(nproc)" --target viewproj libviewproj_cameras_of libviewproj_scene libviewproj_geodesy >/dev/null
version=$(sed -n 's/^project(viewproj VERSION \([0-9.]*\).*/\1/p' CMakeLists.txt)

work=$(mktemp -d)
mounted=""
finish() {
  for folder in $mounted; do umount "$folder"; done
  rm -rf "$work"
}
trap finish EXIT
trap 'exit 1' HUP INT TERM

# The files of an installation, below its prefix.
expect_files() {
  for pattern in bin/viewproj 'lib*/libviewproj.a' 'lib*/libviewproj_cameras_of.a' 'lib*/libviewproj_scene.a' 'lib*/libviewproj_geodesy.a' include/viewproj/viewproj.hpp 'lib*/cmake/viewproj/viewprojConfig.cmake' \
    'lib*/cmake/viewproj/viewprojConfigVersion.cmake' 'lib*/cmake/viewproj/viewproj-targets.cmake' 'lib*/pkgconfig/viewproj.pc' \
    share/man/man1/viewproj.1.gz share/bash-completion/completions/viewproj share/doc/viewproj/README.md share/doc/viewproj/copyright share/doc/viewproj/changelog.gz \
    share/doc/viewproj/samples/picking-a-pixel/camera.json; do
    # Libraries may lie in a folder of the architecture's name.
    found=$(find "$1" -path "$1/$pattern" -o -path "$1/$(echo "$pattern" | sed 's,lib\*/,lib/*/,')")
    [ -n "$found" ] || fail "no $pattern is installed"
  done
  if [ -e "$1/include/numbers" ]; then fail 'internal headers are installed'; fi
  strays=$(cd "$1" && find . -type f ! -path './bin/viewproj' ! -path './lib/*' ! -path './include/viewproj/*.hpp' \
    ! -path './share/man/man1/viewproj.1.gz' ! -path './share/doc/viewproj/*' ! -path './share/bash-completion/completions/viewproj' \
    ! -path './share/lintian/overrides/viewproj')
  [ -z "$strays" ] || fail "what is this doing here: $strays"
  if grep -rlF -e "$source" -e "$build" "$1"; then fail 'these name folders of the build'; fi
}

# What the camera of samples/picking-a-pixel sees, said by the tool and by the program.
expected="$(printf '687.0855266374657 291.25547058761947, the equator at 6378137 m')"
expect_output() {
  [ "$2" = "$expected" ] || fail "$1 prints '$2' and not '$expected'"
}
use_tool() {
  [ "$("$@" --version)" = "viewproj $version" ] || fail "$* --version says $("$@" --version)"
  seen=$("$@" project -c "$(cat samples/picking-a-pixel/camera.json)" --point 1,1,1 --fields screen)
  [ "$seen" = '{"position":[1,1,1],"screen":[687.0855266374657,291.25547058761947]}' ] || fail "$* project says $seen"
}

echo '== cmake --install'
cmake --install "$build" --prefix "$work/first" >/dev/null
mv "$work/first" "$work/prefix" # what is installed can be moved
expect_files "$work/prefix"
use_tool "$work/prefix/bin/viewproj"
cmake -S tests/install -B "$work/consumer" -DCMAKE_PREFIX_PATH="$work/prefix" >/dev/null
cmake --build "$work/consumer" >/dev/null
expect_output 'the program of tests/install' "$("$work/consumer/consumer")"
# The core alone, where there is no GeographicLib.
cmake -S tests/install -B "$work/core" -DCMAKE_PREFIX_PATH="$work/prefix" -DPART=viewproj \
  -DCMAKE_FIND_ROOT_PATH=/nowhere -DCMAKE_FIND_ROOT_PATH_MODE_LIBRARY=ONLY -DCMAKE_FIND_ROOT_PATH_MODE_INCLUDE=ONLY >/dev/null
cmake --build "$work/core" >/dev/null
[ "$("$work/core/consumer")" = "${expected%,*}" ] || fail "the program of the core prints '$("$work/core/consumer")'"
if nm "$work/core/consumer" | grep -q GeographicLib; then fail 'a program of the core holds GeographicLib'; fi
PKG_CONFIG_PATH=$(dirname "$(find "$work/prefix" -name viewproj.pc)")
export PKG_CONFIG_PATH
# shellcheck disable=SC2046  # a list of words
"${CXX:-c++}" -std=c++20 tests/install/main.cpp -o "$work/by-pkg-config" $(pkg-config --cflags --libs viewproj-geodesy)
expect_output 'the program built by pkg-config' "$("$work/by-pkg-config")"
# shellcheck disable=SC2046
"${CXX:-c++}" -std=c++20 tests/install/core.cpp -o "$work/core-by-pkg-config" $(pkg-config --cflags --libs viewproj)
case $(pkg-config --libs --static viewproj) in *Geographic*) fail 'the core asks for GeographicLib' ;; esac
for header in "$work"/prefix/include/viewproj/*.hpp; do
  [ -f "lib/viewproj/$(basename "$header")" ] || fail "$header is installed"
done
[ "$(find "$work/prefix/include" -type f | wc -l)" -eq "$(find lib/viewproj -type f | wc -l)" ] || fail 'not the public headers alone are installed'

for how in subdirectory fetch; do
  echo "== the library by itself: $how"
  cmake -S tests/install -B "$work/$how" -DHOW=$how -DLIBRARY="$source/lib" >/dev/null
  cmake --build "$work/$how" --parallel "$(nproc)" >/dev/null
  expect_output "the program of tests/install by $how" "$("$work/$how/consumer")"
done

DESTDIR=$work/staged cmake --install "$build" --prefix /opt/viewproj >/dev/null
expect_files "$work/staged/opt/viewproj"

echo '== pages'
cd "$work/prefix/share/doc/viewproj"
grep -rlF '](' --include='*.md' . >"$work/pages"
while IFS= read -r page; do
  sh "$source/tests/cmd/page.sh" "$work/prefix/bin/viewproj" "$page" >"$work/log" || fail "an installed page: $(cat "$work/log")"
done <"$work/pages"
cd "$source"

echo '== manual page'
gzip -dc "$work/prefix/share/man/man1/viewproj.1.gz" >"$work/viewproj.1"
mandoc -Tlint -Wwarning "$work/viewproj.1"
for command in $("$work/prefix/bin/viewproj" --help | sed -n '/^Usage:/,/^Topics/s/^  \([a-z][a-z]*\) .*/\1/p'); do
  grep -qF "\\fB$command\\fR" "$work/viewproj.1" || fail "the manual page does not name $command"
done

echo '== Debian package'
(cd "$work" && cpack --config "$build/CPackConfig.cmake" -G DEB -B "$work/packages" >"$work/log" 2>&1) ||
  fail "cpack: $(cat "$work/log")"
package=$(find "$work/packages" -maxdepth 1 -name "viewproj_${version}_*.deb")
[ -f "$package" ] || fail "cpack made no viewproj_${version}_ARCHITECTURE.deb"
dpkg-deb -x "$package" "$work/unpacked"
expect_files "$work/unpacked/usr"
use_tool "$work/unpacked/usr/bin/viewproj"
for needed in libc6 libgeographiclib-dev; do
  dpkg-deb -f "$package" Depends | grep -qF "$needed" || fail "the package does not depend on $needed"
done
zcat "$work/unpacked/usr/share/doc/viewproj/changelog.gz" | head -n 1 | grep -qF "viewproj ($version)" ||
  fail "the newest entry of cmd/package/changelog is not about $version"
lintian --allow-root --fail-on error "$package" || fail 'lintian finds errors'
echo "$(basename "$package"): $(wc -c <"$package") bytes"

clean=${2-}
if [ -z "$clean" ]; then
  echo '== a clean Debian: left out, no folder for it was given'
  exit 0
fi
echo '== a clean Debian'
[ "$(id -u)" -eq 0 ] || fail 'a clean Debian takes root'
if [ ! -d "$clean/usr" ]; then
  command -v debootstrap >/dev/null || fail 'debootstrap is not installed; sh samples/setup.sh deep installs it'
  debootstrap --variant=minbase bookworm "$clean" >"$work/log" 2>&1 || fail "debootstrap: $(tail -n 5 "$work/log")"
fi
clean=$(cd "$clean" && pwd)
# It reaches its packages as this system does: proxies, certificates, names.
for part in apt/apt.conf.d ssl hosts resolv.conf; do
  if [ -e "/etc/$part" ]; then cp -RL --remove-destination "/etc/$part" "$clean/etc/$(dirname "$part")/"; fi
done
mount -t proc proc "$clean/proc"
mounted="$clean/proc"
mount --bind /dev "$clean/dev"
mounted="$clean/dev $mounted"
in_clean() { chroot "$clean" env -u CMAKE_GENERATOR DEBIAN_FRONTEND=noninteractive LC_ALL=C "$@"; }
in_clean sh -c 'command -v viewproj c++' && fail "$clean is not clean"
install -m 644 "$package" "$clean/tmp/"
in_clean apt-get update -qq
in_clean apt-get install -qq -y --no-install-recommends "/tmp/$(basename "$package")" >"$work/log" 2>&1 ||
  fail "apt: $(tail -n 5 "$work/log")"
use_tool in_clean viewproj
in_clean sh -c 'cd /usr/share/doc/viewproj && viewproj project -c samples/cornell-box/camera.json samples/cornell-box/quads.csv' |
  cmp - samples/cornell-box/expout || fail 'a sample of the package gives something else'
in_clean apt-get install -qq -y --no-install-recommends g++ cmake make >"$work/log" 2>&1 || fail "apt: $(tail -n 5 "$work/log")"
rm -rf "$clean/tmp/consumer"
cp -R tests/install "$clean/tmp/consumer"
in_clean sh -c 'cmake -S /tmp/consumer -B /tmp/consumer/build && cmake --build /tmp/consumer/build' >"$work/log" 2>&1 ||
  fail "the program does not build there: $(tail -n 20 "$work/log")"
expect_output 'the program built there' "$(in_clean /tmp/consumer/build/consumer)"
in_clean apt-get remove -qq -y viewproj >/dev/null 2>&1
if in_clean sh -c 'ls /usr/bin/viewproj /usr/share/doc/viewproj /usr/include/viewproj' 2>/dev/null; then fail 'apt remove leaves these'; fi
echo 'the package works there, and leaves nothing behind'
