"""The paper's figure 9."""
from curves import arc, lengths_along
from gltf_writer import MM, Scene
from materials import matte, water
from shapes import disc
from stage import COOL, WARM, add_softbox, add_sun, upright_dish
from tubes import wire
from vectors import lerp


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
    inner_leg = 12 + 16 + 14 + 14  # points before it begins
    ways = lengths_along(flat)

    def height(way):  # a bend, a steep rise, another bend
        ahead = min(max((way - ways[inner_leg] + 1) / 4.5, 0), 1)
        return lift * ahead * ahead * (3 - 2 * ahead)

    return [(x * MM, (level + height(way)) * MM, z * MM) for (x, _, z), way in zip(flat, ways)]


def paper_clip():
    """A floating clip; its inner curve is bent up and does not touch the water. It lies as deep as a clip of 1.05 g/cm3 does,
    polystyrene, say: what it and its meniscus displace weighs as much."""
    depth = 36 * MM
    scene = Scene()
    lacquer = scene.material("lacquer", (0.75, 0.07, 0.04), roughness=0.25, meniscus_contact_angle=90)
    scene.mesh("clip", wire(clip_wire(-0.15, 3), 0.45 * MM, 24, 0.5 * MM), lacquer)
    enamel = matte(scene, "enamel", (0.74, 0.74, 0.73), meniscus_ignore=1)
    scene.mesh("dish", upright_dish(60 * MM, -depth, 6 * MM, 9 * MM, 3 * MM, 96), enamel)
    scene.mesh("water", disc(60.8 * MM, 96), water(scene, depth))
    add_sun(scene, 30, (-50 * MM, 150 * MM, -75 * MM), WARM)
    add_softbox(scene, "softbox", tuple(5 * c for c in COOL), (190 * MM, 180 * MM, -60 * MM), 200 * MM, 160 * MM)
    scene.camera((6 * MM, 125 * MM, 80 * MM), (5 * MM, -22 * MM, 5 * MM), yfov=20)
    return scene
