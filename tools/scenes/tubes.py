"""Smooth round bodies as (positions, normals, triangles): tubes swept round a curve, and bodies turned on a lathe. Lengths in metres, Y up."""
import bisect
import math


def add(a, b, scale=1.0):
    return tuple(p + scale * q for p, q in zip(a, b))


def dot(a, b):
    return sum(p * q for p, q in zip(a, b))


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def unit(a):
    length = math.sqrt(dot(a, a))
    return tuple(c / length for c in a)


def derivative(points, t, i):
    """At points[i], of the parabola through it and its neighbours (at an end: the next two) over the parameters `t`."""
    j = min(max(i, 1), len(points) - 2)
    if len(points) == 2:
        return add(points[1], points[0], -1)
    a, b, c = t[j - 1], t[j], t[j + 1]
    weights = ((2 * t[i] - b - c) / ((a - b) * (a - c)), (2 * t[i] - a - c) / ((b - a) * (b - c)), (2 * t[i] - a - b) / ((c - a) * (c - b)))
    return tuple(sum(w * p[k] for w, p in zip(weights, points[j - 1:j + 2])) for k in range(len(points[i])))


def travelled(points):
    """The way to each point, along the chords."""
    way = [0.0]
    for a, b in zip(points, points[1:]):
        way.append(way[-1] + math.dist(a, b))
    return way


def spline(controls, per_span=8):
    """A smooth curve through the control points, each span cut in `per_span`: centripetal Catmull-Rom, which neither loops nor overshoots."""
    ends = [add(controls[0], add(controls[0], controls[1], -1)), add(controls[-1], add(controls[-1], controls[-2], -1))]
    points = [ends[0], *controls, ends[1]]
    knots = [0.0]
    for a, b in zip(points, points[1:]):
        knots.append(knots[-1] + math.sqrt(math.dist(a, b)))
    curve = []
    for i in range(1, len(points) - 2):
        p, k = points[i - 1:i + 3], knots[i - 1:i + 3]

        def between(a, b, ta, tb, t):
            return add(a, add(b, a, -1), (t - ta) / (tb - ta))

        for step in range(per_span):
            t = k[1] + (k[2] - k[1]) * step / per_span
            a, b, c = (between(p[n], p[n + 1], k[n], k[n + 1], t) for n in range(3))
            d, e = between(a, b, k[0], k[2], t), between(b, c, k[1], k[3], t)
            curve.append(between(d, e, k[1], k[2], t))
    return [*curve, tuple(controls[-1])]


class Path:
    """A curve through closely spaced points, with frames that do not twist (double reflection, Wang et al. 2008)."""

    def __init__(self, points):
        self.points = [tuple(p) for p in points]
        self.way = travelled(self.points)
        self.length = self.way[-1]
        tangents = [unit(derivative(self.points, self.way, i)) for i in range(len(points))]
        least = min(range(3), key=lambda k: abs(tangents[0][k]))
        across = unit(cross(tangents[0], tuple(float(k == least) for k in range(3))))
        self.frames = []  # (across, tangent)
        for i, tangent in enumerate(tangents):
            if i > 0:
                for mirror in (add(self.points[i], self.points[i - 1], -1), None):
                    mirror = mirror or add(tangent, carried, -1)
                    square = dot(mirror, mirror)
                    if square == 0:
                        continue
                    across = add(across, mirror, -2 * dot(mirror, across) / square)
                    carried = add(tangents[i - 1], mirror, -2 * dot(mirror, tangents[i - 1]) / square)
            carried = tangent
            self.frames.append((across, tangent))

    def at(self, way):
        """Position and right-handed frame (u, v, tangent) at `way` along the curve; straight on beyond its ends."""
        i = min(max(bisect.bisect(self.way, way) - 1, 0), len(self.points) - 2)
        part = (way - self.way[i]) / (self.way[i + 1] - self.way[i])
        position = add(self.points[i], add(self.points[i + 1], self.points[i], -1), part)
        blend = [add(a, add(b, a, -1), min(max(part, 0), 1)) for a, b in zip(self.frames[i], self.frames[i + 1])]
        w = unit(blend[1])
        u = unit(add(blend[0], w, -dot(blend[0], w)))
        return position, u, cross(w, u), w


def skin(path, runs, facets):
    """Rings round the path: each run a list of (way along the path, radius), smooth within itself; radius 0 closes the end. From the start
    of the path on, outside; a profile that turns back goes on inside."""
    positions, normals, triangles = [], [], []
    circle = [(math.cos(2 * math.pi * k / facets), math.sin(2 * math.pi * k / facets)) for k in range(facets)]
    for run in runs:
        parameters = travelled(run)
        frames = [path.at(way) for way, _ in run]
        grid = [[add(add(c, u, r * x), v, r * z) for x, z in circle] for (_, r), (c, u, v, _) in zip(run, frames)]
        rows = []
        for i, ((_, radius), (centre, u, v, w)) in enumerate(zip(run, frames)):
            rows.append(len(positions))
            if radius == 0:
                positions.append(centre)
                normals.append(w if i > 0 else add((0, 0, 0), w, -1))
                continue
            for k, (x, z) in enumerate(circle):
                column = [row[k] for row in grid]
                round_it = add(add((0, 0, 0), v, x), u, -z)
                positions.append(grid[i][k])
                normals.append(unit(cross(round_it, derivative(column, parameters, i))))
        for i in range(len(run) - 1):
            a, b = rows[i], rows[i + 1]
            for k in range(facets):
                m = (k + 1) % facets
                if run[i][1] > 0:
                    triangles.append((a + k, a + m, b + m if run[i + 1][1] > 0 else b))
                if run[i + 1][1] > 0:
                    triangles.append((a + k if run[i][1] > 0 else a, b + m, b + k))
    return positions, normals, triangles


def tube(points, radius, facets, spacing, rounding=3):
    """A wire round the curve through `points`, with round ends; rings `spacing` apart."""
    path = Path(points)
    angles = [math.pi / 2 * k / rounding for k in range(rounding)]
    start = [(radius * (1 - math.cos(a)), radius * math.sin(a)) for a in angles]
    count = max(1, round((path.length - 2 * radius) / spacing))
    middle = [(radius + (path.length - 2 * radius) * k / count, radius) for k in range(count + 1)]
    return skin(path, [start + middle + [(path.length - way, r) for way, r in reversed(start)]], facets)


def lathe(runs, facets):
    """Turned round the Y axis: each run a list of (radius, height), upwards outside."""
    return skin(Path([(0, 0, 0), (0, 1, 0)]), [[(height, radius) for radius, height in run] for run in runs], facets)
