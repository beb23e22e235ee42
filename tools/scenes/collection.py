"""The paper's figure 11: a vase, a spider, a heart, a bird and an umbrella in a dish of slightly wavy water, under several lights.
Lengths in millimetres."""
import math

from bodies import loft, moved, sheet, tapered_rod, turned, united
from curves import b_spline, circle, evened, superellipse
from gltf_writer import rotation
from materials import matte, water
from shapes import rectangle
from stage import Stage, add_lamp, add_sun, dish

DEPTH = 38
HALF_X, HALF_Z = 84, 62  # of the water


def wave(x, z):
    """Height and slopes of water that has nearly come to rest."""
    height = dx = dz = 0
    for amplitude, length, towards, phase in ((0.30, 47, 20, 0.3), (0.22, 31, 75, 1.9), (0.16, 24, 140, 4.0), (0.1, 19, 105, 2.2)):
        k = 2 * math.pi / length
        kx, kz = k * math.cos(math.radians(towards)), k * math.sin(math.radians(towards))
        height += amplitude * math.sin(kx * x + kz * z + phase)
        slope = amplitude * math.cos(kx * x + kz * z + phase)
        dx, dz = dx + kx * slope, dz + kz * slope
    return height, dx, dz


def vase():
    """It stands on the floor; its hollow ends above the level."""
    outside = [(0, -DEPTH - 1), (9, -DEPTH - 1), (9, -DEPTH + 1), (11, -DEPTH + 8), (17, -16), (16, -2), (10, 14), (5, 24), (5, 30), (9, 38)]
    inside = [(8.5, 39.5), (7, 38), (3.6, 30), (3.4, 24), (0, 20)]
    return turned(b_spline(outside + inside, 40), circle(64))


def heart():
    """A cushion over a heart's outline, whose notch and tip are rounded; its facets meet at the same angle all the way up."""
    outline = []
    for k in range(2000):
        t = 2 * math.pi * k / 2000
        z = 13 * math.cos(t) - 5 * math.cos(2 * t) - 2 * math.cos(3 * t) - math.cos(4 * t)
        outline.append((0.9 * math.sin(t) - 0.1 * math.sin(3 * t), 0.1 - z / 16))
    half, high = 14, 7
    leans = [math.pi * k / 27 for k in range(28)]
    angles = [math.atan2(half * math.sin(a), high * math.cos(a)) for a in leans]
    return turned([(half * math.sin(a), -high * math.cos(a)) for a in angles], evened(outline, 120))


def ball(centre, radii, around, rings):
    x, y, z = radii
    angles = [math.pi * k / rings for k in range(rings + 1)]
    return moved(turned([(math.sin(a), -y * math.cos(a)) for a in angles], [(x * c, z * s) for c, s in circle(around)]), centre)


def bird():
    """Looks along +x. Body with tail: rings across, of their own width and height."""
    spine = b_spline([(-22, 11, 1.2, 0.7), (-20, 10, 2.6, 1.2), (-15, 5.5, 5.5, 3.4), (-8, 2.5, 8.8, 6.6), (0, 2, 10, 8.2), (8, 3, 8.8, 8.4),
                    (13, 5.5, 5.5, 5.8), (14.5, 6.5, 1.5, 1.5)], 90)
    rings = [[(x, y + high * s, wide * c) for c, s in circle(64)] for x, y, wide, high in spine]
    body = loft(rings, (-22.4, 11.1, 0), (14.9, 6.6, 0))
    head = ball((11.5, 15.5, 0), (6, 5.8, 5.6), 32, 16)
    return united([body, head])


def beak():
    return tapered_rod([(15, 15.2, 0), (18, 15, 0), (21.5, 14.4, 0)], (2.2, 1.5, 0.4), 20)


def spider():
    """Two balls on eight bent legs, whose feet dimple the water."""
    parts = [ball((-5, 7.5, 0), (7, 5.2, 5.6), 40, 18), ball((4.5, 6.2, 0), (4.2, 3.2, 3.6), 32, 14)]
    for side in (-1, 1):
        for along, reach, turn in ((4.5, 21, 38), (3.5, 17, 72), (2.2, 17, 106), (1, 22, 140)):
            c, s = math.cos(math.radians(turn)), side * math.sin(math.radians(turn))
            leg = [(1, 6), (0.3 * reach, 12), (0.55 * reach, 13), (0.75 * reach, 9), (0.9 * reach, 3), (reach, -2.5)]
            path = b_spline([(along + r * c, y, r * s) for r, y in leg], 18)
            parts.append(tapered_rod(path, [0.75 - 0.35 * k / 18 for k in range(19)], 16, 2))
    return united(parts)


