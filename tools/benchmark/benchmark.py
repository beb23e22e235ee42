"""Measures Meniscal as a whole process, started cold, against scenes whose caustic is known exactly, and against POV-Ray."""
import argparse
import os
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.normpath(os.path.join(HERE, "..", ".."))
sys.path.insert(1, os.path.join(ROOT, "tools", "scenes"))

import depression  # noqa: E402
import equal_time  # noqa: E402
import exr  # noqa: E402
import law  # noqa: E402
import plot  # noqa: E402
import povray  # noqa: E402
from process import Meniscal, least_cpu_seconds  # noqa: E402
from score import SIDE, Scorer, irradiance  # noqa: E402

LAW_PASSES = 16  # enough to average a pixel's area
LAW_PHOTONS = (10000, 30000, 100000, 300000, 1000000, 3000000, 10000000)  # of all passes: three decades
LADDER = ((100000, 1), (300000, 1), (1000000, 1), (300000, 4), (1000000, 4))  # photons per pass, passes: to compare with POV-Ray
POVRAY_COUNTS = ((1000000, False), (10000000, True))  # photons; whether pixels are antialiased, which pays with many photons alone


class Case:
    """One scene, with everything that has been measured on it."""

    def __init__(self, name, meniscal, options):
        self.name, self.meniscal, self.options = name, meniscal, options
        self.scorer = Scorer(name)
        self.rows = []  # (CPU seconds, scores) of meniscal

    def measure(self, label, *settings, repeats=None):
        """Renders, prints a row of the table."""
        scene, output = (os.path.join(self.options.folder, f"{self.name}.{ending}") for ending in ("gltf", "exr"))
        command = self.meniscal.command(scene, output, "--resolution", f"{SIDE}x{SIDE}", "--diffuse-bounces", 0, *settings)
        seconds = least_cpu_seconds(command, repeats or self.options.repeats)
        scores = self.scorer.score(irradiance(exr.read(output)))
        self.rows.append((seconds, scores))
        self.print_row(label, seconds, scores)
        return scores

    def print_row(self, label, seconds, scores):
        print(f"{self.name:<8}{label:<34}{seconds:>9.2f}{100 * scores['ring']:>9.2f}{100 * scores['pixel']:>9.2f}{scores['flux']:>9.4f}",
              flush=True)

    def measure_settings(self):
        if self.meniscal.has("--quality"):
            for quality in ("draft", "final"):
                self.measure(f"--quality {quality}", "--quality", quality)
        else:
            self.measure("--photons 60000 --passes 1", "--photons", 60000, "--passes", 1)
            self.measure("--photons 250000 --passes 16", "--photons", 250000, "--passes", 16)

    def measure_law(self):
        """Error against photons, fitted and drawn."""
        scores = []
        for photons in LAW_PHOTONS:
            each = photons // LAW_PASSES
            scores.append(self.measure(f"--photons {each} --passes {LAW_PASSES}", "--photons", each, "--passes", LAW_PASSES, repeats=1))
        for error in ("ring", "pixel"):
            exponent, floor = law.fit(LAW_PHOTONS, [s[error] for s in scores])
            print(f"{self.name:<8}{error} error falls as photons^-{exponent:.2f} above a floor of {100 * floor:.2f} %")
        path = os.path.join(self.options.folder, f"{self.name}_law.svg")
        plot.write(path, f"{self.name}: error against photons", "photons", "relative RMS error",
                   {error: [(n, s[error]) for n, s in zip(LAW_PHOTONS, scores)] for error in ("ring", "pixel")})

    def measure_povray(self):
        """How many times the CPU seconds of ours POV-Ray takes: those of our cheapest picture that is at least as good as its."""
        for photons, passes in LADDER:
            self.measure(f"--photons {photons} --passes {passes}", "--photons", photons, "--passes", passes)
        for count, antialias in POVRAY_COUNTS:
            seconds, image = povray.render(self.name, count, self.options.folder, antialias)
            scores = self.scorer.score(image)
            self.print_row(f"POV-Ray, {count} photons", seconds, scores)
            ours = [s for s, own in self.rows if own["ring"] <= scores["ring"] and own["pixel"] <= scores["pixel"]]
            print(f"{self.name:<8}" + (f"{seconds / min(ours):.1f} times the CPU seconds of Meniscal ({min(ours):.2f}) for such errors"
                                       if ours else "no picture of Meniscal above has errors as small"))


def main():
    parser = argparse.ArgumentParser(prog="tools/benchmark.sh", description=__doc__)
    parser.add_argument("--scenes", default="dep,fibdep", help="of dep (a post of 4 mm) and fibdep (a fibre of 0.1 mm); default both")
    parser.add_argument("--repeats", type=int, default=3, metavar="K", help="runs of each setting; the cheapest counts (default 3)")
    parser.add_argument("--law", action="store_true", help="also error against photons over three decades, some minutes")
    parser.add_argument("--povray", action="store_true", help="also POV-Ray (package povray), on the same meshes")
    parser.add_argument("--equal-time", nargs="?", const=os.path.join(ROOT, "scenes", "shadow_sausage.gltf"), metavar="SCENE",
                        help="instead: targeted against ordinary photon maps at equal CPU seconds, by default on shadow_sausage")
    parser.add_argument("--budgets", default="3,6,12,24", metavar="S,...", help="CPU seconds for --equal-time (default 3,6,12,24)")
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
    if options.povray and not povray.program():
        sys.exit("benchmark: --povray: POV-Ray is not installed; install the package povray")

    depression.write_scenes(options.folder)
    print(f"{'scene':<8}{'settings':<34}{'CPU s':>9}{'ring %':>9}{'pixel %':>9}{'flux':>9}")
    for name in names:
        case = Case(name, meniscal, options)
        case.measure_settings()
        if options.law:
            case.measure_law()
        if options.povray:
            case.measure_povray()


if __name__ == "__main__":
    main()
