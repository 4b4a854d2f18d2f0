#!/bin/sh
# The page's commands for GNU parallel write what one process writes, in parts on this machine and on others.
#   sh parallel.sh VIEWPROJ MANUAL.md CAMERA
set -eu
parallel --version 2>/dev/null | grep -q '^GNU parallel' || { echo 'GNU parallel is not installed'; exit 77; }
PATH=$(cd "$(dirname "$1")" && pwd):$PATH
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
awk '/^```sh$/ { inside = 1; next } /^```$/ { inside = 0 } inside' "$2" | sed 's/10M/100k/' >"$work/commands"
cp "$3" "$work/camera.json"
cd "$work"
# Without SHELL, GNU parallel guesses it from the process that called it.
export PATH HOME="$work" SHELL=/bin/sh

seq 20000 | awk '{ print "{\"id\":" $1 ",\"position\":[" $1 % 7 "," $1 % 11 "," $1 % 3 "]}" }' >points.ndjson
{ echo id,x,y,z; seq 20000 | awk '{ print $1 "," $1 % 7 "," $1 % 11 "," $1 % 3 }'; } >points.csv
same() {
  for form in ndjson csv; do
    [ -f expected.$form ] || viewproj project -c camera.json points.$form >expected.$form
    cmp expected.$form out.$form
    rm out.$form
  done
}
sh -e ./commands
same

# Other machines: what ssh is told runs here, and is noted.
# shellcheck disable=SC2016  # of the script that is written
printf '#!/bin/sh\necho "$1" >>"%s/hosts"\nshift 2\nexec sh -c "$*"\n' "$work" >ssh
chmod +x ssh
sed "s,^ *parallel,& -S one\,two --wd '$work'," commands | PARALLEL_SSH="$work/ssh" sh -e
same
for host in one two; do grep -q $host hosts || { echo "no part went to $host"; exit 1; }; done
echo 'the parts, here and on several machines, make the whole'
