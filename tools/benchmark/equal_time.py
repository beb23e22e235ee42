"""Targeted against ordinary photon maps at equal CPU seconds of the whole process: errors against a long rendering."""
import math
import os

import numpy

import exr
import plot
from process import cpu_seconds

INTEGRATORS = ("targeted", "ordinary")
PHOTONS = 100000        # per pass
RESOLUTION = "320x240"
REFERENCE_SEED, REFERENCE_PASSES = 9, 256  # another seed than the pictures that it judges
CAUSTIC_PART = 0.05     # of the brightest targeted irradiance: above it, a pixel belongs to the caustic


class Renderer:
    def __init__(self, meniscal, scene, folder):
        self.meniscal, self.scene, self.folder = meniscal, scene, folder
        self.name = os.path.splitext(os.path.basename(scene))[0]

    def path(self, ending):
        return os.path.join(self.folder, f"{self.name}_{ending}")

    def render(self, integrator, passes, output, *options):
        """CPU seconds."""
        return cpu_seconds(self.meniscal.command(self.scene, output, "--integrator", integrator, "--resolution", RESOLUTION,
                                                 "--photons", PHOTONS, "--passes", passes, *options))

    def passes_for(self, integrator):
        """A function from CPU seconds to passes: start and a pass' cost, from two runs."""
        few, many = 1, 9
        costs = [self.render(integrator, passes, self.path("trial.exr")) for passes in (few, many)]
        a_pass = (costs[1] - costs[0]) / (many - few)
        if a_pass <= 0:
            raise SystemExit(f"benchmark: {many} passes cost no more CPU seconds than {few}; the machine is too busy to measure")
        return lambda budget: max(1, round(few + (budget - costs[0]) / a_pass))


def beauty(channels):
    return numpy.stack([channels[c] for c in "RGB"])


def error(image, reference, where):
    return float(numpy.sqrt(numpy.mean((image - reference)[:, where] ** 2) / numpy.mean(reference[:, where] ** 2)))


def at_equal_time(curve, seconds):
    """Error at so many CPU seconds, on the power law between the two neighbours, or through the nearest two, of [(seconds, error)]."""
    curve = sorted(curve)
    k = min(max(1, sum(s < seconds for s, _ in curve)), len(curve) - 1)
    (s0, e0), (s1, e1) = curve[k - 1], curve[k]
    return e0 * (seconds / s0) ** (math.log(e1 / e0) / math.log(s1 / s0))


def measure(meniscal, scene, budgets, folder):
    """Prints a table, writes a picture of each integrator at the last budget and a plot."""
    if not meniscal.has("--integrator"):
        raise SystemExit("benchmark: --equal-time: this meniscal has no option --integrator; build a newer one")
    if len(budgets) < 2:
        raise SystemExit("benchmark: --budgets: give two or more, in CPU seconds; errors are compared between them")
    renderer = Renderer(meniscal, scene, folder)
    print(f"{renderer.name}: reference of {REFERENCE_PASSES} passes of {PHOTONS} photons", flush=True)
    renderer.render("targeted", REFERENCE_PASSES, renderer.path("reference.exr"), "--seed", REFERENCE_SEED, "--aov", "targeted")
    channels = exr.read(renderer.path("reference.exr"))
    reference = beauty(channels)
    targeted = sum(channels["targeted." + c] for c in "RGB")
    regions = {"image": numpy.ones(targeted.shape, bool), "caustic": targeted > CAUSTIC_PART * targeted.max()}
    print(f"caustic: {100 * regions['caustic'].mean():.1f} % of the pixels")

    print(f"{'integrator':<12}{'passes':>8}{'CPU s':>9}{'image %':>10}{'caustic %':>11}")
    curves = {(i, region): [] for i in INTEGRATORS for region in regions}
    for integrator in INTEGRATORS:
        passes_for = renderer.passes_for(integrator)
        for budget in sorted(budgets):
            passes, output = passes_for(budget), renderer.path(f"{integrator}.exr")
            seconds = renderer.render(integrator, passes, output, "--preview", renderer.path(f"{integrator}.png"))
            errors = {region: error(beauty(exr.read(output)), reference, where) for region, where in regions.items()}
            for region, value in errors.items():
                curves[integrator, region].append((seconds, value))
            print(f"{integrator:<12}{passes:>8}{seconds:>9.2f}{100 * errors['image']:>10.3f}{100 * errors['caustic']:>11.3f}", flush=True)
    print("error of ordinary / error of targeted, at equal CPU seconds:")
    for budget in sorted(budgets):
        ratios = {r: at_equal_time(curves["ordinary", r], budget) / at_equal_time(curves["targeted", r], budget) for r in regions}
        print(f"  {budget:>6.1f} CPU s: image {ratios['image']:.2f}, caustic {ratios['caustic']:.2f}")
    plot.write(renderer.path("equal_time.svg"), f"{renderer.name}: error at equal CPU seconds", "CPU seconds of the process",
               "relative RMS error", {f"{i}, {region}": curves[i, region] for i, region in curves})
    print(f"Pictures and plot: {renderer.path('*.png')}, {renderer.path('equal_time.svg')}")
