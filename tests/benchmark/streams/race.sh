# Programs that take turns, to be sourced: prepare, add, race.

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
  cd "$work"
  for tool in "$@"; do "${CXX:-c++}" -std=c++17 -O2 -o "$tool" "$here/$tool.cpp"; done
  : >contenders
}

# add 'GROUP|NAME|POINTS|COMMAND': a shell command that works on so many points.
add() { echo "$1" >>contenders; }

# Runs all that were added, in turns, ROUNDS times (5), and prints a table. BEFORE is a command that is run before each,
# as one that waits until the machine is quiet.
race() {
  rounds=${ROUNDS:-5}
  round=1
  while [ $round -le "$rounds" ]; do
    while IFS='|' read -r group name count command; do
      ${BEFORE:-:} </dev/null
      echo "$group|$name|$count|$(./timed "$command" </dev/null)"
    done <contenders >>times
    round=$((round + 1))
  done
  echo
  awk -F '|' -v rounds="$rounds" '
    function sorted(list, n, i, j, t) {
      for (i = 2; i <= n; ++i) for (j = i; j > 1 && list[j - 1] > list[j]; --j) { t = list[j]; list[j] = list[j - 1]; list[j - 1] = t }
    }
    {
      split($4, took, " ")
      key = $1 "|" $2
      if (!(key in runs)) { order[++keys] = key; points[key] = $3 }
      time[key, ++runs[key]] = took[1] / $3 * 1e9
      if (took[2] > peak[key]) peak[key] = took[2]
    }
    END {
      printf "medians and bests of %d rounds, ns per point; ratio to the first of each form; peak memory of the largest process\n", rounds
      for (k = 1; k <= keys; ++k) {
        key = order[k]
        split(key, part, "|")
        for (i = 1; i <= runs[key]; ++i) list[i] = time[key, i]
        sorted(list, runs[key])
        median = list[int((runs[key] + 1) / 2)]
        if (!(part[1] in base)) { base[part[1]] = median; base_best[part[1]] = list[1]; groups[++count] = part[1] }
        rows[part[1]] = rows[part[1]] sprintf("%-36s %9d %9.1f %9.1f %7.2f %7.2f %7.1f\n", part[2], points[key], median, list[1],
                                              median / base[part[1]], list[1] / base_best[part[1]], peak[key] / 1024)
      }
      for (g = 1; g <= count; ++g)
        printf "\n%-36s %9s %9s %9s %7s %7s %7s\n%s", groups[g], "points", "median", "best", "ratio", "of best", "MB", rows[groups[g]]
    }' times
}
