"""A ball and a leaning rod in a dish that water rises in: of the gallery's animation."""
import math

from gltf_writer import MM, Scene
from materials import matte
from shapes import cylinder, frame, sphere, square
from stage import add_water

BALL = 11 * MM              # radius; it lies on the floor of the dish, at 0
LOW, HIGH = 5 * MM, 18 * MM  # the ball is met well below its middle, and well above


def water_level(level):
    """The water stands `level` above the floor."""
    scene = Scene()
    scene.mesh("dish", frame(55 * MM, 58 * MM, -4 * MM, 34 * MM, 0), matte(scene, "dish", (0.6, 0.56, 0.5), meniscus_ignore=1))
    scene.mesh("table", square(200 * MM, -4 * MM), matte(scene, "table", (0.36, 0.26, 0.18), meniscus_ignore=1))
    add_water(scene, 55.5 * MM, level, level)  # 0.5 mm into the dish's walls
    red = scene.material("ball", (0.5, 0.06, 0.04), roughness=0.5, meniscus_contact_angle=40)
    scene.mesh("ball", sphere(BALL, (17 * MM, BALL - 0.2 * MM, 2 * MM), 128, 63), red)
    black = scene.material("rod", (0.03, 0.03, 0.035), roughness=0.5, meniscus_contact_angle=30)
    lean = math.radians(45)
    foot, length = (-34 * MM, 1 * MM, 0), 60 * MM
    tip = (foot[0] + length * math.sin(lean), foot[1] + length * math.cos(lean), -12 * MM)
    scene.mesh("rod", cylinder(1.5 * MM, foot, tip, 96, 40), black)
    # From behind, so that shadows and caustics fall in front.
    scene.light("sun", "directional", 2000, (0.25, 1, -0.75), extras={"angular_diameter": 0.53})
    scene.camera((0, 120 * MM, 88 * MM), (0, 5 * MM, 4 * MM), yfov=24)
    return scene
