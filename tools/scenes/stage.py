"""What the pictures' things stand in: a scene in millimetres, dishes, water and lights."""
from bodies import turned
from curves import arc, b_spline, superellipse
from gltf_writer import MM, Scene, look_at
from materials import matte, water
from shapes import square
from tubes import lathe

WARM, COOL = (1, 0.93, 0.82), (0.80, 0.90, 1)  # colours of light


class Stage(Scene):
    """A scene in millimetres, every mesh of which has a place of its own."""

    def __init__(self):
        super().__init__(MM, short_indices=True)

    def mesh(self, name, mesh, material, at=(0, 0, 0), **node):
        super().mesh(name, mesh, material, at, **node)


def add_water(scene, half_width, depth, level=0):
    scene.mesh("water", square(half_width, level), water(scene, depth))


def add_sun(scene, illuminance, eye, color):
    scene.light("sun", "directional", illuminance, eye, color=list(color), extras={"angular_diameter": 0.53})


def add_lamp(scene, name, mesh, radiance, **node):
    """A mesh that only shines."""
    scene.mesh(name, mesh, matte(scene, name, 0, emissive=radiance, meniscus_ignore=1), **node)


def add_softbox(scene, name, radiance, eye, width, height):
    """A lamp at `eye` that faces the origin."""
    w, h = width / 2, height / 2
    face = [(-w, -h, 0), (-w, h, 0), (w, h, 0), (w, -h, 0)], [(0, 0, -1)] * 4, [(0, 1, 2), (0, 2, 3)]
    add_lamp(scene, name, face, radiance, at=eye, rotation=look_at(eye, (0, 0, 0)))


def dish(half_x, half_z, depth, facets, power=4, rim=9):
    """For water that reaches to half_x and half_z, in millimetres: 0.5 to 1 mm into its walls, which lean outward a little; all edges are
    rounded. The outline is an ellipse (power 2) or nearly a rectangle."""
    profile = b_spline([(0, -depth - 4), (0.7, -depth - 4), (0.88, -depth - 4), (0.93, -depth - 3), (1.05, rim), (1.05, rim + 1),
                        (1.012, rim + 1), (1.008, rim - 1), (0.92, -depth + 5), (0.91, -depth), (0.85, -depth), (0.6, -depth), (0, -depth)], 36)
    return turned(profile, superellipse(half_x, half_z, facets, power))


def upright_dish(inner, floor, rim, corner, thickness, facets):
    """An open round dish with upright walls, rounded inside at the bottom, and a round rim; closed as a solid. Runs of their own for what is
    straight, so that normals of the wall, which the water meets, are its own."""
    half, middle = thickness / 2, (inner - corner, floor + corner)
    under = [(0, floor - thickness), (middle[0], floor - thickness)]
    outside = [under[-1], *arc(middle, corner + thickness, -90, 0, 6)[1:]]
    lip = arc((inner + half, rim), half, 0, 180, 8)
    inside = arc(middle, corner, 0, -90, 8)
    return lathe([under, outside, [outside[-1], lip[0]], lip, [lip[-1], inside[0]], inside, [inside[-1], (0, floor)]], facets)
