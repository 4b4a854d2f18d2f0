#!/bin/sh
# Builds the fuzz targets (tests/fuzz) with clang and runs them, always with the same inputs.
#   sh tests/checks/fuzz.sh [BUILD FOLDER]     build-sanitized, where sanitized.sh has built, or else build-fuzz
# FUZZ_EXECUTIONS=N   so many executions in all (200000)
# FUZZ_SECONDS=N      so long in all instead; what was found interesting before is tried again first
# FUZZ_TARGETS="A B"  only these targets
# FUZZ_SEED=N         other inputs (the default is 1)
# The seeds are what the golden cases and samples read, and tests/fuzz/corpus. An input that is a finding is kept in
# BUILD FOLDER/found/, and its target's log is printed: mend it, and keep the input in tests/fuzz/corpus/TARGET/.
set -eu
cd "$(dirname "$0")/../.."
root=$PWD
build="build-fuzz"
if [ -d build-sanitized ]; then build="build-sanitized"; fi
build=${1:-$build}

[ -f "$build/CMakeCache.txt" ] || cmake -B "$build" -DCMAKE_CXX_COMPILER=clang++ -DCMAKE_BUILD_TYPE=None \
  -DCMAKE_CXX_FLAGS='-O1 -gline-tables-only' -DVIEWPROJ_SANITIZE=address,undefined -DVIEWPROJ_FUZZ=ON >/dev/null
cmake --build "$build" --parallel "$(nproc)" --target viewproj_fuzz
build=$(cd "$build" && pwd)

# Seeds: every case runs with record.cpp for viewproj.
rm -rf "$build/seeds" "$build/recorder" "$build/found" "$build/empty" "$build/cases"
[ -n "${FUZZ_SECONDS-}" ] || rm -rf "$build/corpus"
mkdir -p "$build/seeds" "$build/recorder" "$build/found" "$build/empty" "$build/logs"
clang++ -std=c++20 -O1 tests/fuzz/record.cpp -o "$build/recorder/viewproj"
python3 -B tests/cmd/transcripts.py "$build/recorder/viewproj" --folders "$build/cases"
cp -R samples/*/ "$build/cases"
# What a case makes of no output at all is its own affair.
# shellcheck disable=SC2016  # sh expands it
find "$build/cases" -mindepth 1 -maxdepth 1 -type d -print0 | SEEDS=$build/seeds PATH=$build/recorder:$PATH xargs -0 -P "$(nproc)" -I{} \
  sh -c 'cd "$1" && timeout 5 sh ./cmd >/dev/null 2>&1 </dev/null || :' case {}
python3 -B tests/importers/decimals.py | sed -n 's/.*"file":\({.*}\),"points":.*/\1/p' | while read -r line; do
  printf %s "$line" >"$build/seeds/line"
  mv "$build/seeds/line" "$build/seeds/camera/$(cksum <"$build/seeds/line" | tr ' ' '-')"
done

# Words: what the readers themselves compare with.
grep -rohE --include='*.?pp' '"[A-Za-z][A-Za-z0-9_.-]*"' cmd/camera cmd/formats cmd/records cmd/commands | sort -u |
  sed 's/^"\(.*\)"$/"\\"\1\\""/' >"$build/words"
cp "$build/words" "$build/arguments"
sed 's/\\"//g' "$build/words" >>"$build/arguments"
grep -rohE --include='*.?pp' -e '--[a-z]+(-[a-z]+)*' cmd/camera cmd/commands | sort -u | sed 's/.*/"&"/' >>"$build/arguments"

for target in camera scene model matrices json csv text f64 arguments; do
  seeds=$(find "$build/seeds/$target" -type f | wc -l)
  [ "$seeds" -ge 5 ] || { echo "fuzz.sh: the cases give $target only $seeds seeds" >&2; exit 1; }
done

targets=${FUZZ_TARGETS:-camera scene model matrices json csv text f64 arguments}
# How the executions are shared out: most to those that cost least.
share() {
  case $1 in
    matrices) echo 40 ;;
    model | scene | camera) echo 70 ;;
    f64 | text) echo 20 ;;
    csv | json) echo 10 ;;
    *) echo 2 ;;
  esac
}
shares=0
count=0
for target in $targets; do
  shares=$((shares + $(share "$target")))
  count=$((count + 1))
done

# Little is kept of what was freed, and no stacks of it: executions are short.
export ASAN_OPTIONS=malloc_context_size=1:quarantine_size_mb=2:thread_local_quarantine_size_kb=64:allocator_release_to_os_interval_ms=-1
export UBSAN_OPTIONS=print_stacktrace=1
export LLVM_PROFILE_FILE=/dev/null
total=0
status=0
for target in $targets; do
  if [ -n "${FUZZ_SECONDS-}" ]; then
    limit=-max_total_time=$((FUZZ_SECONDS / count))
  else
    limit=-runs=$((${FUZZ_EXECUTIONS:-200000} * $(share "$target") / shares + 1))
  fi
  words=$build/words
  if [ "$target" = arguments ]; then words=$build/arguments; fi
  mkdir -p "$build/corpus/$target" "$build/seeds/$target" "tests/fuzz/corpus/$target"
  log=$build/logs/$target
  # In an empty folder: arguments may name files.
  (cd "$build/empty" && exec "$build/viewproj_fuzz" --target="$target" "$limit" -seed="${FUZZ_SEED:-1}" \
    -timeout=25 -rss_limit_mb=2048 -malloc_limit_mb=512 -max_len=256 -entropic=0 -reduce_inputs=0 -dict="$words" \
    -close_fd_mask=2 -print_final_stats=1 -artifact_prefix="$build/found/$target-" \
    "$build/corpus/$target" "$build/seeds/$target" "$root/tests/fuzz/corpus/$target") >"$log" 2>&1 || {
    status=1
    echo "fuzz.sh: $target has a finding:" >&2
    tail -n 60 "$log" >&2
  }
  executions=$(sed -n 's/^stat::number_of_executed_units: *//p' "$log")
  rate=$(sed -n 's/^stat::average_exec_per_sec: *//p' "$log")
  [ "${executions:-0}" -gt 0 ] || status=1
  echo "$target: ${executions:-0} executions, ${rate:-0} a second"
  total=$((total + ${executions:-0}))
done
echo "$total executions in all, $([ "$status" = 0 ] && echo no || echo with a) finding"
exit "$status"
