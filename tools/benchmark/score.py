"""How far a rendering of a benchmark scene is from the exact irradiance of its surface.

The truth is an image too: each pixel's mean over its area, so that a perfect, box-filtered rendering has no error. What remains of a
perfect rendering of the mesh is the error of its facets, FLOOR."""
import os

import numpy

TABLES = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "tests", "data")
ALBEDO = 0.5
SIDE = 250  # pixels
SAMPLES = 8  # of the truth along a pixel's side
FOLD_RING = 0.05  # mm, narrower than a pixel


class Case:
    def __init__(self, name, half_width, inner, outer, ring, folds):
        """Lengths in mm: half the picture's width; radii between which errors are taken; width of a ring. Whether there is a fold, the
        bright ring where the caustic begins, wider than a pixel."""
        self.name, self.half_width, self.inner, self.outer, self.ring, self.folds = name, half_width, inner, outer, ring, folds

    def radii(self, side):
        x = ((numpy.arange(side) + 0.5) / side * 2 - 1) * self.half_width
        return numpy.hypot(x[None, :], x[:, None])

    def truth(self):
        table = numpy.loadtxt(os.path.join(TABLES, self.name + "_fine.csv"), delimiter=",", skiprows=1)
        rows = numpy.searchsorted(table[:, 1], self.radii(SIDE * SAMPLES))
        irradiance = table[numpy.minimum(rows, len(table) - 1), 2]
        return irradiance.reshape(SIDE, SAMPLES, SIDE, SAMPLES).mean((1, 3))


CASES = {"dep": Case("dep", 12.2, 2, 12, 0.1, True), "fibdep": Case("fibdep", 3.2, 0.1, 3, 0.05, False)}
# Ring and pixel error of the mesh of 96 x 256 facets, however many photons.
FLOOR = {"dep": (0.016, 0.030), "fibdep": (0.021, 0.052)}


def irradiance(channels):
    """Of the floor, relative to that of a horizontal plane in the open, from a rendering's radiance; the light is 1 lx."""
    return sum(channels[c] for c in "RGB") / 3 * numpy.pi / ALBEDO


def relative_rms(difference, truth):
    return float(numpy.sqrt(numpy.mean(difference ** 2) / numpy.mean(truth ** 2)))


class Scorer:
    """Computes the truth once."""

    def __init__(self, name):
        case = CASES[name]
        radii = case.radii(SIDE)
        self.inside = (radii > case.inner) & (radii < case.outer)
        self.rings = (radii[self.inside] / case.ring).astype(int)
        self.fold_rings = (radii[self.inside] / FOLD_RING).astype(int)
        self.truth = case.truth()[self.inside]
        self.fold = self._fold(self.truth) if case.folds else None

    def _fold(self, pixels):
        """Radius of the brightest ring, mm: the top of the parabola through it and its neighbours."""
        count = numpy.bincount(self.fold_rings)
        means = numpy.bincount(self.fold_rings, pixels) / numpy.maximum(count, 1)
        k = int(means.argmax())
        before, top, after = means[k - 1:k + 2]
        return float((k + 0.5 + 0.5 * (before - after) / (before - 2 * top + after)) * FOLD_RING)

    def score(self, image):
        """ring: error of means over rings, pixel: of pixels, both relative RMS; flux: ratio of the sums; fold: its radius, mm, or None."""
        if image.shape != (SIDE, SIDE):
            raise ValueError(f"the picture has {image.shape[1]} x {image.shape[0]} pixels; render {SIDE} x {SIDE}")
        pixels = image[self.inside]
        count = numpy.bincount(self.rings)
        used = count > 0
        means, true_means = (numpy.bincount(self.rings, v)[used] / count[used] for v in (pixels, self.truth))
        return {"ring": relative_rms(means - true_means, true_means), "pixel": relative_rms(pixels - self.truth, self.truth),
                "flux": float(pixels.sum() / self.truth.sum()), "fold": None if self.fold is None else self._fold(pixels)}
