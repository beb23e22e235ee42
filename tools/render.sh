#!/usr/bin/env bash
# tools/render.sh SCENE [render options]: installs what is missing, builds, renders, says where the picture is.
# Without -o, SCENE.exr and SCENE.png are written into the current folder; --preview names another PNG.
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
if [[ $# -eq 0 || $1 == -* ]]; then
  echo "usage: tools/render.sh SCENE [render options], for example tools/render.sh scenes/shadow_sausage.gltf" >&2
  echo "Options are those of build/release/meniscal render --help" >&2
  exit 2
fi
scene=$1
shift
if [[ ! -f $scene ]]; then  # before minutes of building
  echo "tools/render.sh: $scene: no such file; give a glTF scene, for example $root/scenes/shadow_sausage.gltf" >&2
  exit 3
fi

name=$(basename "$scene")
image=${name%.*}.exr preview=""
arguments=("$@")
for ((i = 0; i < $#; i++)); do
  case ${arguments[i]} in
    -o | --output) image=${arguments[i + 1]-} ;;
    --output=*) image=${arguments[i]#*=} ;;
    -o*) image=${arguments[i]#-o} ;;
    --preview) preview=${arguments[i + 1]-} ;;
    --preview=*) preview=${arguments[i]#*=} ;;
  esac
done
options=()
if [[ -z $preview ]]; then
  preview=${image%.exr}.png
  options=(--preview "$preview")
fi

"$root/tools/build.sh" release meniscal

status=0
"$root/build/release/meniscal" render "$scene" ${options[@]+"${options[@]}"} "$@" || status=$?
# 130: interrupted, after writing the image so far.
if [[ $status -eq 0 || ($status -eq 130 && -f $image) ]]; then
  echo "Picture: $preview, and with all its range $image"
fi
exit "$status"
