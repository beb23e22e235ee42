#!/usr/bin/env python3
"""Writes scenes/NAME.gltf: the paper's figures and the scenes with analytic answers.

Usage: tools/scenes/make_scenes.py NAME...|all"""
import math
import os
import sys

import figures_small
import hairs
from collection import collection
from glass_of_water import glass_of_water
from gltf_writer import Scene, rotation
from rods import rod_end, two_rods
from shapes import box, boxes, cup, cylinder, frame, sphere, square

MM = 1e-3
CAMERA_DEPTH = 6 * MM       # below every meniscus and every stub: the camera sees the floor directly
VIEW_HALF_WIDTH = 12.2 * MM  # that of the reference tables


def add_water(scene, half_width, depth, level=0):
    water = scene.material("water", roughness=0, meniscus_liquid="water", extensions={
        "KHR_materials_transmission": {"transmissionFactor": 1}, "KHR_materials_ior": {"ior": 1.333},
        "KHR_materials_volume": {"thicknessFactor": depth}})
    scene.mesh("water", square(half_width, level), water)


def matte(scene, name, albedo, **properties):
    color = albedo if isinstance(albedo, tuple) else (albedo,) * 3
    return scene.material(name, color, extensions={"KHR_materials_specular": {"specularFactor": 0}}, **properties)


def bench(depth=50 * MM, camera_depth=CAMERA_DEPTH, sun=True, camera=True):
    """Water over a Lambertian floor, seen from below the surface; the sun is vertical, 1 lx."""
    scene = Scene()
    scene.mesh("floor", square(32 * MM, -depth), matte(scene, "floor", 0.5, meniscus_ignore=1))
    add_water(scene, 30 * MM, depth)
    if camera:
        scene.camera((0, -camera_depth, 0), (0, -depth, 0), half_width=VIEW_HALF_WIDTH)
    if sun:
        scene.light("sun", "directional", 1, (0, 100 * MM, 0), (0, 0, 0))
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
    lamp = matte(scene, "lamp", 0, emissive=10, meniscus_ignore=1)
    scene.mesh("lamp", square(15 * MM, 100 * MM, facing=-1), lamp)
    return scene


def point_light():
    scene = bench(sun=False)
    add_post(scene, -51 * MM)
    scene.light("lamp", "point", 0.01, (10 * MM, 100 * MM, 0), (0, 0, 0))
    return scene


def spot_light():
    scene = bench(sun=False)
    add_post(scene, -51 * MM)
    scene.light("lamp", "spot", 0.01, (10 * MM, 100 * MM, 0), (0, 0, 0),
                spot={"innerConeAngle": math.radians(2), "outerConeAngle": math.radians(6)})
    return scene


def three_lights():
    """A tilted sun, a bulb and a square lamp, about as bright on the floor."""
    scene = bench(sun=False)
    add_post(scene, -51 * MM)
    scene.light("sun", "directional", 0.6, (-15 * MM, 100 * MM, 12 * MM), (0, 0, 0))
    scene.light("bulb", "point", 0.02, (25 * MM, 200 * MM, -15 * MM), (0, 0, 0))
    lamp = matte(scene, "lamp", 0, emissive=60, meniscus_ignore=1)
    scene.mesh("lamp", square(10 * MM, 200 * MM, facing=-1), lamp)
    return scene


def behind_glass():
    """The bright ring round a water-repellent post through the water's surface and two panes above it."""
    scene = bench(camera=False)
    add_post(scene, -51 * MM, material=matte(scene, "post", 0.5, meniscus_contact_angle=150))
    glass = scene.material("glass", roughness=0, extensions={
        "KHR_materials_transmission": {"transmissionFactor": 1}, "KHR_materials_ior": {"ior": 1.5},
        "KHR_materials_volume": {"thicknessFactor": 3 * MM}})
    for y in (60 * MM, 80 * MM):
        scene.mesh(f"pane at {1000 * y:.0f} mm", box((-25 * MM, y, 5 * MM), (25 * MM, y + 3 * MM, 75 * MM)), glass)
    scene.camera((0, 120 * MM, 60 * MM), (0, -45 * MM, 0), yfov=9, aspect=4 / 3)
    return scene


