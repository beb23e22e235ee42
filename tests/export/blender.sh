#!/usr/bin/env bash
# blender.sh MENISCAL SCENES: Blender imports an exported scene with all its objects, materials and normals.
set -euo pipefail

meniscal=$1 scenes=$2
command -v blender >/dev/null || { echo "Blender is not installed"; exit 77; }
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
"$meniscal" mesh "$scenes/post.gltf" --meniscus paper -o "$folder/post.glb"
menisci=$("$meniscal" info --json "$folder/post.glb" | grep -o '[0-9]* meniscus triangles' | cut -d ' ' -f 1)
others=$("$meniscal" info --json "$folder/post.glb" | grep -o '[0-9]* other specular triangles' | cut -d ' ' -f 1)
# The sine profile's slope at a vertical wall is (pi/2 - contact angle) / 2: 27.6 degrees for one of 30.
blender -b --python-exit-code 1 --python "$(dirname "${BASH_SOURCE[0]}")/blender.py" -- "$folder/post.glb" '{
  "water": {"triangles": {"water": '"$others"', "water meniscus": '"$menisci"'}, "custom normals": true, "steepest": 28},
  "floor": {"triangles": {"floor": 2}, "custom normals": true, "steepest": 0},
  "post": {"triangles": {"post": 1024}, "custom normals": true, "steepest": 180},
  "camera": {"type": "CAMERA"}, "sun": {"type": "LIGHT"},
  "targets": ["water meniscus"]}'
