#!/usr/bin/env bash
# tools/benchmark.sh [options]: builds, then measures CPU seconds and errors; --help says what there is.
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
case " $* " in
*" --required "*)
  "$root/tools/build.sh" release required_benchmark
  exec "$root/build/release/tests/benchmark/required_benchmark"
  ;;
esac
python=""
for candidate in /usr/bin/python3 python3; do
  if command -v "$candidate" >/dev/null && "$candidate" -c 'import numpy' 2>/dev/null; then
    python=$candidate
    break
  fi
done
if [[ -z $python ]]; then
  echo "tools/benchmark.sh: Python with numpy is missing; install the package python3-numpy" >&2
  exit 1
fi
case " $* " in *" --help "* | *" -h "* | *" --meniscal"*) ;; *) "$root/tools/build.sh" release meniscal ;; esac
exec "$python" -B "$root/tools/benchmark/benchmark.py" "$@"
