"""Scenes of any size, to see how cost grows."""
import math
import os

import depression as benchmark
from gltf_writer import Scene
from make_scenes import CAMERA_DEPTH, MM, add_water, matte
from shapes import cylinder, square

SPACING, DEPTH = 10 * MM, 50 * MM
FACETS = 64  # of a post


def depression(folder, triangles):
    """The benchmark's post of 4 mm with a surface of about so many triangles. Returns the path."""
    path = os.path.join(folder, f"depression_{triangles}.gltf")
    benchmark.scene(benchmark.dep(math.sqrt(triangles / (2 * benchmark.RINGS * benchmark.AROUND)))).write(path)
    return path


def posts(folder, count):
    """So many posts in water, on a square grid that fills the picture, each with a meniscus to be built. Returns the path."""
    side = math.ceil(math.sqrt(count))
    half_width = side * SPACING / 2
    scene = Scene()
    scene.mesh("floor", square(half_width + SPACING, -DEPTH), matte(scene, "floor", 0.5, meniscus_ignore=1))
    add_water(scene, half_width + 0.9 * SPACING, DEPTH)
    black = matte(scene, "post", 0, meniscus_contact_angle=30)
    for k in range(count):
        x, z = ((i - (side - 1) / 2) * SPACING for i in divmod(k, side))
        scene.mesh(f"post {k}", cylinder(2 * MM, (x, -DEPTH - MM, z), (x, SPACING, z), FACETS), black)
    scene.light("sun", "directional", 1, (0, 100 * MM, 0), (0, 0, 0))
    scene.camera((0, -CAMERA_DEPTH, 0), (0, -DEPTH, 0), half_width=half_width)
    path = os.path.join(folder, f"posts_{count}.gltf")
    scene.write(path)
    return path