def shaft():
    """The umbrella stands along +y; its handle is a hook that comes up again."""
    hook = [(-11, 3.5), (-11, 0), (-11, -5), (-9, -10), (-5.5, -12), (-2, -10), (0, -5), (0, 0), (0, 10)]
    path = b_spline([(x, y, 0) for x, y in hook], 32) + [(0, 10 + 6 * k, 0) for k in range(1, 13)]
    return tapered_rod(path, [1.5] * len(path), 32)


def canopy():
    """Eight ribs, between which the cloth sags."""
    radius, high, top, thick = 30, 11, 80, 0.7

    def ring(part, below):
        points = []
        for c, s in circle(48):
            ribs = 0.5 - 0.5 * math.cos(8 * math.atan2(s, c))
            r = radius * part * (1 - 0.07 * ribs * part)
            points.append((r * c, top - high * part ** 2 - 1.5 * ribs * part * (1 - part) - below, r * s))
        return points

    parts = [k / 8 for k in range(1, 9)]
    return loft([ring(p, 0) for p in parts] + [ring(1.008, thick / 2)] + [ring(p, thick) for p in reversed(parts)], (0, top, 0), (0, top - thick, 0))


def collection():
    stage = Stage()
    stage.mesh("table", rectangle(-200, 220, -230, 130), matte(stage, "table", (0.09, 0.12, 0.14), meniscus_ignore=1), (0, -DEPTH - 4, 0))
    stage.mesh("dish", dish(HALF_X, HALF_Z, DEPTH, 128), matte(stage, "dish", (0.6, 0.55, 0.48), meniscus_contact_angle=35))
    liquid = water(stage, DEPTH, meniscus_tolerance=4e-6)
    stage.mesh("water", sheet(superellipse(HALF_X, HALF_Z, 96, 4), 24, wave), liquid)
    stage.mesh("vase", vase(), stage.material("vase", (0.05, 0.3, 0.33), 0.25, meniscus_contact_angle=30), (-46, 0, -22))
    red = stage.material("heart", (0.62, 0.04, 0.06), 0.2, meniscus_contact_angle=55)
    stage.mesh("heart", heart(), red, (31, 0.5, 26), rotation=rotation((0, 1, 0), -25))
    swims = {"at": (-30, -2, 27), "rotation": rotation((0, 1, 0), 25)}
    stage.mesh("bird", bird(), stage.material("bird", (0.85, 0.55, 0.08), 0.4, meniscus_contact_angle=45), **swims)
    stage.mesh("beak", beak(), stage.material("beak", (0.8, 0.22, 0.03), 0.3, meniscus_ignore=1), **swims)
    black = stage.material("spider", (0.03, 0.025, 0.03), 0.35, meniscus_contact_angle=115)
    stage.mesh("spider", spider(), black, (2, 0, -14), rotation=rotation((0, 1, 0), 200))
    leans = {"at": (44, 0, -20), "rotation": rotation((0, 0, 1), -36)}
    stage.mesh("umbrella's handle", shaft(), stage.material("wood", (0.35, 0.17, 0.07), 0.35, meniscus_contact_angle=40), **leans)
    stage.mesh("umbrella", canopy(), matte(stage, "cloth", (0.75, 0.25, 0.3), meniscus_ignore=1), **leans)
    add_sun(stage, 80, (-70, 130, -40), (1, 0.95, 0.86))
    stage.light("spot", "spot", 1.9, (210, 270, 130), color=[0.72, 0.86, 1],
                spot={"innerConeAngle": math.radians(35), "outerConeAngle": math.radians(50)})
    # Level water mirrors the lamp to where the dish ends: what is seen of it stands on menisci, on their sides towards the camera.
    add_lamp(stage, "lamp", rectangle(-80, 80, -4, 4), 800, at=(-20, 330, -5), rotation=rotation((1, 0, 0), 180))
    stage.camera((0, 250, 160), (8, -6, -4), yfov=32)
    return stage
