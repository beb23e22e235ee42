"""Measures Meniscal as a whole process, started cold, against scenes whose caustic is known exactly, and against POV-Ray."""
import argparse
import os
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.normpath(os.path.join(HERE, "..", ".."))
sys.path.insert(1, os.path.join(ROOT, "tools", "scenes"))

import depression  # noqa: E402
import equal_time  # noqa: E402
import growth  # noqa: E402
import law  # noqa: E402
import povray  # noqa: E402
import speed  # noqa: E402
from case import Case  # noqa: E402
from process import Meniscal, Refused  # noqa: E402


def main():
    parser = argparse.ArgumentParser(prog="tools/benchmark.sh", description=__doc__)
    parser.add_argument("--scenes", default="dep,fibdep", help="of dep (a post of 4 mm) and fibdep (a fibre of 0.1 mm); default both")
    parser.add_argument("--repeats", type=int, default=3, metavar="K", help="runs of each setting; the cheapest counts (default 3)")
    parser.add_argument("--povray", action="store_true", help="also POV-Ray (package povray), on the same meshes")
    parser.add_argument("--law", action="store_true", help="instead: errors against photons over three decades, some minutes")
    parser.add_argument("--growth", action="store_true", help="instead: cost against photons, pixels, triangles and targets, some minutes")
    parser.add_argument("--equal-time", nargs="?", const=os.path.join(ROOT, "scenes", "shadow_sausage.gltf"), metavar="SCENE",
                        help="instead: targeted against ordinary photon maps at equal CPU seconds, by default on shadow_sausage")
    parser.add_argument("--budgets", default="3,6,12,24", metavar="S,...", help="CPU seconds for --equal-time (default 3,6,12,24)")
    parser.add_argument("--required", action="store_true", help="instead: CPU seconds of scenes with and without each feature of the plan, some minutes")
    parser.add_argument("--meniscal", default=os.path.join(ROOT, "build", "release", "meniscal"), help="program to measure")
    parser.add_argument("--folder", default=os.path.join(ROOT, "build", "benchmark"), help="where scenes, pictures and plots go")
    options = parser.parse_args()
    names = options.scenes.split(",")
    if any(name not in depression.SCENES for name in names):
        parser.error(f"--scenes: {options.scenes} is not of {', '.join(depression.SCENES)}")
    os.makedirs(options.folder, exist_ok=True)
    meniscal = Meniscal(options.meniscal)
    if options.equal_time:
        return equal_time.measure(meniscal, options.equal_time, [float(b) for b in options.budgets.split(",")], options.folder)
    if options.growth:
        return growth.measure(meniscal, options.folder)
    if options.povray and not povray.program():
        sys.exit("benchmark: --povray: POV-Ray is not installed; install the package povray")

    depression.write_scenes(options.folder)
    cases = [Case(name, meniscal, options.folder) for name in names]
    if options.law:
        law.measure(cases)
    else:
        speed.measure(cases, options.repeats, options.povray)


if __name__ == "__main__":
    try:
        main()
    except Refused as reason:
        sys.exit(f"benchmark: {reason}")
