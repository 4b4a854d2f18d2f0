# Programs that take turns, to be sourced: prepare, add, race. The sourcing script says where `here` is: this folder.
# shellcheck shell=sh disable=SC2154

# prepare VIEWPROJ TOOL...: a working directory with these tools of this folder, compiled; the absolute path of VIEWPROJ in
# $viewproj.
prepare() {
  viewproj=$(cd "$(dirname "$1")" && pwd)/$(basename "$1")
  [ -x "$viewproj" ] || { echo "$1 is no executable" >&2; exit 1; }
  shift
  LC_ALL=C
  export LC_ALL
  work=$(mktemp -d)
  out=$(mktemp -d "$([ -w /dev/shm ] && echo /dev/shm || echo "${TMPDIR:-/tmp}")/viewproj-XXXXXX")
  trap 'rm -rf "$work" "$out"' EXIT
  trap 'exit 1' HUP INT TERM
  cd "$work" || exit 1
  for tool in "$@"; do "${CXX:-c++}" -std=c++17 -O2 -o "$tool" "$here/$tool.cpp"; done
  : >contenders
}

# add 'GROUP|NAME|POINTS|COMMAND': a shell command that works on so many points.
add() { echo "$1" >>contenders; }

# Runs all that were added, in turns, ROUNDS times (5), and prints a table; with ROUNDS=0 once, and no table. BEFORE is a
# command that is run before each, as one that waits until the machine is quiet.
race() {
  rounds=${ROUNDS:-5}
  if [ "$rounds" = 0 ]; then
    while IFS='|' read -r group name count command; do ./timed "$command" </dev/null; done <contenders >took
    echo "$(wc -l <took) commands run"
    return
  fi
  round=1
  while [ $round -le "$rounds" ]; do
    while IFS='|' read -r group name count command; do
      ${BEFORE:-:} </dev/null
      took=$(./timed "$command" </dev/null)
      echo "$group|$name|$count|$took"
    done <contenders >>took
    round=$((round + 1))
  done
  echo
  awk -F '|' -v rounds="$rounds" '
    # Sorts list[1] to list[n]; gives the median.
    function sort(list, n,    i, j, t) {
      for (i = 2; i <= n; ++i)
        for (j = i; j > 1 && list[j - 1] > list[j]; --j) { t = list[j]; list[j] = list[j - 1]; list[j - 1] = t }
      return list[int((n + 1) / 2)]
    }
    {
      split($4, took, " ")
      row = $1 "|" $2
      if (!(row in runs)) { order[++rows] = row; points[row] = $3 }
      ++runs[row]
      clock[row, runs[row]] = took[1] / $3 * 1e9
      used[row, runs[row]] = took[2] / $3 * 1e9
      if (took[3] > peak[row]) peak[row] = took[3]
    }
    END {
      print rounds " rounds. ns per point: the median and the best by the clock, the best of processor time; what the median and"
      print "the processor time are to those of the first of each form; MB of the largest process"
      for (r = 1; r <= rows; ++r) {
        row = order[r]
        split(row, part, "|")
        form = part[1]
        for (i = 1; i <= runs[row]; ++i) { list[i] = clock[row, i]; list2[i] = used[row, i] }
        median = sort(list, runs[row])
        sort(list2, runs[row])
        if (form != last) {
          printf "\n%-36s %9s %9s %9s %9s %7s %7s %7s\n", form, "points", "median", "best", "cpu", "ratio", "of cpu", "MB"
          base = median; base2 = list2[1]; last = form
        }
        printf "%-36s %9d %9.1f %9.1f %9.1f %7.2f %7.2f %7.1f\n", part[2], points[row], median, list[1], list2[1],
               median / base, list2[1] / base2, peak[row] / 1024
      }
    }' took
}
