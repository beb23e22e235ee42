#!/usr/bin/env bash
# tools/test.sh [ctest options]: installs what is missing, builds, runs the tests; those labelled slow only when a label is asked for.
# Where the environment has CI set, warnings are errors, and a missing Vulkan device fails the tests that need one.
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
"$root/tools/setup.sh" --tests
"$root/tools/build.sh" "$([[ -n ${CI:-} ]] && echo ci || echo release)"

labels=(--label-exclude '^slow$')
for argument in "$@"; do
  case $argument in -L* | --label-regex* | --label-exclude*) labels=() ;; esac
done
exec ctest --test-dir "$root/build/release" --output-on-failure --parallel "$(nproc)" ${labels[@]+"${labels[@]}"} "$@"
