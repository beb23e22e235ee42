"""How cost grows: CPU seconds and bytes against photons, pixels, triangles and targets. Each sweep varies one of them. Shader caches are
warm, and what the same picture costs with next to none of it is taken off before a slope is fitted: what is left is the work itself."""
import os

import numpy

import growth_scenes
from process import Refused
from score import SIDE
from tables import Table, count, seconds

MIB = 2 ** 20
PHOTONS = (100000, 300000, 1000000, 3000000, 10000000, 100000000)
SIDES = (64, 128, 256, 512, 1024, 2048)
TRIANGLES = (10000, 100000, 1000000, 5000000)
POSTS = (1, 4, 16, 64)
FEW, MANY = 1000, 1000000  # photons: of what they cost more, a photon's share
LONG = 3.0                 # CPU seconds: above, one run is enough


class Sweep:
    def __init__(self, meniscal, folder):
        self.meniscal, self.folder = meniscal, folder

    def render(self, scene, photons, side):
        """CPU seconds, and the peaks of device and host, bytes."""
        options = (scene, os.path.join(self.folder, "growth.exr"), "--resolution", f"{side}x{side}", "--photons", photons, "--passes", 1)
        spent, statistics = self.meniscal.render(*options, warm=True)
        if spent < LONG:
            spent = min(spent, self.meniscal.render(*options, warm=True, repeats=3)[0])
        return spent, statistics["bytes"]["device_peak"], statistics["bytes"]["host_peak"]


def measure(meniscal, folder):
    sweep = Sweep(meniscal, folder)
    scene = growth_scenes.depression(folder, 50000)
    start = sweep.render(scene, FEW, SIDE)
    by_units("photon", PHOTONS, start, (sweep.render(scene, n, SIDE) for n in PHOTONS))
    start = sweep.render(scene, 100000, 16)
    by_units("pixel", [s * s for s in SIDES], start, (sweep.render(scene, 100000, s) for s in SIDES))
    by_scenes(sweep, "triangle", TRIANGLES, growth_scenes.depression)
    by_scenes(sweep, "post", POSTS, growth_scenes.posts)


def by_units(unit, counts, start, runs):
    """start: the run with next to none; runs: one for each count, taken as they come."""
    table = Table(f"{unit}s", "CPU s", f"CPU µs a {unit}", "device MiB", "host MiB", f"device bytes a {unit} more", "host", words=0)
    last, work = None, []
    for n, run in zip(counts, runs):
        spent, device, host = run
        work.append(spent - start[0])
        more = [f"{(run[k] - last[1][k]) / (n - last[0]):.1f}" for k in (1, 2)] if last else ["", ""]
        table.row(count(n), seconds(spent), f"{1e6 * work[-1] / n:.2f}", f"{device / MIB:.0f}", f"{host / MIB:.0f}", *more)
        last = n, run
    print(f"\nCPU seconds beyond the {start[0]:.2f} that the picture takes with next to none grow as {unit}s^"
          f"{slope(counts, work):.2f}.\n")


def by_scenes(sweep, unit, counts, make):
    """make(folder, count): path of a scene. What the scene itself takes, and what a photon takes in it."""
    table = Table(f"{unit}s", "CPU s before the first photon", f"CPU µs a {unit}", "CPU µs a photon", "device MiB", "host MiB",
                  f"device bytes a {unit} more", "host", words=0)
    measured, last, refused = [], None, None
    for n in counts:
        scene = make(sweep.folder, n)
        try:
            few, many = sweep.render(scene, FEW, 64), sweep.render(scene, MANY, 64)
        except Refused as reason:
            refused = count(n), reason
            break
        finally:
            os.remove(scene)
        a_photon = (many[0] - few[0]) / (MANY - FEW)
        measured.append((n, few[0], a_photon))
        more = [f"{(few[k] - last[1][k]) / (n - last[0]):.0f}" for k in (1, 2)] if last else ["", ""]
        table.row(count(n), seconds(few[0]), f"{1e6 * few[0] / n:.2f}", f"{1e6 * a_photon:.2f}", f"{few[1] / MIB:.0f}",
                  f"{few[2] / MIB:.0f}", *more)
        last = n, few
    print()
    if refused:
        print(f"{refused[0]} {unit}s are refused: {refused[1]}\n")
    n, _, a_photon = zip(*measured)
    each = numpy.polyfit(numpy.log2(n), 1e6 * numpy.array(a_photon), 1)[0]
    print(f"A photon's CPU seconds grow as {unit}s^{slope(n, a_photon):.2f}: {each:+.2f} µs with every doubling.\n")


def slope(counts, costs):
    """Of the logarithms."""
    kept = [(n, c) for n, c in zip(counts, costs) if c > 0]
    if len(kept) < 2:
        return float("nan")
    return float(numpy.polyfit(*numpy.log(kept).T, 1)[0])
