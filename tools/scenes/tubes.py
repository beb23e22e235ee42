"""Round bodies as (positions, normals, triangles): circles of any radius, swept along a curve or an axis, with creases where asked for."""
import bisect
import math

from curves import circle, derivative, lengths_along
from vectors import add, combined, cross, dot, length, lerp, scaled, subtract, unit


def direction(a):
    """`unit`, but divided: in some last bits the two differ, and scenes/*.gltf stay as they are to the byte."""
    by = length(a)
    return tuple(p / by for p in a)


def mirrored(a, across):
    """The vector in a mirror whose normal is `across`, of any length; itself if that is zero."""
    square = dot(across, across)
    return add(a, scaled(across, -2 * dot(across, a) / square)) if square > 0 else a


class Path:
    """A curve through closely spaced points, with frames that do not twist (double reflection, Wang et al. 2008)."""

    def __init__(self, points):
        self.points = points
        self.way = lengths_along(points)
        self.length = self.way[-1]
        tangents = [direction(derivative(points, self.way, i)) for i in range(len(points))]
        least = min(range(3), key=lambda k: abs(tangents[0][k]))
        side = unit(cross(tangents[0], tuple(float(k == least) for k in range(3))))
        self.frames = [(side, tangents[0])]
        for a, b, before, tangent in zip(points, points[1:], tangents, tangents[1:]):
            chord = subtract(b, a)
            side = mirrored(mirrored(side, chord), subtract(tangent, mirrored(before, chord)))
            self.frames.append((side, tangent))

    def at(self, way):
        """Position and right-handed frame (u, v, tangent) at `way` along the curve; straight on beyond its ends."""
        i = min(max(bisect.bisect(self.way, way) - 1, 0), len(self.points) - 2)
        part = (way - self.way[i]) / (self.way[i + 1] - self.way[i])
        side, tangent = (lerp(a, b, min(max(part, 0), 1)) for a, b in zip(self.frames[i], self.frames[i + 1]))
        w = direction(tangent)
        u = direction(subtract(side, scaled(w, dot(side, w))))
        return lerp(self.points[i], self.points[i + 1], part), u, cross(w, u), w


def sweep(path, runs, facets):
    """Rings round the path: each run a list of (way along the path, radius), smooth within itself; radius 0 closes the end. From the start
    of the path on, outside; a profile that turns back goes on inside."""
    positions, normals, triangles = [], [], []
    for run in runs:
        parameters = lengths_along(run)
        frames = [path.at(way) for way, _ in run]
        grid = [[add(add(c, scaled(u, r * x)), scaled(v, r * z)) for x, z in circle(facets)] for (_, r), (c, u, v, _) in zip(run, frames)]
        columns = list(zip(*grid))
        rows = []
        for i, ((_, radius), (centre, u, v, w)) in enumerate(zip(run, frames)):
            rows.append(len(positions))
            if radius == 0:
                positions.append(centre)
                normals.append(w if i > 0 else subtract((0, 0, 0), w))
                continue
            positions += grid[i]
            for column, (x, z) in zip(columns, circle(facets)):
                normals.append(unit(cross(combined((x, -z), (v, u)), derivative(column, parameters, i))))
        for i in range(len(run) - 1):
            a, b = rows[i], rows[i + 1]
            for k in range(facets):
                m = (k + 1) % facets
                if run[i][1] > 0:
                    triangles.append((a + k, a + m, b + m if run[i + 1][1] > 0 else b))
                if run[i + 1][1] > 0:
                    triangles.append((a + k if run[i][1] > 0 else a, b + m, b + k))
    return positions, normals, triangles


def wire(points, radius, facets, spacing, rounding=3):
    """Round the curve through `points`, with round ends; rings `spacing` apart."""
    path = Path(points)
    angles = [math.pi / 2 * k / rounding for k in range(rounding)]
    start = [(radius * (1 - math.cos(a)), radius * math.sin(a)) for a in angles]
    count = max(1, round((path.length - 2 * radius) / spacing))
    middle = [(radius + (path.length - 2 * radius) * k / count, radius) for k in range(count + 1)]
    return sweep(path, [start + middle + [(path.length - way, r) for way, r in reversed(start)]], facets)


def lathe(runs, facets):
    """Turned round the Y axis: each run a list of (radius, height), upwards outside."""
    return sweep(Path([(0, 0, 0), (0, 1, 0)]), [[(height, radius) for radius, height in run] for run in runs], facets)
