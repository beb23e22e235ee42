"""Closed rooms with a lamp below the ceiling, where light goes to and fro."""
from gltf_writer import MM, Scene
from materials import matte
from shapes import boxes, cylinder, sphere, square
from stage import add_lamp, add_water


def room(low, high, wall):
    """Between two corners, with walls as thick as `wall`."""
    outer = tuple(c - wall for c in low), tuple(c + wall for c in high)
    return boxes([(low, high, (-1,) * 6), (*outer, (1,) * 6)])


def tank():
    """A white box, a third full of water, with a post in it."""
    scene = Scene()
    half, depth, lid = 40 * MM, 25 * MM, 55 * MM
    scene.mesh("tank", room((-half, -depth, -half), (half, lid, half), 2 * MM), matte(scene, "wall", (0.7, 0.65, 0.6), meniscus_contact_angle=60))
    add_water(scene, half + 1 * MM, depth)
    red = matte(scene, "post", (0.6, 0.2, 0.15), meniscus_contact_angle=30)
    scene.mesh("post", cylinder(4 * MM, (0, -depth - 1 * MM, 0), (0, 15 * MM, 0), 96), red)
    add_lamp(scene, "lamp", square(20 * MM, lid - 1 * MM, facing=-1), 4)
    scene.camera((10 * MM, 40 * MM, 38 * MM), (0, -12 * MM, -4 * MM), yfov=60)
    return scene


def balls():
    """Brushed gold, satin plastic, lacquer, polished copper and frosted glass."""
    scene = Scene()
    scene.mesh("room", room((-80 * MM, 0, -60 * MM), (80 * MM, 90 * MM, 60 * MM), 2 * MM), matte(scene, "wall", (0.6, 0.57, 0.55)))
    frosted = {"KHR_materials_transmission": {"transmissionFactor": 1}, "KHR_materials_volume": {"thicknessFactor": 1 * MM}}
    for name, x, z, color, values in (
            ("gold", -42 * MM, -8 * MM, (0.95, 0.7, 0.3), {"roughness": 0.35, "metallic": 1}),
            ("plastic", -14 * MM, -18 * MM, (0.6, 0.08, 0.06), {"roughness": 0.3}),
            ("lacquer", 14 * MM, -18 * MM, (0.05, 0.2, 0.45), {"roughness": 0}),
            ("copper", 42 * MM, -8 * MM, (0.9, 0.55, 0.4), {"roughness": 0, "metallic": 1}),
            ("frosted", 0, 18 * MM, (1, 1, 1), {"roughness": 0.35, "extensions": frosted})):
        scene.mesh(name, sphere(13 * MM, (x, 13 * MM, z), 96, 49), scene.material(name, color, **values))
    scene.mesh("lamp", square(22 * MM, 89 * MM, facing=-1), matte(scene, "lamp", 0, emissive=6))
    scene.camera((0, 48 * MM, 58 * MM), (0, 12 * MM, -6 * MM), yfov=60)
    return scene


SCENES = {"materials": balls, "tank": tank}
