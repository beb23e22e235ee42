"""Closed bodies that are smooth all over, as (positions, normals, triangles): rings of any outline from one pole to the other; and an
open sheet."""
import math

from curves import circle
from vectors import add, cross, dot, length, scaled, subtract, unit


def tangent(before, here, after):
    """Of the parabola through three points, as far apart in parameter as in space."""
    a, b = subtract(here, before), subtract(after, here)
    la, lb = length(a), length(b)
    return unit(add(scaled(a, lb / la), scaled(b, la / lb)))


def sector(i, around, rings):
    """Triangles between the points i and i + 1 of all rings, whose vertices follow on vertex 0, the pole."""
    j = (i + 1) % around
    triangles = [(0, 1 + j, 1 + i)]
    for low in range(1, 1 + around * (rings - 1), around):
        triangles += [(low + i, low + j, low + around + j), (low + i, low + around + j, low + around + i)]
    return triangles


def loft(rings, first_pole, last_pole):
    """A closed surface through rings of equally many points. Its normals are those of the smooth surface that the rings stand for."""
    n = len(rings[0])
    positions, normals = [first_pole], [None]
    for k, ring in enumerate(rings):
        for i, here in enumerate(ring):
            before = rings[k - 1][i] if k > 0 else first_pole
            after = rings[k + 1][i] if k + 1 < len(rings) else last_pole
            positions.append(here)
            normals.append(unit(cross(tangent(ring[i - 1], here, ring[(i + 1) % n]), tangent(before, here, after))))
    positions.append(last_pole)
    normals[0] = unit([math.fsum(c) for c in zip(*normals[1:n + 1])])
    normals.append(unit([math.fsum(c) for c in zip(*normals[-n:])]))
    triangles = []
    for i in range(n):
        last = len(positions) - 1
        triangles += [*sector(i, n, len(rings)), (last, last - n + i, last - n + (i + 1) % n)]
    volume = math.fsum(dot(positions[a], cross(positions[b], positions[c])) for a, b, c in triangles)
    if volume < 0:  # the rings run the other way round
        normals = [scaled(m, -1) for m in normals]
        triangles = [(a, c, b) for a, b, c in triangles]
    return positions, normals, triangles


def turned(profile, outline):
    """Any outline round the y axis, scaled by the profile's points (r, y) from axis to axis; a circle makes a body turned on a lathe."""
    rings = [[(r * x, y, r * z) for x, z in outline] for r, y in profile[1:-1]]
    return loft(rings, (0, profile[0][1], 0), (0, profile[-1][1], 0))


def tapered_rod(path, radii, around, cap_rings=4):
    """A bent rod with round ends along the points `path`, as thick as `radii` say at each of them."""
    inner = [tangent(*path[k - 1:k + 2]) for k in range(1, len(path) - 1)]
    ways = [unit(subtract(path[1], path[0])), *inner, unit(subtract(path[-1], path[-2]))]
    side = (1, 0, 0) if abs(ways[0][0]) < 0.7 else (0, 0, 1)
    stations = []  # centre, radius, two directions across; carried along the path without twist
    for centre, radius, way in zip(path, radii, ways):
        side = unit(subtract(side, scaled(way, dot(side, way))))
        stations.append((centre, radius, side, cross(way, side)))

    def cap(k, sign):
        centre, radius, u, v = stations[k]
        angles = [math.pi / 2 * i / (cap_rings + 1) for i in range(1, cap_rings + 1)]
        return [(add(centre, scaled(ways[k], sign * radius * math.sin(a))), radius * math.cos(a), u, v) for a in angles]

    stations = [*reversed(cap(0, -1)), *stations, *cap(len(path) - 1, 1)]
    rings = [[add(centre, add(scaled(u, radius * c), scaled(v, radius * s))) for c, s in circle(around)] for centre, radius, u, v in stations]
    return loft(rings, subtract(path[0], scaled(ways[0], radii[0])), add(path[-1], scaled(ways[-1], radii[-1])))


def level(x, z):
    return 0, 0, 0


def sheet(outline, rings, height=level):
    """A surface over the outline round the y axis, open at its border; `height`: (x, z) -> y and its two derivatives."""
    points = [(0, 0)] + [(x * k / rings, z * k / rings) for k in range(1, rings + 1) for x, z in outline]
    positions, normals = [], []
    for x, z in points:
        y, dx, dz = height(x, z)
        positions.append((x, y, z))
        normals.append(unit((-dx, 1, -dz)))
    return positions, normals, [t for i in range(len(outline)) for t in sector(i, len(outline), rings)]


def united(meshes):
    """Several meshes as one."""
    positions, normals, triangles = [], [], []
    for p, n, t in meshes:
        triangles += [tuple(len(positions) + i for i in corners) for corners in t]
        positions += p
        normals += n
    return positions, normals, triangles


def moved(mesh, by):
    return [add(p, by) for p in mesh[0]], mesh[1], mesh[2]
