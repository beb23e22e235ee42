#!/usr/bin/env python3
"""Writes scenes/NAME.gltf: the paper's figures, and the scenes with analytic answers, which are made here.

Usage: tools/scenes/make_scenes.py NAME...|all"""
import math
import os
import sys

import hairs
import rods
import rooms
import vessels
from collection import collection
from glass_of_water import glass_of_water
from gltf_writer import MM, Scene, rotation
from materials import clear, matte
from paper_clip import paper_clip
from shapes import box, cylinder, sphere, square
from stage import add_lamp, add_water
from teapot import teapot

CAMERA_DEPTH = 6 * MM       # below every meniscus and every stub: the camera sees the floor directly
VIEW_HALF_WIDTH = 12.2 * MM  # that of the reference tables


def bench(depth=50 * MM, sun=True, camera=True):
    """Water over a Lambertian floor, seen from below the surface; the sun is vertical, 1 lx."""
    scene = Scene()
    scene.mesh("floor", square(32 * MM, -depth), matte(scene, "floor", 0.5, meniscus_ignore=1))
    add_water(scene, 30 * MM, depth)
    if camera:
        scene.camera((0, -CAMERA_DEPTH, 0), (0, -depth, 0), half_width=VIEW_HALF_WIDTH)
    if sun:
        scene.light("sun", "directional", 1, (0, 100 * MM, 0))
    return scene


def add_post(scene, bottom, x=0.0, material=None):
    """Posts that stand on the floor reach 1 mm into it: no two faces coincide."""
    if material is None:
        material = matte(scene, "post", 0, meniscus_contact_angle=30)
    name = "post" if x == 0 else f"post {'left' if x < 0 else 'right'}"
    scene.mesh(name, cylinder(2 * MM, (x, bottom, 0), (x, 10 * MM, 0), 256), material)
    return material


def post():
    scene = bench()
    add_post(scene, -51 * MM)
    return scene


def post_stub():
    scene = bench()
    add_post(scene, -5 * MM)
    return scene


def flat_water():
    return bench()


def two_posts():
    """Gap 1 mm, as in evolver_two_*.csv."""
    scene = bench(depth=20 * MM)
    material = add_post(scene, -21 * MM, x=-2.5 * MM)
    add_post(scene, -21 * MM, x=2.5 * MM, material=material)
    return scene


def sphere_scene():
    scene = bench(depth=20 * MM)
    scene.mesh("sphere", sphere(4 * MM, (0, 0, 0), 96, 47), matte(scene, "sphere", 0, meniscus_contact_angle=30))
    return scene


def box_scene():
    scene = bench(depth=20 * MM)
    scene.mesh("box", box((-4 * MM, -5 * MM, -4 * MM), (4 * MM, 5 * MM, 4 * MM)),
               matte(scene, "box", 0, meniscus_contact_angle=30), rotation=rotation((0, 1, 0), 30))
    return scene


def area_light():
    scene = bench(sun=False)
    add_post(scene, -51 * MM)
    add_lamp(scene, "lamp", square(15 * MM, 100 * MM, facing=-1), 10)
    return scene


def point_light():
    scene = bench(sun=False)
    add_post(scene, -51 * MM)
    scene.light("lamp", "point", 0.01, (10 * MM, 100 * MM, 0))
    return scene


def spot_light():
    scene = bench(sun=False)
    add_post(scene, -51 * MM)
    scene.light("lamp", "spot", 0.01, (10 * MM, 100 * MM, 0),
                spot={"innerConeAngle": math.radians(2), "outerConeAngle": math.radians(6)})
    return scene


def three_lights():
    """A tilted sun, a bulb and a square lamp, about as bright on the floor."""
    scene = bench(sun=False)
    add_post(scene, -51 * MM)
    scene.light("sun", "directional", 0.6, (-15 * MM, 100 * MM, 12 * MM))
    scene.light("bulb", "point", 0.02, (25 * MM, 200 * MM, -15 * MM))
    add_lamp(scene, "lamp", square(10 * MM, 200 * MM, facing=-1), 60)
    return scene


def behind_glass():
    """The bright ring round a water-repellent post through the water's surface and two panes above it."""
    scene = bench(camera=False)
    add_post(scene, -51 * MM, material=matte(scene, "post", 0.5, meniscus_contact_angle=150))
    glass = clear(scene, "glass", 1.5, 3 * MM)
    for y in (60 * MM, 80 * MM):
        scene.mesh(f"pane at {1000 * y:.0f} mm", box((-25 * MM, y, 5 * MM), (25 * MM, y + 3 * MM, 75 * MM)), glass)
    scene.camera((0, 120 * MM, 60 * MM), (0, -45 * MM, 0), yfov=9)
    return scene


SCENES = {"area_light": area_light, "behind_glass": behind_glass, "box": box_scene, "collection": collection, "flat_water": flat_water,
          "glass_of_water": glass_of_water, "paper_clip": paper_clip, "point_light": point_light, "post": post, "post_stub": post_stub,
          "sphere": sphere_scene, "spot_light": spot_light, "teapot": teapot, "three_lights": three_lights, "two_posts": two_posts,
          **hairs.SCENES, **rods.SCENES, **rooms.SCENES, **vessels.SCENES}


def main(names):
    if not names or any(name not in SCENES and name != "all" for name in names):
        sys.exit(f"{__doc__}\nNAME is one of: {', '.join(sorted(SCENES))}")
    folder = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "scenes")
    os.makedirs(folder, exist_ok=True)
    for name in SCENES if "all" in names else names:
        SCENES[name]().write(os.path.join(folder, name + ".gltf"))


if __name__ == "__main__":
    main(sys.argv[1:])
