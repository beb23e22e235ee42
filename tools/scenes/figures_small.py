"""Scenes of the paper's figures 8 and 9: small things in a dish of water, under a small hard light that draws the caustics and a wide soft one."""
import math

from curves import arc, catmull_rom, circle, lengths_along
from gltf_writer import Scene, look_at
from shapes import square
from tubes import Path, lathe, sweep, wire
from vectors import lerp

MM = 1e-3
WARM, COOL = (1, 0.93, 0.82), (0.80, 0.90, 1)


def matte(scene, name, color, **properties):
    return scene.material(name, color, extensions={"KHR_materials_specular": {"specularFactor": 0}}, **properties)


def water(scene, depth, **extras):
    return scene.material("water", roughness=0, meniscus_liquid="water", **extras, extensions={
        "KHR_materials_transmission": {"transmissionFactor": 1}, "KHR_materials_ior": {"ior": 1.333},
        "KHR_materials_volume": {"thicknessFactor": depth}})


def disc(radius, facets):
    """The level liquid of a round dish, facing up."""
    rim = [(radius * c, 0, radius * s) for c, s in circle(facets)]
    return [*rim, (0, 0, 0)], [(0, 1, 0)] * (facets + 1), [(facets, (k + 1) % facets, k) for k in range(facets)]


def round_dish(inner, floor, rim, corner, thickness, facets):
    """An open dish with upright walls, rounded inside at the bottom, and a round rim; closed as a solid. Runs of their own for what is
    straight, so that normals of the wall, which the water meets, are its own."""
    half, middle = thickness / 2, (inner - corner, floor + corner)
    under = [(0, floor - thickness), (middle[0], floor - thickness)]
    outside = [under[-1], *arc(middle, corner + thickness, -90, 0, 6)[1:]]
    lip = arc((inner + half, rim), half, 0, 180, 8)
    inside = arc(middle, corner, 0, -90, 8)
    return lathe([under, outside, [outside[-1], lip[0]], lip, [lip[-1], inside[0]], inside, [inside[-1], (0, floor)]], facets)


def softbox(scene, name, radiance, eye, target, width, height):
    """A lamp of width by height at `eye` that faces the target."""
    w, h = width / 2, height / 2
    lamp = [(-w, -h, 0), (-w, h, 0), (w, h, 0), (w, -h, 0)], [(0, 0, -1)] * 4, [(0, 1, 2), (0, 2, 3)]
    scene.mesh(name, lamp, matte(scene, name, (0, 0, 0), emissive=radiance, meniscus_ignore=1), translation=list(eye), rotation=look_at(eye, target))


def teapot():
    """Figure 8: a teapot of 7 cm, half under water, that stands in a dish. Body, spout and handle each pierce the water for themselves."""
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
    scene.mesh("dish", round_dish(80 * MM, -depth, 5 * MM, 9 * MM, 4 * MM, 128), china)
    scene.mesh("table", square(140 * MM, -depth - 4 * MM), matte(scene, "table", (0.30, 0.22, 0.16), meniscus_ignore=1))
    scene.mesh("water", disc(80.8 * MM, 128), water(scene, depth))
    scene.light("sun", "directional", 30, (-90 * MM, 150 * MM, -85 * MM), (0, 0, 0), color=list(WARM), extras={"angular_diameter": 0.53})
    softbox(scene, "softbox", tuple(6 * c for c in COOL), (230 * MM, 210 * MM, 20 * MM), (0, 0, 0), 260 * MM, 200 * MM)
    softbox(scene, "fill", tuple(2 * c for c in WARM), (-230 * MM, 180 * MM, 180 * MM), (0, 0, 0), 260 * MM, 200 * MM)
    scene.camera((20 * MM, 140 * MM, 150 * MM), (4 * MM, -6 * MM, 7 * MM), yfov=23, aspect=4 / 3)
    return scene


def bend(x, z, radius, first, last, steps):
    """Points of an arc seen from above, angles in degrees from +x towards +z."""
    return [(px, 0, pz) for px, pz in arc((x, z), radius, first, last, steps)]


def straight(start, end, count):
    return [lerp(start, end, k / count) for k in range(count + 1)]


def clip_wire(level, lift):
    """Centre line of a clip of 30 mm, metres: two outer legs and the bends between them lie at `level`, the inner curve rises by `lift`."""
    outer, inner, right, left = 3.9, 2.1, 10.6, -11.0
    wide, middle = (outer + inner) / 2, (outer - inner) / 2
    flat = [*straight((-7, 0, -outer), (right, 0, -outer), 12), *bend(right, 0, outer, -90, 90, 16)[1:],
            *straight((right, 0, outer), (left, 0, outer), 14)[1:], *bend(left, middle, wide, 90, 270, 14)[1:],
            *straight((left, 0, -inner), (right - 5, 0, -inner), 20)[1:], *bend(right - 5, 0, inner, -90, 90, 12)[1:],
            *straight((right - 5, 0, inner), (-6, 0, inner), 8)[1:]]
    turned = 12 + 16 + 14 + 14  # points before the inner leg begins
    inner_way = lengths_along(flat)

    def height(way):  # a bend, a steep rise, another bend
        ahead = min(max((way - inner_way[turned] + 1) / 4.5, 0), 1)
        return lift * ahead * ahead * (3 - 2 * ahead)

    return [(x * MM, (level + height(way)) * MM, z * MM) for (x, _, z), way in zip(flat, inner_way)]


def paper_clip():
    """Figure 9: a floating clip; its inner curve is bent up and does not touch the water. It lies as deep as a clip of 1.05 g/cm3 does,
    polystyrene, say: what it and its meniscus displace weighs as much."""
    depth = 36 * MM
    scene = Scene()
    lacquer = scene.material("lacquer", (0.75, 0.07, 0.04), roughness=0.25, meniscus_contact_angle=90)
    scene.mesh("clip", wire(clip_wire(-0.15, 3), 0.45 * MM, 24, 0.5 * MM), lacquer)
    enamel = matte(scene, "enamel", (0.74, 0.74, 0.73), meniscus_ignore=1)
    scene.mesh("dish", round_dish(60 * MM, -depth, 6 * MM, 9 * MM, 3 * MM, 96), enamel)
    scene.mesh("water", disc(60.8 * MM, 96), water(scene, depth))
    scene.light("sun", "directional", 30, (-50 * MM, 150 * MM, -75 * MM), (0, 0, 0), color=list(WARM), extras={"angular_diameter": 0.53})
    softbox(scene, "softbox", tuple(5 * c for c in COOL), (190 * MM, 180 * MM, -60 * MM), (0, 0, 0), 200 * MM, 160 * MM)
    scene.camera((6 * MM, 125 * MM, 80 * MM), (5 * MM, -22 * MM, 5 * MM), yfov=20, aspect=4 / 3)
    return scene


SCENES = {"paper_clip": paper_clip, "teapot": teapot}
