"""Meshes as (positions, normals, triangles), counter-clockwise from outside. Y up."""
import math

from curves import circle
from vectors import add, cross, lerp, scaled, subtract, unit


def rectangle(left, right, back, front, y=0):
    """Two triangles in the plane y, facing up."""
    return [(left, y, back), (left, y, front), (right, y, front), (right, y, back)], [(0, 1, 0)] * 4, [(0, 1, 2), (0, 2, 3)]


def square(half_width, y, facing=1):
    """Two triangles in the plane y, facing up (1) or down (-1)."""
    positions, normals, triangles = rectangle(-half_width, half_width, -half_width, half_width, y)
    if facing < 0:
        normals, triangles = [(0, -1, 0)] * 4, [(a, c, b) for a, b, c in triangles]
    return positions, normals, triangles


def disc(radius, facets):
    """In the plane y = 0, facing up."""
    rim = [(radius * c, 0, radius * s) for c, s in circle(facets)]
    return [*rim, (0, 0, 0)], [(0, 1, 0)] * (facets + 1), [(facets, (k + 1) % facets, k) for k in range(facets)]


def cylinder(radius, bottom, top, facets, segments=1):
    """A closed rod from the point `bottom` to the point `top`: smooth normals on the side, flat caps. Segments along it keep the
    triangles of a slanting rod short, and their boxes small."""
    w = unit(subtract(top, bottom))
    # u, v and the axis: right-handed; the rods here are never parallel to z.
    n = math.hypot(w[0], w[1])
    u = (w[1] / n, -w[0] / n, 0)
    v = cross(w, u)
    rim = [add(scaled(u, c), scaled(v, s)) for c, s in circle(facets)]
    positions, normals, triangles = [], [], []

    def ring(centre, normal):
        first = len(positions)
        for outward in rim:
            positions.append(add(centre, scaled(outward, radius)))
            normals.append(normal or outward)
        return first

    rings = [ring(lerp(bottom, top, k / segments), None) for k in range(segments + 1)]
    for low, high in zip(rings, rings[1:]):
        for i in range(facets):
            j = (i + 1) % facets
            triangles += [(low + i, low + j, high + j), (low + i, high + j, high + i)]
    for centre, normal in ((bottom, scaled(w, -1)), (top, w)):
        first = ring(centre, normal)
        middle = len(positions)
        positions.append(centre)
        normals.append(normal)
        for i in range(facets):
            j = (i + 1) % facets
            a, b = (first + i, first + j) if normal is w else (first + j, first + i)
            triangles.append((middle, a, b))
    return positions, normals, triangles


def cup(inner, outer, low, high, floor, facets):
    """An open round beaker, closed as a solid: inner and outer radius, underside, rim, and the height of its floor."""
    positions, normals, triangles = [], [], []

    def ring(radius, y, radial, up):
        first = len(positions)
        for x, z in circle(facets):
            positions.append((radius * x, y, radius * z))
            normals.append((radial * x, up, radial * z))
        return first

    def band(a, b):
        for i in range(facets):
            j = (i + 1) % facets
            triangles.extend([(a + i, b + i, b + j), (a + i, b + j, a + j)])

    def disc(ring, y, up):
        middle = len(positions)
        positions.append((0, y, 0))
        normals.append((0, up, 0))
        for i in range(facets):
            j = (i + 1) % facets
            triangles.append((middle, ring + j, ring + i) if up > 0 else (middle, ring + i, ring + j))

    band(ring(outer, low, 1, 0), ring(outer, high, 1, 0))
    band(ring(outer, high, 0, 1), ring(inner, high, 0, 1))
    band(ring(inner, high, -1, 0), ring(inner, floor, -1, 0))
    disc(ring(inner, floor, 0, 1), floor, 1)
    disc(ring(outer, low, 0, -1), low, -1)
    return positions, normals, triangles


def sphere(radius, centre, around, rings):
    """A closed sphere of `rings` bands between the poles; an odd number has no ring of vertices at the equator."""
    positions, normals, triangles = [], [], []

    def vertex(polar, angle):
        n = (math.sin(polar) * math.cos(angle), math.cos(polar), math.sin(polar) * math.sin(angle))
        positions.append(add(centre, scaled(n, radius)))
        normals.append(n)

    vertex(0, 0)
    for i in range(1, rings):
        for k in range(around):
            vertex(math.pi * i / rings, 2 * math.pi * k / around)
    positions.append(add(centre, (0, -radius, 0)))
    normals.append((0, -1, 0))
    south = len(positions) - 1
    for k in range(around):
        m = (k + 1) % around
        triangles.append((0, 1 + m, 1 + k))
        for i in range(rings - 2):
            a, b = 1 + i * around, 1 + (i + 1) * around
            triangles += [(a + k, a + m, b + m), (a + k, b + m, b + k)]
        last = 1 + (rings - 2) * around
        triangles.append((south, last + k, last + m))
    return positions, normals, triangles


def box(low, high):
    """A closed box between two corners, flat normals."""
    return boxes([(low, high, (1, 1, 1, 1, 1, 1))])


def boxes(parts):
    """Faces of axis-parallel boxes in one mesh: (low, high, faces), faces flagged -x +x -y +y -z +z; a flag of -1 turns a face inward."""
    positions, normals, triangles = [], [], []
    for low, high, faces in parts:
        for face, flag in enumerate(faces):
            if flag == 0:
                continue
            axis, side = divmod(face, 2)
            u, v = (axis + 1) % 3, (axis + 2) % 3
            first = len(positions)
            for cu, cv in ((0, 0), (1, 0), (1, 1), (0, 1)):
                p = [0, 0, 0]
                p[axis] = (low, high)[side][axis]
                p[u] = (low, high)[cu][u]
                p[v] = (low, high)[cv][v]
                positions.append(tuple(p))
            outward = flag * (1 if side else -1)
            normals += [tuple(outward if k == axis else 0 for k in range(3))] * 4
            a, b, c, d = range(first, first + 4)
            triangles += [(a, b, c), (a, c, d)] if outward > 0 else [(a, c, b), (a, d, c)]
    return positions, normals, triangles


def frame(inner, outer, low, high, floor):
    """An open square dish, closed as a solid: inner and outer half-width, underside, rim, and the height of its floor."""
    i, o = inner, outer
    shell = ((-o, low, -o), (o, high, o), (1, 1, 1, 0, 1, 1))
    hollow = ((-i, floor, -i), (i, high, i), (-1, -1, -1, 0, -1, -1))
    positions, normals, triangles = boxes([shell, hollow])
    first = len(positions)
    for half in (i, o):
        positions += [(-half, high, -half), (-half, high, half), (half, high, half), (half, high, -half)]
    normals += [(0, 1, 0)] * 8
    for k in range(4):
        a, b = first + k, first + (k + 1) % 4
        triangles += [(a, a + 4, b + 4), (a, b + 4, b)]
    return positions, normals, triangles