def tank():
    """A closed white box, a third full of water, with a post in it and a lamp below its lid: light goes to and fro."""
    scene = Scene()
    half, depth, lid = 40 * MM, 25 * MM, 55 * MM
    wall = ((-half, -depth, -half), (half, lid, half), (-1, -1, -1, -1, -1, -1))
    outside = ((-half - 2 * MM, -depth - 2 * MM, -half - 2 * MM), (half + 2 * MM, lid + 2 * MM, half + 2 * MM), (1, 1, 1, 1, 1, 1))
    scene.mesh("tank", boxes([wall, outside]), matte(scene, "wall", (0.7, 0.65, 0.6), meniscus_contact_angle=60))
    add_water(scene, half + 1 * MM, depth)
    scene.mesh("post", cylinder(4 * MM, (0, -depth - 1 * MM, 0), (0, 15 * MM, 0), 96), matte(scene, "post", (0.6, 0.2, 0.15), meniscus_contact_angle=30))
    scene.mesh("lamp", square(20 * MM, lid - 1 * MM, facing=-1), matte(scene, "lamp", 0, emissive=4, meniscus_ignore=1))
    scene.camera((10 * MM, 40 * MM, 38 * MM), (0, -12 * MM, -4 * MM), yfov=60, aspect=4 / 3)
    return scene


def materials():
    """Five balls in a closed box under a lamp: brushed gold, satin plastic, lacquer, polished copper and frosted glass."""
    scene = Scene()
    room = ((-80 * MM, 0, -60 * MM), (80 * MM, 90 * MM, 60 * MM), (-1, -1, -1, -1, -1, -1))
    outside = ((-82 * MM, -2 * MM, -62 * MM), (82 * MM, 92 * MM, 62 * MM), (1, 1, 1, 1, 1, 1))
    scene.mesh("room", boxes([room, outside]), matte(scene, "wall", (0.6, 0.57, 0.55)))
    frosted = {"KHR_materials_transmission": {"transmissionFactor": 1}, "KHR_materials_volume": {"thicknessFactor": 1 * MM}}
    for name, x, z, color, values in (
            ("gold", -42 * MM, -8 * MM, (0.95, 0.7, 0.3), {"roughness": 0.35, "metallic": 1}),
            ("plastic", -14 * MM, -18 * MM, (0.6, 0.08, 0.06), {"roughness": 0.3}),
            ("lacquer", 14 * MM, -18 * MM, (0.05, 0.2, 0.45), {"roughness": 0}),
            ("copper", 42 * MM, -8 * MM, (0.9, 0.55, 0.4), {"roughness": 0, "metallic": 1}),
            ("frosted", 0, 18 * MM, (1, 1, 1), {"roughness": 0.35, "extensions": frosted})):
        scene.mesh(name, sphere(13 * MM, (x, 13 * MM, z), 96, 49), scene.material(name, color, **values))
    scene.mesh("lamp", square(22 * MM, 89 * MM, facing=-1), matte(scene, "lamp", 0, emissive=6))
    scene.camera((0, 48 * MM, 58 * MM), (0, 12 * MM, -6 * MM), yfov=60, aspect=4 / 3)
    return scene


