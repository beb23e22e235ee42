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
        options = (scene, os.path.join(self.folder, "growth.exr"), "--resolution", f"{side}x{side}", "--photons", photons, "--passes", 1,
                   "--samples", 1, "--diffuse-bounces", 0)
        spent, statistics = self.meniscal.render(*options, warm=True)
        if spent < LONG:
            spent = min(spent, self.meniscal.render(*options, warm=True, repeats=3)[0])
        return spent, statistics["bytes"]["device_peak"], statistics["bytes"]["host_peak"]


def measure(meniscal, folder):
    """A table for each sweep, then what they say."""
    sweep = Sweep(meniscal, folder)
    scene = growth_scenes.write("depression", 50000, folder)
    start = sweep.render(scene, FEW, SIDE)
    findings = [by_units("photon", PHOTONS, start, (sweep.render(scene, n, SIDE) for n in PHOTONS))]
    start = sweep.render(scene, 100000, 16)
    findings.append(by_units("pixel", [s * s for s in SIDES], start, (sweep.render(scene, 100000, s) for s in SIDES)))
    findings.append(by_scenes(sweep, "triangle", TRIANGLES, "depression"))
    findings.append(by_scenes(sweep, "post", POSTS, "posts"))
    for finding in findings:
        print(f"- {finding}")


def by_units(unit, counts, start, runs):
    """start: the run with next to none; runs: one for each count, taken as they come."""
    table = Table(f"{unit}s", "CPU s", f"CPU µs a {unit}", "device MiB", "host MiB", f"device bytes a {unit} more", "host", words=0)
    last, work = None, []
    for n, run in zip(counts, runs):
        spent, device, host = run
        work.append(spent - start[0])
        more = bytes_more(n, run, last)
        table.row(count(n), seconds(spent), microseconds(work[-1] / n), f"{device / MIB:.0f}", f"{host / MIB:.0f}", *more)
        last = n, run
    print()
    large = [(n, w) for n, w in zip(counts, work) if w > start[0]]
    power = f"{unit}s^{slope(*zip(*large)):.2f}" if len(large) > 1 else "no power that could be told from what every picture costs"
    return (f"CPU seconds beyond the {start[0]:.2f} of a picture with next to none grow as {power}, to {microseconds(work[-1] / n)} µs a {unit} "
            f"at {count(n)}; device memory by {more[0]} bytes with each {unit} more, to {device / MIB:.0f} MiB.")


def by_scenes(sweep, unit, counts, kind):
    """kind: of growth_scenes. What the scene itself takes, and what a photon takes in it."""
    table = Table(f"{unit}s", "CPU s before the first photon", f"CPU µs a {unit}", "CPU µs a photon", "device MiB", "host MiB",
                  f"device bytes a {unit} more", "host", words=0)
    measured, last, refused = [], None, ""
    for n in counts:
        scene = growth_scenes.write(kind, n, sweep.folder)
        try:
            few, many = sweep.render(scene, FEW, 64), sweep.render(scene, MANY, 64)
        except Refused as reason:
            print(f"\n{count(n)} {unit}s: {reason}")
            refused = f" {count(n)} are more than the device holds."
            break
        finally:
            os.remove(scene)
        a_photon = (many[0] - few[0]) / (MANY - FEW)
        measured.append((n, few[0], a_photon))
        more = bytes_more(n, few, last)
        table.row(count(n), seconds(few[0]), microseconds(few[0] / n), microseconds(a_photon), f"{few[1] / MIB:.0f}",
                  f"{few[2] / MIB:.0f}", *more)
        last = n, few
    print()
    n, before, a_photon = zip(*measured)
    each = numpy.polyfit(numpy.log2(n), 1e6 * numpy.array(a_photon), 1)[0]
    return (f"With {count(n[0])} to {count(n[-1])} {unit}s a photon's CPU seconds grow as {unit}s^{slope(n, a_photon):.2f}: {each:+.2f} µs with "
            f"every doubling. The scene itself takes {before[-1]:.1f} CPU s at last and {more[0]} bytes on the device with each {unit} more."
            + refused)


def bytes_more(n, run, last):
    """Of device and host, for every unit more than in the run before."""
    return [count(round((run[k] - last[1][k]) / (n - last[0]))) for k in (1, 2)] if last else ["", ""]


def microseconds(seconds_each):
    return f"{1e6 * seconds_each:.2f}" if seconds_each < 1e-4 else count(round(1e6 * seconds_each))


def slope(counts, costs):
    """Of the logarithms."""
    if min(costs) <= 0:
        raise SystemExit("benchmark: --growth: more work cost fewer CPU seconds; the machine is too busy to measure")
    return float(numpy.polyfit(numpy.log(counts), numpy.log(costs), 1)[0])
