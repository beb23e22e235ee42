#!/usr/bin/env bash
# tools/gallery.sh [options] [FOLDER]: installs what is missing, builds, renders the paper's figures and more into FOLDER, each as
# EXR and PNG, with all of them on one sheet, FOLDER/gallery.png, and an animation. --help says more.
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
"$root/tools/setup.sh" --gallery
python=""
for candidate in /usr/bin/python3 python3; do
  if command -v "$candidate" >/dev/null && "$candidate" -c 'import PIL' 2>/dev/null; then
    python=$candidate
    break
  fi
done
if [[ -z $python ]]; then
  echo "tools/gallery.sh: Python with PIL is missing; install the package python3-pil" >&2
  exit 1
fi
case " $* " in *" --help "* | *" -h "*) ;; *) "$root/tools/build.sh" release meniscal ;; esac
exec "$python" -B "$root/tools/gallery/gallery.py" "$@"
