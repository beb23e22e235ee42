"""Leaning rods: two whose caustics meet, and one that touches the water with its end. Lengths in millimetres."""
import math

from bodies import sheet
from curves import superellipse
from gltf_writer import rotation
from materials import matte, water
from shapes import cylinder, rectangle
from stage import Stage, add_lamp, add_sun, dish

def bowl_of_water(radius, depth):
    """On a dark table, in a light bowl."""
    stage = Stage()
    stage.mesh("table", rectangle(-120, 120, -150, 90), matte(stage, "table", (0.16, 0.085, 0.045), meniscus_ignore=1), (0, -depth - 4, 0))
    stage.mesh("bowl", dish(radius, radius, depth, 128, power=2, rim=6), matte(stage, "bowl", (0.64, 0.56, 0.45), meniscus_contact_angle=35))
    liquid = water(stage, depth, meniscus_tolerance=3e-6)
    stage.mesh("water", sheet(superellipse(radius, radius, 128, 2), 8), liquid)
    return stage


def rod(radius, at, towards, lean, below, above):
    """Pierces the level at (x, z), leans by `lean` degrees from the vertical towards a heading in degrees from +x to +z."""
    x, z = at
    heading = math.radians(towards)
    a = math.sin(math.radians(lean))
    way = (a * math.cos(heading), math.cos(math.radians(lean)), a * math.sin(heading))
    ends = [tuple(p + along * w for p, w in zip((x, 0, z), way)) for along in (-below, above)]
    return cylinder(radius, *ends, 96, 24)


def two_rods():
    """Chopsticks: the lights of their menisci meet on the floor."""
    stage = bowl_of_water(46, 30)
    stage.mesh("red rod", rod(1.6, (-4.5, -4), -12, 38, 36, 54), stage.material("red", (0.5, 0.035, 0.03), 0.25, meniscus_contact_angle=30))
    stage.mesh("black rod", rod(1.6, (4.5, 0), 192, 38, 36, 54), stage.material("black", (0.02, 0.02, 0.025), 0.35, meniscus_contact_angle=30))
    add_sun(stage, 70, (-44, 130, -85), (1, 0.95, 0.86))
    add_lamp(stage, "lamp", rectangle(-60, 60, -4, 4), 500, at=(-10, 300, 10), rotation=rotation((1, 0, 0), 180))
    stage.camera((0, 160, 95), (1, -12, 0), yfov=23)
    return stage


def rod_end():
    """The end of a rod at 45 degrees is half in the water: its rim holds the contact line there, and the caustic closes round the end's shadow."""
    stage = bowl_of_water(42, 36)
    stage.mesh("rod", rod(2.5, (0, -6), -15, 45, 1.5, 52), stage.material("rod", (0.04, 0.1, 0.2), 0.5, meniscus_contact_angle=40))
    add_sun(stage, 90, (0, 130, -25), (1, 0.95, 0.86))
    add_lamp(stage, "lamp", rectangle(-60, 60, -4, 4), 400, at=(-10, 300, 10), rotation=rotation((1, 0, 0), 180))
    stage.camera((0, 120, 62), (3, -12, -3), yfov=18)
    return stage


SCENES = {"rod_end": rod_end, "two_rods": two_rods}
