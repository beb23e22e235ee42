"""Curves as lists of points: outlines in a plane, and splines in space or the plane."""
import math

from vectors import add, combined, dot, lerp, scaled, subtract


def circle(around):
    """Points (x, z) of the unit circle."""
    return [(math.cos(2 * math.pi * k / around), math.sin(2 * math.pi * k / around)) for k in range(around)]


def superellipse(half_x, half_z, around, power):
    """An outline between an ellipse (power 2) and a rectangle."""
    points = []
    for c, s in circle(around):
        r = (abs(c / half_x) ** power + abs(s / half_z) ** power) ** (-1 / power)
        points.append((r * c, r * s))
    return points


def arc(centre, radius, first, last, steps):
    """Points of a circle's arc in the plane, angles in degrees from its first axis towards its second."""
    angles = [math.radians(first + (last - first) * k / steps) for k in range(steps + 1)]
    return [(centre[0] + radius * math.cos(a), centre[1] + radius * math.sin(a)) for a in angles]


def evened(curve, count):
    """`count` points of the closed plane curve, densely given, spread by its length and its turning alike: facets meet at small angles."""
    steps = [subtract(b, a) for a, b in zip(curve, curve[1:] + curve[:1])]
    lengths = [math.hypot(*s) for s in steps]
    turns = [abs(math.atan2(a[0] * b[1] - a[1] * b[0], dot(a, b))) for a, b in zip(steps, steps[1:] + steps[:1])]
    measure = [length / math.fsum(lengths) + turn / math.fsum(turns) for length, turn in zip(lengths, turns)]
    result, passed, whole = [], 0, math.fsum(measure)
    for point, step, part in zip(curve, steps, measure):
        while len(result) < count and len(result) * whole / count < passed + part:
            result.append(add(point, scaled(step, (len(result) * whole / count - passed) / part)))
        passed += part
    return result


def extended(controls):
    """With one more point before and after, straight on: ends for splines that take four controls a span."""
    return [lerp(controls[1], controls[0], 2), *controls, lerp(controls[-2], controls[-1], 2)]


def b_spline(controls, count):
    """`count` + 1 points of the uniform cubic B-spline from the first control to the last: it bends evenly, and passes the others nearby
    only. Controls that stand twice or three times make narrower bends."""
    points, spans = extended(controls), len(controls) - 1
    result = []
    for k in range(count + 1):
        span = min(int(k * spans / count), spans - 1)
        t = k * spans / count - span
        weights = ((1 - t) ** 3 / 6, (3 * t ** 3 - 6 * t ** 2 + 4) / 6, (-3 * t ** 3 + 3 * t ** 2 + 3 * t + 1) / 6, t ** 3 / 6)
        result.append(combined(weights, points[span:span + 4]))
    return result


def catmull_rom(controls, per_span):
    """A curve through all controls, each span cut in `per_span`: the centripetal Catmull-Rom spline, which neither loops nor overshoots."""
    points = extended(controls)
    knots = [0.0]
    for a, b in zip(points, points[1:]):
        knots.append(knots[-1] + math.sqrt(math.dist(a, b)))
    curve = []
    for i in range(1, len(points) - 2):
        p, k = points[i - 1:i + 3], knots[i - 1:i + 3]
        for step in range(per_span):
            t = k[1] + (k[2] - k[1]) * step / per_span
            a, b, c = (lerp(p[n], p[n + 1], (t - k[n]) / (k[n + 1] - k[n])) for n in range(3))
            d, e = lerp(a, b, (t - k[0]) / (k[2] - k[0])), lerp(b, c, (t - k[1]) / (k[3] - k[1]))
            curve.append(lerp(d, e, (t - k[1]) / (k[2] - k[1])))
    return [*curve, tuple(controls[-1])]


def lengths_along(points):
    """The way from the first point to each, along the chords."""
    way = [0.0]
    for a, b in zip(points, points[1:]):
        way.append(way[-1] + math.dist(a, b))
    return way


def derivative(points, way, i):
    """At points[i], of the parabola through it and its neighbours (at an end: the next two), whose parameters are `way`."""
    if len(points) == 2:
        return subtract(points[1], points[0])
    j = min(max(i, 1), len(points) - 2)
    a, b, c = way[j - 1:j + 2]
    t = way[i]
    weights = ((2 * t - b - c) / ((a - b) * (a - c)), (2 * t - a - c) / ((b - a) * (b - c)), (2 * t - a - b) / ((c - a) * (c - b)))
    return combined(weights, points[j - 1:j + 2])
