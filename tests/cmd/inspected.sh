#!/bin/sh
# What `matrix` writes, `inspect` reads: in every preset, for every kind of projection, forward and reversed, in every
# format, the preset is among the readings, and written again from the reading it is the same matrix.
#   sh inspected.sh VIEWPROJ
set -eu
# shellcheck source=tests/cmd/limits.sh
. "$(dirname "$0")/limits.sh"
limit_memory "$1"
PATH="$(cd "$(dirname "$1")" && pwd):$PATH"
export PATH
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
view='"position":[3,2,5],"target":[-1,0.5,0.25]'
number=0
for projection in \
  '{"type":"perspective","fovY":60,"aspect":1.5,"near":0.1,"far":1000}' \
  '{"type":"perspective","fovY":60,"aspect":1.5,"near":0.1}' \
  '{"type":"frustum","left":-1,"right":3,"bottom":-0.5,"top":1.5,"near":0.7,"far":90}' \
  '{"type":"frustum","left":-1,"right":3,"bottom":-0.5,"top":1.5,"near":0.7}' \
  '{"type":"orthographic","left":-4,"right":20,"bottom":1,"top":9,"near":-0.5,"far":30}'; do
  for reverse in --reverse-z --no-reverse-z; do
    for convention in opengl opengl-lh d3d d3d-rh vulkan metal webgpu unity unreal opencv ps2; do
      for which in view,projection,viewProjection projection viewProjection; do
        for form in json text flat c numpy; do
          # A view alone in a flat array may as well be its inverse. How a form is written does not depend on the projection:
          # two of them are enough.
          case $which-$form in *,*-flat | projection-[!f]* | viewProjection-[!f]*) continue ;; esac
          case $form-$projection in json-* | *60*1000* | *orthographic*) ;; *) continue ;; esac
          # An orthographic product is one in a world of either hand: only JSON says which.
          case $which-$form-$projection in *viewProjection-json-*) ;; *viewProjection-*orthographic*) continue ;; esac
          case $form in json) read_as= ;; *) read_as="--read-as $convention" ;; esac
          number=$((number + 1))
          set -- --convention "$convention" "$reverse" --to "$form"
          viewproj matrix -c "{$view,\"projection\":$projection}" --which "$which" "$@" >"$work/written"
          # shellcheck disable=SC2086
          viewproj inspect $read_as "$@" <"$work/written" >"$work/again" || {
            echo "$convention $reverse $form $projection: not read"
            exit 1
          }
          # near and far were rounded once, and a view-projection's translations are sums.
          if [ $form = json ]; then sed -i '/"convention"/d' "$work/written" "$work/again"; fi
          tr -s '[], \n' ' ' <"$work/written" | tr ' ' '\n' >"$work/a"
          tr -s '[], \n' ' ' <"$work/again" | tr ' ' '\n' >"$work/b"
          paste -d ' ' "$work/a" "$work/b" | awk -v what="$convention $reverse $form $projection" '
            NF == 0 { next }
            NF != 2 { print what ": " $0; exit 1 }
            $1 ~ /^-?[0-9]/ { d = $1 - $2; if (d < 0) d = -d; s = $1 < 0 ? -$1 : $1; if (!(d <= 4e-15 * (s > 1 ? s : 1))) { print what ": " $0; exit 1 } next }
            $1 != $2 { print what ": " $0; exit 1 }' || exit 1
        done
      done
    done
  done
done
[ "$number" = 242 ]
echo "$number matrices or sets of them read back"
