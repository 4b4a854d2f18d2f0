#!/bin/sh
# The same bits where users are: builds the tool with clang++ and libc++, for Windows (run by wine), for aarch64 (run by
# qemu) and with every dependency from its source, static, warnings as errors, and compares what they print.
#   sh tests/checks/platforms.sh [libcxx|windows|aarch64|fetched]...      default: all
# Each prints what platforms/bits.sh asks for, byte for byte as build/viewproj does, and passes a share of the golden
# cases: one in SHARE (environment; default 8, 1 is all). Dependencies come as Debian's source packages, or from the
# folder SOURCES of an earlier run; `sh samples/setup.sh deep` installs the compilers, wine and qemu.
set -eu
cd "$(dirname "$0")/../.."
[ $# -gt 0 ] || set -- libcxx windows aarch64 fetched
here=$(pwd)/tests/checks/platforms
share=${SHARE:-8}

fail() {
  echo "platforms: $1" >&2
  exit 1
}

work=$(mktemp -d)
wine=""
finish() {
  # The server of this run's own wine.
  if [ -n "$wine" ]; then WINEPREFIX=$work/wine "$(dirname "$wine")/wineserver" -k 2>/dev/null || true; fi
  rm -rf "$work"
}
trap finish EXIT
trap 'exit 1' HUP INT TERM

# The sources, by the names that FetchContent has for them.
sources=${SOURCES:-$work/sources}
if [ ! -d "$sources" ]; then
  mkdir -p "$work/lists/partial" "$work/archives" "$sources"
  key=/usr/share/keyrings/debian-archive-keyring.gpg
  echo "deb-src [signed-by=$key] http://deb.debian.org/debian bookworm main" >"$work/sources.list"
  apt="-qq -o Dir::Etc::SourceList=$work/sources.list -o Dir::Etc::SourceParts=- -o Dir::State::Lists=$work/lists"
  apt="$apt -o Dir::Cache::srcpkgcache= -o Dir::Cache::pkgcache= -o APT::Sandbox::User=root"
  packages="cli11 nlohmann-json3 fast-float dragonbox libyaml pugixml zlib geographiclib catch2"
  # shellcheck disable=SC2086  # lists of words
  (apt-get $apt update && cd "$work/archives" && apt-get $apt --download-only --tar-only source $packages) >"$work/log" 2>&1 ||
    fail "apt-get source: $(tail -n 5 "$work/log")"
  for name in cli11 nlohmann_json fastfloat dragonbox libyaml pugixml zlib geographiclib catch2; do
    archive=$(find "$work/archives" -name "$(echo "$name" | sed 's/_/-/; s/fastfloat/fast-float/')*.orig.tar.*")
    mkdir "$sources/$name"
    tar -xf "$archive" -C "$sources/$name" --strip-components=1
  done
  # Debian's archive of zlib is without what its CMakeLists.txt names for Windows.
  mkdir -p "$sources/zlib/win32" && : >"$sources/zlib/win32/zlib1.rc"
fi
options="-DYAML_INCLUDE=OFF -DPUGIXML_INCLUDE=OFF -DZLIB_INCLUDE=OFF -DGEOGRAPHICLIB_INCLUDE=OFF"
for package in CLI11 nlohmann_json FastFloat dragonbox libyaml pugixml zlib GeographicLib Catch2; do
  name=$(echo "$package" | tr '[:lower:]' '[:upper:]')
  folder=$sources/$(echo "$package" | tr '[:upper:]' '[:lower:]')
  options="$options -DFETCHCONTENT_SOURCE_DIR_$name=$folder -DCMAKE_DISABLE_FIND_PACKAGE_$package=ON"
done
if command -v ccache >/dev/null; then
  options="$options -DCMAKE_CXX_COMPILER_LAUNCHER=ccache -DCMAKE_C_COMPILER_LAUNCHER=ccache"
fi

# build NAME OPTION...: the tool in build-platforms/NAME. Optimised a little: what takes time is the building. (The
# kernels of the library are optimised always.)
build() {
  folder=build-platforms/$1
  shift
  # shellcheck disable=SC2086  # a list of words
  cmake -B "$folder" -DVIEWPROJ_WERROR=ON -DCMAKE_CXX_FLAGS_RELEASE=-O1 $options "$@" -Wno-dev \
    >"$work/log" 2>&1 || fail "cmake: $(tail -n 20 "$work/log")"
  cmake --build "$folder" --parallel "$(nproc)" --target viewproj >"$work/log" 2>&1 || fail "$(tail -n 40 "$work/log")"
}

# compare NAME COMMAND...: the bits.
compare() {
  name=$1
  shift
  sh "$here/bits.sh" build/viewproj >"$work/bits"
  sh "$here/bits.sh" "$@" >"$work/$name.bits" || fail "$name: the tool fails"
  cmp "$work/bits" "$work/$name.bits" || fail "$name gives other bits than build/viewproj"
  echo "$name: $(sha256sum <"$work/$name.bits" | cut -c 1-16), $(wc -c <"$work/$name.bits") bytes as build/viewproj has them"
}

# cases NAME VIEWPROJ: a share of the golden cases, but those that are named in NAME-skip.txt.
cases() {
  skip=$here/$1-skip.txt
  if [ ! -f "$skip" ]; then skip=/dev/null; fi
  names=$(python3 -B tests/cmd/transcripts.py "$2" --list | awk -v share="$share" 'NR % share == 0' | grep -vxF -f "$skip")
  # An emulator takes twenty times as long.
  # shellcheck disable=SC2086  # names without blanks
  VIEWPROJ_PATIENCE=600 python3 -B tests/cmd/transcripts.py "$2" $names || fail "$1: these golden cases"
}

# wrapped NAME COMMAND...: an executable called viewproj that runs the command.
wrapped() {
  mkdir -p "$work/$1-bin"
  printf '#!/bin/sh\nexec %s "$@"\n' "$2" >"$work/$1-bin/viewproj"
  chmod +x "$work/$1-bin/viewproj"
}

libcxx() {
  build libcxx -DCMAKE_CXX_COMPILER=clang++ -DCMAKE_C_COMPILER=clang -DCMAKE_CXX_FLAGS=-stdlib=libc++
  compare libcxx build-platforms/libcxx/viewproj
  cases libcxx build-platforms/libcxx/viewproj
}

fetched() {
  build fetched -DVIEWPROJ_STATIC=ON
  file build-platforms/fetched/viewproj | grep -q 'statically linked' || fail 'fetched: is not static'
  compare fetched build-platforms/fetched/viewproj
  cases fetched build-platforms/fetched/viewproj
}

aarch64() {
  build aarch64 --toolchain "$here/aarch64.cmake" -DCMAKE_EXE_LINKER_FLAGS=-static
  wrapped aarch64 "qemu-aarch64 $(pwd)/build-platforms/aarch64/viewproj"
  compare aarch64 "$work/aarch64-bin/viewproj"
  cases aarch64 "$work/aarch64-bin/viewproj"
}

windows() {
  for wine in /usr/lib/wine/wine64 "$(command -v wine64 || true)" "$(command -v wine || true)"; do
    if [ -x "$wine" ]; then break; fi
  done
  [ -x "$wine" ] || fail 'wine is not installed'
  export WINEPREFIX="$work/wine" WINEDEBUG=-all WINEDLLOVERRIDES=mscoree,mshtml= DISPLAY=
  "$wine" wineboot --init >/dev/null 2>&1 || true
  build windows --toolchain "$here/windows.cmake" -DVIEWPROJ_TESTS=ON
  cmake --build build-platforms/windows --parallel "$(nproc)" --target unit_tests >"$work/log" 2>&1 ||
    fail "$(tail -n 40 "$work/log")"
  "$wine" build-platforms/windows/unit_tests.exe || fail 'windows: the unit tests'
  wrapped windows "$wine $(pwd)/build-platforms/windows/viewproj.exe"
  # The last bit of a sine is another there, and so now and then that of a point on the Earth.
  export PLACES=0
  compare windows "$work/windows-bin/viewproj"
  unset PLACES
  sh "$here/windows.sh" "$work/windows-bin/viewproj" || fail 'windows: that'
  camera=$(pwd)/samples/picking-a-pixel/camera.json
  answer=$(echo 1 1 1 | build/viewproj project -c "$camera")
  python3 -B "$here/console.py" "$camera" "$answer" "$wine" build-platforms/windows/viewproj.exe || fail 'windows: a console'
  cases windows "$work/windows-bin/viewproj"
}

[ -x build/viewproj ] || fail 'build/viewproj is not there: cmake -B build && cmake --build build'
for platform; do
  echo "== $platform"
  start=$(date +%s)
  "$platform"
  echo "== $platform: $(($(date +%s) - start)) s"
done
