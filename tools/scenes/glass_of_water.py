"""A glass of water with a bent straw on a table, in light from the side. Lengths in millimetres."""
from bodies import tapered_rod, turned
from curves import b_spline, circle
from gltf_writer import rotation
from materials import clear, matte, water
from shapes import cylinder, rectangle
from stage import Stage, add_lamp, add_sun

INNER, BASE, LEVEL, RIM = 29, 6, 60, 84  # radius of the hollow; heights of its floor, the water and the rim


def tumbler():
    """With a thick base and a wall of 2 mm, straight inside."""
    outside = [(0, 0), (14, 0), (27, 0), (29, 0), (30, 1), (30.5, 8), (31, RIM - 8), (31, RIM - 1), (31, RIM)]
    inside = [(30, RIM + 0.8), (INNER, RIM), (INNER, RIM - 1), (INNER, RIM - 12), (INNER, 40), (INNER, BASE + 6), (INNER, BASE + 3),
              (INNER - 1, BASE), (INNER - 5, BASE), (INNER / 2, BASE), (0, BASE)]
    return turned(b_spline(outside + inside, 52), circle(112))


def straw():
    points = b_spline([(-17, 10, 4), (-12, 25, 3), (-6, 43, 1), (0, LEVEL, 0), (7, 80, -2), (12, 95, -3), (16, 106, -4), (20, 113, -5),
                       (30, 117, -6), (44, 120, -7)], 60)
    return tapered_rod(points, [2.6] * len(points), 48, 3)


def glass_of_water():
    stage = Stage()
    stage.mesh("table", rectangle(-190, 260, -330, 130), matte(stage, "table", (0.5, 0.42, 0.34), meniscus_ignore=1), (0, -1, 0))
    glass = clear(stage, "glass", 1.5, 2, meniscus_contact_angle=20)
    stage.mesh("tumbler", tumbler(), glass)
    liquid = water(stage, 2 * INNER, meniscus_tolerance=4e-6)
    stage.mesh("water", cylinder(INNER + 0.6, (0, BASE - 0.6, 0), (0, LEVEL, 0), 112), liquid)  # 0.6 mm into wall and base
    stage.mesh("straw", straw(), stage.material("straw", (0.72, 0.1, 0.08), 0.4, meniscus_contact_angle=50))
    add_sun(stage, 70, (-100, 105, -70), (1, 0.94, 0.84))
    # Just beyond what the camera sees, and near: menisci and glass mirror it, and its share of the light is that of its power.
    add_lamp(stage, "lamp", rectangle(-60, 60, -40, 40), 65, at=(200, 160, -170), rotation=rotation((0.646, 0, 0.763), 111))
    stage.camera((20, 235, 235), (20, 38, 2), yfov=31)
    return stage
