#!/bin/sh
# Installs what is missing from Debian's packages, and from npm's, and builds Release into build/.
#   sh samples/setup.sh          the tool, what else an installation takes, and what the samples need
#   sh samples/setup.sh tests    the tool and the tests, with their judges
#   sh samples/setup.sh checks   these, and what .ci/run needs
#   sh samples/setup.sh deep     these, and what tests/checks/deep.sh and tests/benchmark need
# VIEWPROJ_OPTIONS in the environment: further options of CMake.
set -eu
cd "$(dirname "$0")/.."

packages="g++ cmake make libcli11-dev nlohmann-json3-dev libfast-float-dev libdragonbox-dev libyaml-dev libgeographiclib-dev jq"
part=${1:-tool}
tests=OFF
case $part in
  tool) ;;
  tests | checks | deep) tests=ON ;;
  *) echo "setup.sh $part: expected tests, checks or deep" >&2; exit 2 ;;
esac
if [ $tests = ON ]; then
  packages="$packages catch2 libmpfr-dev libglm-dev libeigen3-dev glslang-tools"
  packages="$packages python3 python3-numpy python3-opencv libegl-dev libgl-dev libopengl-dev libgl1-mesa-dri"
  # Those from elsewhere do as well.
  command -v node >/dev/null || packages="$packages nodejs"
  command -v npm >/dev/null || packages="$packages npm"
fi
if [ "$part" = checks ] || [ "$part" = deep ]; then
  packages="$packages ninja-build clang clang-format cppcheck gappa libclang-rt-14-dev llvm shellcheck"
  packages="$packages dpkg-dev file lintian mandoc pkgconf"
fi
if [ "$part" = deep ]; then
  packages="$packages ccache clang-tidy debootstrap miller mawk qemu-user time valgrind"
  packages="$packages libc++-dev libc++abi-dev g++-mingw-w64-x86-64-posix wine64 g++-aarch64-linux-gnu"
fi

if command -v dpkg-query >/dev/null 2>&1; then
  missing=""
  for package in $packages; do
    status=$(dpkg-query -W -f='${Status}' "$package" 2>/dev/null) || status=""
    [ "$status" = 'install ok installed' ] || missing="$missing $package"
  done
  if [ -n "$missing" ]; then
    as_root=""
    if [ "$(id -u)" -ne 0 ]; then as_root=sudo; fi
    echo "Installing:$missing"
    $as_root apt-get update -qq
    # shellcheck disable=SC2086  # a list of words
    $as_root env DEBIAN_FRONTEND=noninteractive apt-get install -qq -y --no-install-recommends $missing >/dev/null
  fi
fi
# The judges of tests/package.json. Without them (no network, no npm) their tests say so.
if [ "$tests" = ON ] && ! cmp -s tests/package-lock.json tests/node_modules/package-lock.json; then
  if (cd tests && npm ci --no-audit --no-fund --loglevel=error >/dev/null); then
    cp tests/package-lock.json tests/node_modules/
  else
    echo 'npm: three.js and ajv are not installed in tests/node_modules' >&2
  fi
fi

# A build folder with the tests keeps them.
options=${VIEWPROJ_OPTIONS:-}
if [ "$tests" = ON ]; then options="$options -DVIEWPROJ_TESTS=ON"; fi
# shellcheck disable=SC2086  # a list of words
cmake -B build -DCMAKE_BUILD_TYPE=Release $options >/dev/null
# What an installation takes, or all.
targets="viewproj libviewproj_scene libviewproj_geodesy"
if [ "$tests" = ON ]; then targets=all; fi
# shellcheck disable=SC2086  # a list of words
cmake --build build --parallel "$(nproc)" --target $targets
