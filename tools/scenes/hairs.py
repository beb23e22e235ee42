"""Scenes with hairs: the paper's figure 10, and a hair in three liquids. Lengths in millimetres."""
import math

from bodies import sheet
from curves import catmull_rom, superellipse
from gltf_writer import MM, rotation
from materials import clear, matte, water
from shapes import rectangle
from stage import Stage, add_lamp, add_sun, dish
from tubes import wire


def curl(outline, waves, height, width, lift):
    """Along a curve seen from above, (x, z) in millimetres, a hair winds up and down and from side to side. It pierces the level twice in
    every wave, steeply: water climbs only where it does."""
    path = catmull_rom([(x, 0, z) for x, z in outline], 24)
    points = []
    for k, (x, _, z) in enumerate(path):
        part = k / (len(path) - 1)
        ahead, behind = path[min(k + 1, len(path) - 1)], path[max(k - 1, 0)]
        along = math.hypot(ahead[0] - behind[0], ahead[2] - behind[2])
        across = (behind[2] - ahead[2]) / along, (ahead[0] - behind[0]) / along
        turn = 2 * math.pi * waves * part + 0.5 * math.pi
        side = width * math.cos(turn)
        points.append((x + side * across[0], lift + height * math.sin(turn), z + side * across[1]))
    return points


def curled_hair():
    """Figure 10: a hair of 0.1 mm curls above and below the water. Where it pierces it, and there alone, light gathers on the floor."""
    depth = 20
    stage = Stage()
    stage.mesh("table", rectangle(-90, 90, -110, 70), matte(stage, "table", (0.2, 0.12, 0.07), meniscus_ignore=1), (0, -depth - 4, 0))
    stage.mesh("dish", dish(30, 30, depth, 96, power=2, rim=5), matte(stage, "dish", (0.85, 0.78, 0.67), meniscus_ignore=1))
    liquid = water(stage, depth, meniscus_tolerance=5e-6)
    stage.mesh("water", sheet(superellipse(30, 30, 96, 2), 8), liquid)
    hair = stage.material("hair", (0.16, 0.06, 0.02), 0.4, meniscus_contact_angle=55)
    line = [(-11.5, -6), (-9.5, -0.5), (-5, 1.5), (0, -2), (4.5, -4), (9, -1), (11, 4.5)]
    stage.mesh("hair", wire(curl(line, 4, 1.7, 1.0, 0.5), 0.055, 16, 0.15, 2), hair)
    add_sun(stage, 60, (-65, 130, -30), (1, 0.92, 0.80))
    add_lamp(stage, "strip lamp", rectangle(-110, 110, -2.5, 2.5), (170, 220, 280), at=(0, 190, -140), rotation=rotation((1, 0, 0), 145))
    stage.camera((1.5, 66, 46), (2.2, -8, 0), yfov=18)
    return stage


def hair_three_liquids():
    """Hairs of 0.2 mm lean in water, ethanol and olive oil. Water hardly wets them: it rises on one side and sinks on the other. The others
    climb all round, and each bends light by its own index of refraction."""
    depth, radius = 12, 15
    stage = Stage()
    stage.mesh("table", rectangle(-70, 70, -60, 50), matte(stage, "table", (0.24, 0.16, 0.10), meniscus_ignore=1), (0, -depth - 4, 0))
    porcelain = matte(stage, "porcelain", (0.66, 0.64, 0.60), meniscus_ignore=1)
    hair = stage.material("hair", (0.16, 0.06, 0.02), 0.4, meniscus_contact_angle=75,
                       **{"meniscus_contact_angle_ethanol": 20, "meniscus_contact_angle_olive oil": 35})
    lean = math.radians(35)
    bent = catmull_rom([(t * math.sin(lean) - 0.04 * t * t, t * math.cos(lean), 0) for t in (-3, -1.5, 0, 1.5, 3, 4.5, 6)], 6)
    tint = {"attenuationDistance": 20 * MM, "attenuationColor": [0.9, 0.8, 0.35]}
    for name, ior, at, volume in (("water", 1.333, -33, {}), ("ethanol", 1.361, 0, {}), ("olive oil", 1.467, 33, tint)):
        liquid = clear(stage, name, ior, depth, volume, meniscus_liquid=name, meniscus_tolerance=3e-6)
        stage.mesh(f"dish of {name}", dish(radius, radius, depth, 64, power=2, rim=2), porcelain, (at, 0, 0))
        stage.mesh(name, sheet(superellipse(radius, radius, 64, 2), 4), liquid, (at, 0, 0))
        stage.mesh(f"hair in {name}", wire(bent, 0.1, 16, 0.25, 2), hair, (0.8 * at - 1, 0, -2.5))  # in the camera's view
    add_sun(stage, 60, (-14, 130, -30), (1, 0.92, 0.80))
    add_lamp(stage, "strip lamp", rectangle(-160, 160, -2, 2), (170, 220, 280), at=(0, 190, -88), rotation=rotation((1, 0, 0), 155))
    stage.camera((0, 130, 50), (-1, -6, 1), yfov=20)
    return stage


SCENES = {"curled_hair": curled_hair, "hair_three_liquids": hair_three_liquids}
