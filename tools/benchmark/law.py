"""The law by which an error falls with the number of photons: error^2 = floor^2 + (scale photons^-exponent)^2."""
import os

import numpy

import plot
from score import FLOOR
from tables import Table, count, percent, seconds

PHOTONS = (10000, 30000, 100000, 300000, 1000000, 3000000, 10000000)  # of one pass: three decades
CLEARLY_ABOVE = 1.1  # times the floor: nearer to it, hardly anything of an error is left to fit
ERRORS = ("ring", "pixel")


def measure(cases):
    """One table, the fits, and a plot of each scene."""
    with_folds = [c for c in cases if c.scorer.fold is not None]
    table = Table("scene", "photons", "CPU s", "ring %", "pixel %", "fold, mm")
    curves = {}
    for case in cases:
        curves[case.name] = []
        for photons in PHOTONS:
            cost, errors = case.render("--photons", photons, "--passes", 1, "--samples", 1)
            curves[case.name].append(errors)
            fold = f"{errors['fold']:.3f}" if case in with_folds else ""
            table.row(case.name, count(photons), seconds(cost), percent(errors["ring"]), percent(errors["pixel"]), fold)
    print()
    for case in with_folds:
        farthest = max(abs(e["fold"] - case.scorer.fold) for e in curves[case.name])
        print(f"- `{case.name}`: the fold lies at {case.scorer.fold:.3f} mm in the exact picture, and at most {farthest:.3f} mm off in these.")
    for name, scores in curves.items():
        for k, kind in enumerate(ERRORS):
            print(f"- `{name}`: " + sentence(kind, [s[kind] for s in scores], FLOOR[name][k]))
    for case in cases:
        plot.write(os.path.join(case.folder, f"{case.name}_law.svg"), f"{case.name}: error against photons", "photons", "relative RMS error, %",
                   {kind: [(n, 100 * s[kind]) for n, s in zip(PHOTONS, curves[case.name])] for kind in ERRORS})


def sentence(kind, errors, floor):
    known, (exponent, fitted) = above(PHOTONS, errors, floor), fit(PHOTONS, errors)
    falls = f"falls as photons^-{known:.2f} above" if known else "begins at"
    return (f"the {kind} error {falls} the mesh's {100 * floor:.1f} %; with the floor fitted too, it falls as photons^-{exponent:.2f} "
            f"above {100 * fitted:.1f} %.")


def above(photons, errors, floor):
    """Exponent above a known floor, from the errors that are clearly above it; None if fewer than two are."""
    chosen = [(n, e) for n, e in zip(photons, errors) if e > CLEARLY_ABOVE * floor]
    if len(chosen) < 2:
        return None
    n, e = numpy.array(chosen).T
    return -float(numpy.polyfit(numpy.log(n), 0.5 * numpy.log(e ** 2 - floor ** 2), 1)[0])


def fit(photons, errors):
    """(exponent, floor) of least squares of the logarithms, the best of a fine grid. The floor, fitted too, is the error that all the
    photons of the world would leave: the mesh's facets, and what the program gets wrong."""
    photons, errors = numpy.asarray(photons, float), numpy.asarray(errors, float)
    best = (numpy.inf,)
    for exponent in numpy.arange(0.02, 1.5, 0.01):
        falling = photons ** -exponent
        falling = (errors[0] / falling[0]) * falling * numpy.geomspace(0.3, 3, 201)[:, None]
        for floor in numpy.linspace(0, 0.999 * errors.min(), 60):
            misfit = numpy.sum(numpy.log(numpy.hypot(floor, falling) / errors) ** 2, axis=1).min()
            if misfit < best[0]:
                best = (misfit, float(exponent), float(floor))
    return best[1:]
