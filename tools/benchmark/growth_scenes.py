"""Scenes of any size, to see how cost grows."""
import math
import os
import subprocess
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(1, os.path.join(HERE, "..", "scenes"))

import depression as benchmark  # noqa: E402
from gltf_writer import Scene  # noqa: E402
from make_scenes import CAMERA_DEPTH, MM, add_water, matte  # noqa: E402
from shapes import cylinder, square  # noqa: E402

SPACING, DEPTH = 10 * MM, 50 * MM
FACETS = 64  # of a post


def depression(triangles):
    """The benchmark's post of 4 mm with a surface of about so many triangles."""
    return benchmark.scene(benchmark.dep(math.sqrt(triangles / (2 * benchmark.RINGS * benchmark.AROUND))))


def posts(count):
    """So many posts in water, on a square grid that fills the picture, each with a meniscus to be built."""
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
    return scene


KINDS = {"depression": depression, "posts": posts}


def write(kind, count, folder):
    """Path of the scene, written by another process: this one's peak of memory would count as that of the programs that it starts."""
    path = os.path.join(folder, f"{kind}_{count}.gltf")
    subprocess.run([sys.executable, "-B", os.path.abspath(__file__), kind, str(count), path], check=True)
    return path


if __name__ == "__main__":
    KINDS[sys.argv[1]](int(sys.argv[2])).write(sys.argv[3])
