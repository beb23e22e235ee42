#!/usr/bin/env bash
# on_swiftshader.sh MENISCAL TEST...: runs gtest programs on SwiftShader, a Vulkan driver that shares no code with Mesa.
# Exit code 77: SwiftShader is not installed.
set -euo pipefail

icd=${SWIFTSHADER_ICD:-/usr/lib/chromium/vk_swiftshader_icd.json}
if [[ ! -f $icd ]]; then
  echo "skipped: $icd is missing; install the package chromium-common, or set SWIFTSHADER_ICD" >&2
  exit 77
fi
export VK_ICD_FILENAMES=$icd VK_DRIVER_FILES=$icd
export CI=1  # a device that does not open fails the tests, instead of skipping them

devices=$("$1" devices)
if [[ $devices != *SwiftShader* || $devices == *llvmpipe* ]]; then
  printf 'on_swiftshader.sh: expected SwiftShader alone, but meniscal devices says:\n%s\n' "$devices" >&2
  exit 1
fi
shift
for test in "$@"; do "$test"; done
