#!/usr/bin/env bash
# tests/fuzz/run.sh [SECONDS [TARGET...]]: builds the fuzz targets and runs each for so long, 8 s if not given; targets are scene,
# meniscus and image. What they learn stays in build/fuzz/corpus, the inputs of finds in build/fuzz/finds. Exits with 77 without clang.
set -euo pipefail

seconds=${1:-8}
shift || true
targets=("$@")
[[ $# -gt 0 ]] || targets=(scene meniscus image)
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
if ! command -v clang++ >/dev/null; then
  echo "tests/fuzz/run.sh: there is no clang++; install clang" >&2
  exit 77
fi

cd "$root"
cmake --preset fuzz >/dev/null
cmake --build --preset fuzz -- -k 0 >&2
export ASAN_OPTIONS=${ASAN_OPTIONS-}:allocator_may_return_null=0:detect_leaks=1
finds=0
for target in "${targets[@]}"; do
  mkdir -p "build/fuzz/corpus/$target" build/fuzz/finds
  # 10 s and 1 GiB are what hostile input may cost; sanitizers take some thrice that.
  "build/fuzz/tests/fuzz/${target}_fuzz" "build/fuzz/corpus/$target" "tests/fuzz/corpus/$target" -dict=tests/fuzz/words.txt \
    -max_total_time="$seconds" -timeout=30 -rss_limit_mb=3072 -malloc_limit_mb=1024 -print_final_stats=1 \
    -artifact_prefix="build/fuzz/finds/$target-" 2>"build/fuzz/$target.log" || finds=1
  grep -E '^(SUMMARY|==[0-9]+==ERROR|.*Test unit written|#[0-9]+.*DONE|stat::(number|average))' "build/fuzz/$target.log" |
    sed "s/^/$target: /"
done
exit $finds
