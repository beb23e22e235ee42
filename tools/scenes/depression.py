"""The benchmark's scenes: a post in a depression of the water whose caustic is known exactly. The surface is a mesh of analytic heights
and normals: h(r) = -depth K0(r/L) / K0(R/L), the small-slope meniscus of a cylinder of radius R, flat beyond it."""
import math
import os
import sys

from curves import circle
from gltf_writer import MM, Scene
from materials import WATER, clear, matte
from shapes import cylinder, square

CAPILLARY_LENGTH = 2.727 * MM
RINGS, AROUND = 96, 256  # rows and columns of the surface's mesh, by default
WATER_DEPTH = 50 * MM
WATER_HALF_WIDTH = 60 * MM


def bessel_k(order, x):
    """Modified Bessel function of the second kind, order 0 or 1, x > 0: the integral of exp(-x cosh t) cosh(order t) over t > 0 by the
    trapezoidal rule, which converges exponentially here."""
    step = 1 / 64
    terms = (math.exp(-x * math.cosh(k * step)) * math.cosh(order * k * step) for k in range(1, 12 * 64))
    return step * (0.5 * math.exp(-x) + math.fsum(terms))


def stitched(rings, around):
    """Triangles between consecutive rings of `around` vertices, counter-clockwise from above where rings grow."""
    quads = [(around * i + k, around * i + (k + 1) % around) for i in range(rings - 1) for k in range(around)]
    return [(a, b + around, a + around) for a, b in quads] + [(a, b, b + around) for a, b in quads]


def depression(radius, depth, radii, around):
    """The surface over the rings `radii`, the first at the post."""
    at_post = bessel_k(0, radius / CAPILLARY_LENGTH)
    positions, normals, directions = [], [], circle(around)
    for r in radii:
        height = -depth * bessel_k(0, r / CAPILLARY_LENGTH) / at_post
        slope = depth * bessel_k(1, r / CAPILLARY_LENGTH) / (at_post * CAPILLARY_LENGTH)
        positions += [(r * c, height, r * s) for c, s in directions]
        normals += [tuple(n / math.hypot(1, slope) for n in (-slope * c, 1, -slope * s)) for c, s in directions]
    return positions, normals, stitched(len(radii), around)


def flat_rest(inner, around):
    """From the circle of radius `inner` to the edge of the square that the water fills."""
    edge = [(WATER_HALF_WIDTH * c / max(abs(c), abs(s)), 0, WATER_HALF_WIDTH * s / max(abs(c), abs(s))) for c, s in circle(around)]
    positions = [(inner * c, 0, inner * s) for c, s in circle(around)] + edge
    return positions, [(0, 1, 0)] * len(positions), stitched(2, around)


class Parts:
    """Meshes of a scene round the post of `radius`, and half the width that is seen of it."""

    def __init__(self, radius, depth, radii, half_width, around=AROUND):
        self.half_width = half_width
        self.floor = square(WATER_HALF_WIDTH, -WATER_DEPTH)
        self.meniscus = depression(radius, depth, radii, around)
        self.rest = flat_rest(radii[-1], around)
        self.post = cylinder(radius, (0, -WATER_DEPTH, 0), (0, 10 * MM, 0), around)


def scene(parts):
    """Seen from below the surface; the sun is vertical, 1 lx."""
    result = Scene()

    def grey(name):
        return matte(result, name, 0.5, meniscus_ignore=1)

    def water(name, **extras):
        return clear(result, name, WATER, 0.01, **extras)

    result.mesh("floor", parts.floor, grey("floor"))
    result.mesh("meniscus", parts.meniscus, water("meniscus", meniscus_target=1))
    result.mesh("water", parts.rest, water("flat water"))
    result.mesh("post", parts.post, grey("post"))
    result.light("sun", "directional", 1, (0, 100 * MM, 0))
    result.camera((0, -4 * MM, 0), (0, -WATER_DEPTH, 0), half_width=parts.half_width)
    return result


def dep(fineness=1):
    """A post of 4 mm: rings densest where the surface is steepest; `fineness` times as many rows and columns."""
    rings, around = round(fineness * RINGS), round(fineness * AROUND)
    return Parts(2 * MM, 1.5 * MM, [2 * MM + 12 * MM * (i / rings) ** 2 for i in range(rings + 1)], 12.2 * MM, around)


def fibdep():
    """A fibre of 0.1 mm: each ring wider than the last by the same factor."""
    inner, outer = 0.05 * MM, 12.05 * MM
    return Parts(inner, 0.2 * MM, [inner * (outer / inner) ** (i / RINGS) for i in range(RINGS + 1)], 3.2 * MM)


SCENES = {"dep": dep, "fibdep": fibdep}


def write_scenes(folder):
    """Writes FOLDER/NAME.gltf for all SCENES."""
    os.makedirs(folder, exist_ok=True)
    for name, parts in SCENES.items():
        scene(parts()).write(os.path.join(folder, name + ".gltf"))


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit("usage: tools/scenes/depression.py FOLDER")
    write_scenes(sys.argv[1])
