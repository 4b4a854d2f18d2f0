#!/bin/sh
# Installs missing packages from Debian and npm, and makes a Release build in build/.
#   sh samples/setup.sh          the tool, the rest of an installation, and the samples' packages
#   sh samples/setup.sh tests    the tool and the tests, with their judges
#   sh samples/setup.sh checks   the same, and the packages of .ci/run
#   sh samples/setup.sh deep     the same, and the packages of tests/checks/deep.sh and tests/benchmark
# VIEWPROJ_OPTIONS in the environment gives more options for CMake.
set -eu
cd "$(dirname "$0")/.."

packages="g++ cmake make libcli11-dev nlohmann-json3-dev libfast-float-dev libdragonbox-dev libyaml-dev libpugixml-dev zlib1g-dev libgeographiclib-dev jq"
part=${1:-tool}
tests=OFF
case $part in
  tool) ;;
  tests | checks | deep) tests=ON ;;
  *) echo "setup.sh $part: expected tests, checks or deep" >&2; exit 2 ;;
esac
if [ $tests = ON ]; then
  packages="$packages catch2 libmpfr-dev libglm-dev libeigen3-dev glslang-tools parallel"
  packages="$packages colmap python3-camera-calibration-parsers python3-open3d python3-yaml"
  packages="$packages python3 python3-numpy python3-opencv libegl-dev libgl-dev libopengl-dev libgl1-mesa-dri"
  # node and npm may come from elsewhere.
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
# The judges in tests/package.json. If they cannot be installed (no network, no npm), their tests are skipped.
if [ "$tests" = ON ] && ! cmp -s tests/package-lock.json tests/node_modules/package-lock.json; then
  if (cd tests && npm ci --no-audit --no-fund --loglevel=error >/dev/null); then
    cp tests/package-lock.json tests/node_modules/
  else
    echo 'npm: three.js, ajv and gltf-validator are not installed in tests/node_modules' >&2
  fi
fi

# A build folder that has the tests keeps them.
options=${VIEWPROJ_OPTIONS:-}
if [ "$tests" = ON ]; then options="$options -DVIEWPROJ_TESTS=ON"; fi
# shellcheck disable=SC2086  # a list of words
cmake -B build -DCMAKE_BUILD_TYPE=Release $options >/dev/null
# The targets of an installation, or all of them.
targets="viewproj libviewproj_cameras_of libviewproj_scene libviewproj_geodesy"
if [ "$tests" = ON ]; then targets=all; fi
# shellcheck disable=SC2086  # a list of words
cmake --build build --parallel "$(nproc)" --target $targets
