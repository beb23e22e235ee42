#!/usr/bin/env bash
# tools/build.sh PRESET [TARGET...]: installs what is missing, configures and builds into the preset's folder, quietly.
set -euo pipefail

preset=${1:?usage: tools/build.sh PRESET [TARGET...]}
shift
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
"$root/tools/setup.sh"

log=$(mktemp)
trap 'rm -f "$log"' EXIT
fail() {
  cat "$log" >&2
  echo "tools/build.sh: $1 failed; what went wrong stands above" >&2
  exit 1
}

cd "$root"
cmake --preset "$preset" >"$log" 2>&1 || fail "configuring"

[[ -e build/release/meniscal ]] || echo "Building Meniscal; the first time takes some minutes" >&2
build=(cmake --build --preset "$preset")
[[ $# -eq 0 ]] || build+=(--target "$@")
if [[ -t 2 ]]; then
  "${build[@]}" >&2  # ninja shows how far it is, in one line
else
  "${build[@]}" >"$log" 2>&1 || fail "building"
fi