def shadow_sausage():
    """The paper's figure 2: a tilted rod in a dish of water under the sun; its shadow is broken at the water line."""
    depth, from_vertical = 45 * MM, math.radians(25)
    scene = Scene()
    scene.mesh("dish", frame(60 * MM, 64 * MM, -depth - 4 * MM, 5 * MM, -depth), matte(scene, "dish", (0.55, 0.5, 0.42), meniscus_ignore=1))
    scene.mesh("table", square(200 * MM, -depth - 4 * MM), matte(scene, "table", (0.42, 0.28, 0.17), meniscus_ignore=1))
    add_water(scene, 61 * MM, depth)  # 1 mm into the dish's walls
    along = math.sqrt(0.5)            # 45 degrees, leaning to +x
    below, above = 40 * MM, 48 * MM   # of the rod, measured along it
    rod = scene.material("rod", (0.02, 0.02, 0.025), roughness=0.6, meniscus_contact_angle=30)
    scene.mesh("rod", cylinder(2 * MM, (-below * along, -below * along, 0), (above * along, above * along, 0), 128, 40), rod)
    # From behind, so that the shadow falls in front of the rod.
    sun = (0, math.cos(from_vertical), -math.sin(from_vertical))
    scene.light("sun", "directional", 2000, sun, (0, 0, 0), extras={"angular_diameter": 0})
    scene.camera((0, 150 * MM, 95 * MM), (0, -22 * MM, 9 * MM), yfov=22, aspect=4 / 3)
    return scene


def clear(scene, name, ior, **properties):
    return scene.material(name, roughness=0, extensions={
        "KHR_materials_transmission": {"transmissionFactor": 1}, "KHR_materials_ior": {"ior": ior},
        "KHR_materials_volume": properties.pop("volume", {"thicknessFactor": 1 * MM})}, **properties)


def beaker():
    """A glass rod in a glass beaker of water: volumes that overlap, as is usual where they touch."""
    scene = Scene()
    scene.mesh("table", square(400 * MM, -2 * MM), matte(scene, "table", (0.5, 0.42, 0.3), meniscus_ignore=1))
    glass = clear(scene, "glass", 1.5, meniscus_contact_angle=20)
    scene.mesh("beaker", cup(25 * MM, 27 * MM, -1.5 * MM, 50 * MM, 1 * MM, 128), glass)
    water = clear(scene, "water", 1.333, meniscus_liquid="water",
                  volume={"thicknessFactor": 30 * MM, "attenuationDistance": 60 * MM, "attenuationColor": [0.5, 0.8, 0.9]})
    scene.mesh("water", cylinder(25.5 * MM, (0, 0.5 * MM, 0), (0, 32 * MM, 0), 128), water)  # 0.5 mm into the beaker's wall and floor
    scene.mesh("rod", cylinder(3 * MM, (-12 * MM, 4 * MM, 0), (18 * MM, 68 * MM, 0), 96, 24), glass)
    scene.light("sun", "directional", 2, (-70 * MM, 100 * MM, -40 * MM), (0, 0, 0))
    scene.mesh("lamp", square(60 * MM, 250 * MM, facing=-1), matte(scene, "lamp", 0, emissive=6, meniscus_ignore=1))
    scene.camera((0, 75 * MM, 150 * MM), (0, 22 * MM, 0), yfov=32, aspect=4 / 3)
    return scene


SCENES = {"area_light": area_light, "beaker": beaker, "behind_glass": behind_glass, "box": box_scene, "collection": collection,
          "flat_water": flat_water, "glass_of_water": glass_of_water,
          "materials": materials, "point_light": point_light, "post": post,
          "post_stub": post_stub, "rod_end": rod_end, "shadow_sausage": shadow_sausage, "sphere": sphere_scene, "spot_light": spot_light,
          "tank": tank, "three_lights": three_lights, "two_posts": two_posts, "two_rods": two_rods, **figures_small.SCENES, **hairs.SCENES}


def main(names):
    if not names or any(name not in SCENES and name != "all" for name in names):
        sys.exit(f"{__doc__}\nNAME is one of: {', '.join(SCENES)}")
    folder = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "scenes")
    os.makedirs(folder, exist_ok=True)
    for name in SCENES if "all" in names else names:
        SCENES[name]().write(os.path.join(folder, name + ".gltf"))


if __name__ == "__main__":
    main(sys.argv[1:])
