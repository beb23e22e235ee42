#!/usr/bin/env bash
# Installs the Debian packages that Meniscal is built and run with, and with --tests also the Khronos glTF validator, which
# tests of exported scenes use, in CI clang, and with --gallery what tools/gallery.sh composes its sheet with. Says and does nothing when none
# is missing.
set -euo pipefail

purpose=${1-}
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
validator=$root/build/gltf_validator

packages=(
  g++ cmake ninja-build ccache
  glslang-tools spirv-tools
  libvulkan1 libvulkan-dev libvulkan-volk-dev mesa-vulkan-drivers vulkan-validationlayers
  libglm-dev libeigen3-dev libopenmesh-dev libembree-dev libtinygltf-dev libstb-dev
  libopenexr-dev libpng-dev
  libcli11-dev libfmt-dev nlohmann-json3-dev
  libgtest-dev libbenchmark-dev
)
# Node may come from elsewhere than Debian.
[[ $purpose != --tests ]] || { command -v node && command -v npm; } >/dev/null || packages+=(nodejs npm)
# For the fuzz targets, whose test is skipped without.
[[ $purpose != --tests || -z ${CI:-} ]] || packages+=(clang libclang-rt-14-dev)
[[ $purpose != --gallery ]] || packages+=(python3-pil fonts-dejavu-core)

if ! command -v dpkg-query >/dev/null || ! command -v apt-get >/dev/null; then
  echo "tools/setup.sh: this is no Debian-like system; install what these packages hold, then run" >&2
  echo "  cmake --preset release && cmake --build build/release" >&2
  echo "Packages: ${packages[*]}" >&2
  exit 1
fi

installed=$(dpkg-query --show --showformat '${db:Status-Status} ${Package}\n' "${packages[@]}" 2>/dev/null | sed -n 's/^installed //p' || true)
missing=()
for package in "${packages[@]}"; do
  grep --quiet --fixed-strings --line-regexp -- "$package" <<<"$installed" || missing+=("$package")
done
if [[ ${#missing[@]} -gt 0 ]]; then
  if [[ $EUID -eq 0 ]]; then
    as_root=()
  elif command -v sudo >/dev/null; then
    as_root=(sudo)
  else
    echo "tools/setup.sh: packages are missing, and this is neither root nor a machine with sudo; as root, run" >&2
    echo "  apt-get install --no-install-recommends ${missing[*]}" >&2
    exit 1
  fi

  apt() { ${as_root[@]+"${as_root[@]}"} env DEBIAN_FRONTEND=noninteractive apt-get --quiet --quiet "$@"; }

  echo "Installing ${missing[*]}" >&2
  # The package lists may be absent (fresh container) or name versions that are gone from the mirror.
  apt update >&2 || echo "tools/setup.sh: the package lists could not be renewed; trying with those at hand" >&2
  apt install --yes --no-install-recommends "${missing[@]}" >&2
fi

if [[ $purpose == --tests ]] && ! cmp --quiet "$root/tests/gltf_validator/package-lock.json" "$validator/node_modules/installed"; then
  mkdir -p "$validator"
  cp "$root"/tests/gltf_validator/package*.json "$validator"
  if (cd "$validator" && npm ci --ignore-scripts --no-audit --no-fund --loglevel=error >&2); then
    cp "$validator/package-lock.json" "$validator/node_modules/installed"
  else
    echo "tools/setup.sh: the glTF validator could not be installed; exported scenes are not checked with it" >&2
  fi
fi
