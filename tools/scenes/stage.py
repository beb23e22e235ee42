"""What the pictures' things stand in and on: dish, table, water and lamps. Lengths in millimetres, here and in `Stage.put`."""
from bodies import turned
from curves import b_spline, superellipse
from gltf_writer import Scene

MM = 1e-3


def dish(half_x, half_z, depth, facets, power=4, rim=9):
    """For water that reaches to half_x and half_z: 0.5 to 1 mm into its walls, which lean outward a little; all edges are rounded. The
    outline is an ellipse (power 2) or nearly a rectangle."""
    profile = b_spline([(0, -depth - 4), (0.7, -depth - 4), (0.88, -depth - 4), (0.93, -depth - 3), (1.05, rim), (1.05, rim + 1), (1.012, rim + 1),
                      (1.008, rim - 1), (0.92, -depth + 5), (0.91, -depth), (0.85, -depth), (0.6, -depth), (0, -depth)], 36)
    return turned(profile, superellipse(half_x, half_z, facets, power))


def rectangle(left, right, back, front):
    return [(left, 0, back), (left, 0, front), (right, 0, front), (right, 0, back)], [(0, 1, 0)] * 4, [(0, 1, 2), (0, 2, 3)]


class Stage(Scene):
    """A scene in millimetres."""

    def __init__(self):
        super().__init__(short_indices=True)

    def put(self, name, mesh, material, at=(0, 0, 0), **node):
        positions, normals, triangles = mesh
        metres = [tuple(MM * c for c in p) for p in positions]
        self.mesh(name, (metres, normals, triangles), material, translation=[MM * c for c in at], **node)

    def satin(self, name, color, roughness=0.3, **extras):
        return self.material(name, color, roughness=roughness, **extras)

    def matte(self, name, color, **values):
        return self.material(name, color, extensions={"KHR_materials_specular": {"specularFactor": 0}}, **values)

    def clear(self, name, ior, thickness, volume={}, **extras):
        return self.material(name, roughness=0, **extras, extensions={
            "KHR_materials_transmission": {"transmissionFactor": 1}, "KHR_materials_ior": {"ior": ior},
            "KHR_materials_volume": {"thicknessFactor": thickness * MM, **volume}})

    def lamp(self, name, mesh, radiance, at, **node):
        """An emissive mesh that only shines."""
        self.put(name, mesh, self.matte(name, (0, 0, 0), emissive=radiance, meniscus_ignore=1), at, **node)

    def shine(self, name, kind, intensity, eye, target=(0, 0, 0), **values):
        self.light(name, kind, intensity, [MM * c for c in eye], [MM * c for c in target], **values)

    def look(self, eye, target, yfov):
        self.camera([MM * c for c in eye], [MM * c for c in target], yfov=yfov, aspect=4 / 3)
