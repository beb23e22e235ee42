"""The paper's figure 8."""
import math

from curves import arc, catmull_rom
from gltf_writer import MM, Scene
from materials import matte, water
from shapes import disc, square
from stage import COOL, WARM, add_softbox, add_sun, upright_dish
from tubes import Path, lathe, sweep, wire


def teapot():
    """A teapot of 7 cm, half under water, that stands in a dish. Body, spout and handle each pierce the water for themselves."""
    depth = 20 * MM
    scene = Scene()
    metal = scene.material("copper", (0.93, 0.62, 0.48), roughness=0.3, metallic=1, meniscus_contact_angle=30)
    # In millimetres. Spout and handle begin and end inside the body, the one below the water, the other above and below.
    foot = [(0, -20.6), (6, -20.6), *arc((12.2, -19.8), 0.8, -90, 50, 6)]
    bead = arc((10.4, 17.8), 0.8, -80, 80, 8)
    belly = catmull_rom([foot[-1], (14.4, -17.2), (18.4, -12.5), (20.6, -6), (20.7, 0.5), (18.9, 7), (15, 12.2), (11.4, 15.2), bead[0]], 6)
    lid = catmull_rom([bead[-1], (8.6, 20.2), (5.2, 22), (2.4, 23.2), (1.7, 24.4), (2.6, 25.8), (3.3, 27.6), (2.6, 29.6), (1.2, 30.5)], 4)
    body = [foot, belly, bead, [*lid, (0, 30.7)]]
    scene.mesh("body", lathe([[(r * MM, y * MM) for r, y in run] for run in body], 96), metal)

    def curve(controls):
        return Path([tuple(c * MM for c in p) for p in catmull_rom(controls, 10)])

    spout = curve([(13, -11, 0), (20, -8.6, 0), (25.6, -4.4, 0), (28.4, 1.2, 0), (30.4, 7, 0), (33.2, 11.6, 0), (36.8, 14.2, 0)])
    end = spout.length

    def girth(part):
        return (5.2 - 2.9 * part ** 0.75) * MM

    outside = [(0, 0), (0, girth(0) / 2)] + [(end * k / 36, girth(k / 36)) for k in range(1, 37)]
    lip = [(end + 0.35 * MM * math.sin(a), girth(1) - 0.35 * MM * (1 - math.cos(a))) for a in (math.pi * k / 6 for k in range(1, 7))]
    bore = [(end - d * MM, girth(1) - 0.7 * MM) for d in (1, 2, 3, 4)]
    scene.mesh("spout", sweep(spout, [outside[:2], outside[1:] + lip + bore, [bore[-1], (end - 4 * MM, 0)]], 48), metal)
    handle = curve([(-14, 10.5, 0), (-20, 13.6, 0), (-27, 13.4, 0), (-32, 8.6, 0), (-33.2, 1, 0), (-31, -5.6, 0), (-25.6, -9.6, 0), (-15, -12, 0)])
    scene.mesh("handle", wire(handle.points, 1.9 * MM, 40, 1.4 * MM), metal)

    china = matte(scene, "china", (0.72, 0.71, 0.69), meniscus_contact_angle=40)
    scene.mesh("dish", upright_dish(80 * MM, -depth, 5 * MM, 9 * MM, 4 * MM, 128), china)
    scene.mesh("table", square(140 * MM, -depth - 4 * MM), matte(scene, "table", (0.30, 0.22, 0.16), meniscus_ignore=1))
    scene.mesh("water", disc(80.8 * MM, 128), water(scene, depth))
    add_sun(scene, 30, (-90 * MM, 150 * MM, -85 * MM), WARM)
    add_softbox(scene, "softbox", tuple(6 * c for c in COOL), (230 * MM, 210 * MM, 20 * MM), 260 * MM, 200 * MM)
    add_softbox(scene, "fill", tuple(2 * c for c in WARM), (-230 * MM, 180 * MM, 180 * MM), 260 * MM, 200 * MM)
    scene.camera((20 * MM, 140 * MM, 150 * MM), (4 * MM, -6 * MM, 7 * MM), yfov=23)
    return scene
