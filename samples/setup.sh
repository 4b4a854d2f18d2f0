#!/bin/sh
# Installs what is missing from Debian's packages and builds Release into build/.
#   sh samples/setup.sh          the tool, and what else an installation takes
#   sh samples/setup.sh tests    the tool and the tests
#   sh samples/setup.sh checks   these, and what tests/checks needs
# VIEWPROJ_OPTIONS in the environment: further options of CMake.
set -eu
cd "$(dirname "$0")/.."

packages="g++ cmake make libcli11-dev nlohmann-json3-dev libsimdjson-dev libgeographiclib-dev"
tests=OFF
if [ "${1:-}" = tests ] || [ "${1:-}" = checks ]; then
  packages="$packages catch2 libmpfr-dev libglm-dev libeigen3-dev libimath-dev geographiclib-tools glslang-tools"
  packages="$packages python3-numpy parallel time valgrind"
  packages="$packages libegl-dev libgl-dev libopengl-dev libgl1-mesa-dri libvulkan-dev mesa-vulkan-drivers"
  tests=ON
fi
if [ "${1:-}" = checks ]; then
  packages="$packages clang clang-format clang-tidy cppcheck libclang-rt-14-dev llvm shellcheck"
  packages="$packages dpkg-dev file lintian mandoc pkgconf debootstrap"
fi

if command -v dpkg-query >/dev/null 2>&1; then
  missing=""
  for package in $packages; do
    dpkg-query -W -f='${Status}' "$package" 2>/dev/null | grep -q 'install ok installed' || missing="$missing $package"
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

# A build folder with the tests keeps them.
options=${VIEWPROJ_OPTIONS:-}
if [ "$tests" = ON ]; then options="$options -DVIEWPROJ_TESTS=ON"; fi
# shellcheck disable=SC2086  # a list of words
cmake -B build -DCMAKE_BUILD_TYPE=Release $options >/dev/null
# What an installation takes, or all.
targets="viewproj libviewproj manual changelog"
if [ "$tests" = ON ]; then targets=all; fi
# shellcheck disable=SC2086  # a list of words
cmake --build build --parallel "$(nproc)" --target $targets
