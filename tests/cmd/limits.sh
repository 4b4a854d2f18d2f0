# Limits of time and memory for what a test runs, to be sourced. What hangs or swells is a failure that has a name.
# shellcheck shell=sh

# limit_memory VIEWPROJ: of every process from here on. A sanitizer takes address space of its own, and is told as much
# by ASAN_OPTIONS (tests/checks/watched_tests.sh).
limit_memory() {
  # shellcheck disable=SC3045  # dash and others have it
  if ! grep -qE '__(asan|tsan)_init' "$1"; then ulimit -v 2097152; fi
}

# limited COMMAND...: status 124 where it takes longer than this many seconds.
patience=${VIEWPROJ_PATIENCE:-60}
limited() { timeout -k 5 "$patience" "$@"; }
