"""A rod in a dish, the paper's figure 2, and a glass rod in a beaker."""
import math

from gltf_writer import MM, Scene
from materials import clear, matte, water
from shapes import cup, cylinder, frame, square
from stage import add_lamp, add_water


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
    scene.light("sun", "directional", 2000, sun, extras={"angular_diameter": 0})
    scene.camera((0, 150 * MM, 95 * MM), (0, -22 * MM, 9 * MM), yfov=22)
    return scene


def beaker():
    """A glass rod in a glass beaker of water: volumes that overlap, as is usual where they touch."""
    scene = Scene()
    scene.mesh("table", square(400 * MM, -2 * MM), matte(scene, "table", (0.5, 0.42, 0.3), meniscus_ignore=1))
    glass = clear(scene, "glass", 1.5, 1 * MM, meniscus_contact_angle=20)
    scene.mesh("beaker", cup(25 * MM, 27 * MM, -1.5 * MM, 50 * MM, 1 * MM, 128), glass)
    liquid = water(scene, 30 * MM, {"attenuationDistance": 60 * MM, "attenuationColor": [0.5, 0.8, 0.9]})
    scene.mesh("water", cylinder(25.5 * MM, (0, 0.5 * MM, 0), (0, 32 * MM, 0), 128), liquid)  # 0.5 mm into the beaker's wall and floor
    scene.mesh("rod", cylinder(3 * MM, (-12 * MM, 4 * MM, 0), (18 * MM, 68 * MM, 0), 96, 24), glass)
    scene.light("sun", "directional", 2, (-70 * MM, 100 * MM, -40 * MM))
    add_lamp(scene, "lamp", square(60 * MM, 250 * MM, facing=-1), 6)
    scene.camera((0, 75 * MM, 150 * MM), (0, 22 * MM, 0), yfov=32)
    return scene


SCENES = {"beaker": beaker, "shadow_sausage": shadow_sausage}
