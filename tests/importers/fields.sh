#!/bin/sh
# Every name that an importer knows, of a field or of one of its values, stands in a file that another program has judged.
#   sh fields.sh cmd/input/importers tests/importers/fixtures
set -eu
# Words of the importers that are no names: the library's for what it complains about, and what they print.
others='gltf threejs columns worldFromCamera matrices true false'
count=0
unjudged=""
for importer in gltf threejs matrices; do
  fixture=$2/threejs.jsonl
  [ -f "$1/$importer.cpp" ] && [ -f "$fixture" ]
  for word in $(sed 's,//.*,,' "$1/$importer.cpp" | grep -o '"[A-Za-z][A-Za-z0-9_]*"' | tr -d '"' | sort -u); do
    count=$((count + 1))
    case " $others " in *" $word "* | *" $importer:$word "*) continue ;; esac
    grep -qF "\"$word\"" "$fixture" || unjudged="$unjudged $importer:$word"
  done
done
if [ -n "$unjudged" ]; then
  echo "in no fixture:$unjudged"
  exit 1
fi
[ "$count" -ge 60 ] || { echo "only $count names found"; exit 1; }
echo "$count names judged"
