"""Vectors as tuples, of any number of dimensions."""
import math


def add(a, b):
    return tuple(p + q for p, q in zip(a, b))


def subtract(a, b):
    return tuple(p - q for p, q in zip(a, b))


def scaled(a, factor):
    return tuple(factor * p for p in a)


def lerp(a, b, t):
    """From a at t = 0 to b at 1, and straight on beyond."""
    return tuple(p + t * (q - p) for p, q in zip(a, b))


def dot(a, b):
    return sum(p * q for p, q in zip(a, b))


def combined(weights, vectors):
    """The sum of the vectors, each times its weight."""
    return tuple(dot(weights, c) for c in zip(*vectors))


def cross(a, b):
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


def length(a):
    return math.sqrt(dot(a, a))


def unit(a):
    return scaled(a, 1 / length(a))
