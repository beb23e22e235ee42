#!/usr/bin/env bash
# validate.sh MENISCAL SCENES MODULES: every scene as it is, and exported as .glb and as .gltf, must pass the Khronos validator without
# errors and warnings.
set -euo pipefail

meniscal=$1 scenes=$2 modules=$3
if ! command -v node >/dev/null || [[ ! -d $modules/gltf-validator ]]; then
  echo "The Khronos validator is not installed: tools/setup.sh --tests"
  [[ -z ${CI:-} ]] && exit 77 || exit 1
fi
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
for scene in "$scenes"/*.gltf; do
  name=$(basename "$scene" .gltf)
  "$meniscal" mesh "$scene" --meniscus paper -o "$folder/$name.glb"
  "$meniscal" mesh "$scene" --meniscus paper -o "$folder/$name.gltf"
done
NODE_PATH=$modules node "$(dirname "${BASH_SOURCE[0]}")/validate.js" "$scenes"/*.gltf "$folder"/*
