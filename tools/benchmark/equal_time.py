"""Targeted against ordinary photon maps at equal CPU seconds of the whole process: errors against a long rendering. Ordinary photon maps
are given several radii, and the best of them counts at every point."""
import math
import os

import numpy

import exr
import plot
import png
from tables import Table, seconds

PHOTONS = 100000        # per pass
RESOLUTION = "320x240"
REFERENCE_SEED, REFERENCE_PASSES = 9, 256  # another seed than the pictures that it judges
RADII = (0.0625, 0.125, 0.25, 0.5, 1)  # times the default of ordinary photon maps; wider ones blur the caustic away
CAUSTIC_PART = 0.05     # of the brightest targeted irradiance: above it, a pixel belongs to the caustic
WHITE = 2.5             # times the reference's median radiance: shown as white
GAP = 8                 # pixels between the pictures


class Renderer:
    def __init__(self, meniscal, scene, folder):
        self.meniscal, self.scene, self.output = meniscal, scene, os.path.join(folder, "equal_time.exr")

    def render(self, passes, *options):
        """CPU seconds, the statistics, the channels."""
        spent, statistics = self.meniscal.render(self.scene, self.output, "--resolution", RESOLUTION, "--photons", PHOTONS,
                                                 "--passes", passes, "--samples", 1, "--diffuse-bounces", 0, *options)
        return spent, statistics, exr.read(self.output)

    def passes_for(self, *options):
        """A function from CPU seconds to passes: start and a pass' cost, from two runs."""
        few, many = 1, 9
        costs = [self.render(passes, *options)[0] for passes in (few, many)]
        a_pass = (costs[1] - costs[0]) / (many - few)
        if a_pass <= 0:
            raise SystemExit(f"benchmark: {many} passes cost no more CPU seconds than {few}; the machine is too busy to measure")
        return lambda budget: max(1, round(few + (budget - costs[0]) / a_pass))


def beauty(channels):
    return numpy.stack([channels[c] for c in "RGB"])


def error(image, reference, where):
    return float(numpy.sqrt(numpy.mean((image - reference)[:, where] ** 2) / numpy.mean(reference[:, where] ** 2)))


def at_equal_time(curve, budget):
    """Error at so many CPU seconds, on the power law between the two neighbours, or through the nearest two, of [(seconds, error)]."""
    curve = sorted(curve)
    k = min(max(1, sum(s < budget for s, _ in curve)), len(curve) - 1)
    (s0, e0), (s1, e1) = curve[k - 1], curve[k]
    return e0 * (budget / s0) ** (math.log(e1 / e0) / math.log(s1 / s0))


def measure(meniscal, scene, budgets, folder):
    """Prints tables, writes the two pictures of the last budget as one, and a plot."""
    if len(budgets) < 2:
        raise SystemExit("benchmark: --budgets: give two or more, in CPU seconds; errors are compared between them")
    renderer = Renderer(meniscal, scene, folder)
    budgets = sorted(budgets)
    _, _, channels = renderer.render(REFERENCE_PASSES, "--seed", REFERENCE_SEED, "--aov", "targeted")
    reference, targeted = beauty(channels), sum(channels["targeted." + c] for c in "RGB")
    regions = {"image": numpy.ones(targeted.shape, bool), "caustic": targeted > CAUSTIC_PART * targeted.max()}

    table = Table("photon map", "radius", "passes", "CPU s", "image %", "caustic %", words=2)
    curves = {}

    def curve(label, radius, *options):
        """Renders at every budget; keeps the picture of the last."""
        passes_for, points = renderer.passes_for(*options), []
        for budget in budgets:
            passes = passes_for(budget)
            spent, _, channels = renderer.render(passes, *options)
            image = beauty(channels)
            errors = {name: error(image, reference, where) for name, where in regions.items()}
            points.append((spent, errors))
            table.row(label, radius, passes, seconds(spent), *(f"{100 * e:.2f}" for e in errors.values()))
        curves[label, radius] = points
        return points[-1][1]["caustic"], image

    _, ours = curve("targeted", "by photon")
    ordinary = ("--integrator", "ordinary")
    default = renderer.render(1, *ordinary)[1]["radius_m"][0]
    theirs = min((curve("ordinary", f"{1000 * factor * default:.2g} mm", *ordinary, "--radius", factor * default) for factor in RADII),
                 key=lambda result: result[0])[1]

    plotted = {}
    for region in regions:
        of = {key: [(spent, errors[region]) for spent, errors in points] for key, points in curves.items()}
        plotted[f"targeted, {region}"] = of.pop(("targeted", "by photon"))
        plotted[f"ordinary, {region}"] = [(b, min(at_equal_time(points, b) for points in of.values())) for b in budgets]
    print()
    print(f"Of the pixels, {100 * regions['caustic'].mean():.1f} % belong to the caustic. Error of ordinary photon maps, with the best radius, "
          "over that of targeted ones:\n")
    table = Table("CPU s", *regions, words=0)
    for budget in budgets:
        table.row(f"{budget:g}", *(f"{at_equal_time(plotted[f'ordinary, {r}'], budget) / at_equal_time(plotted[f'targeted, {r}'], budget):.1f}"
                                   for r in regions))
    white = WHITE * numpy.median(reference)
    pair = [png.display(image, white) for image in (theirs, ours)]
    png.write(os.path.join(folder, "equal_time.png"), numpy.hstack([pair[0], numpy.full((len(pair[0]), GAP, 3), 255, numpy.uint8), pair[1]]))
    name = os.path.splitext(os.path.basename(scene))[0]
    plot.write(os.path.join(folder, "equal_time.svg"), f"{name}: error at equal CPU seconds", "CPU seconds of the process",
               "relative RMS error, %", {name: [(x, 100 * y) for x, y in points] for name, points in plotted.items()})
    print(f"\nOrdinary beside targeted at {budgets[-1]:g} CPU s: {os.path.join(folder, 'equal_time.png')}; plot: equal_time.svg there.")
