#!/usr/bin/env python3
"""Sets the menisci of both models round thin and thick posts side by side with the reference tables: their profiles, the light that they
leave on the floor below, and what they cost. Needs numpy."""
import argparse
import base64
import csv
import json
import os
import sys

import numpy

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.normpath(os.path.join(HERE, ".."))
sys.path[1:1] = [os.path.join(HERE, "benchmark"), os.path.join(HERE, "scenes")]

import exr  # noqa: E402
import panels  # noqa: E402
from make_scenes import MM, bench, matte  # noqa: E402
from process import Meniscal, cpu_seconds  # noqa: E402
from score import TABLES, irradiance  # noqa: E402
from shapes import cylinder  # noqa: E402
from tables import Table, seconds  # noqa: E402

RADII = (0.035, 0.5, 2)  # of the post, mm
ANGLES = (0, 60, 120)    # of contact, degrees
MODELS = ("paper", "exact")
REFERENCE = "reference"
TABULATED = 2            # mm: the radius for which there are tables of the floor
FACETS = 256             # of the post
REACH = 8                # mm from the wall: as far as profiles are shown
STATIONS = 120           # of a profile
RING = 0.05              # mm: width of the tables' rings
SEEN = 12                # mm: the floor's outermost ring
CLEAR = 2.5              # mm: deviations count from there on, beyond what footprints blur of the post's shadow
LEVEL = 0.979627         # of the irradiance: what level water lets through to the floor
EVERY = 3                # rings of the table: one dot
TOPS = {0: 2, 60: 2, 120: 4}  # of the plots of irradiance, by contact angle
SETTINGS = ("--diffuse-bounces", 0, "--aov", "position", "--resolution", "400x400", "--photons", 1000000, "--passes", 2, "--samples", 1)


def write_scene(radius, angle, path):
    scene = bench()
    post = matte(scene, "post", 0, meniscus_contact_angle=angle)
    scene.mesh("post", cylinder(radius * MM, (0, -51 * MM, 0), (0, 10 * MM, 0), FACETS), post)
    scene.write(path)


def water(path):
    """Vertices of the water in a .gltf that `meniscal mesh` wrote, mm."""
    with open(path, encoding="utf-8") as file:
        gltf = json.load(file)
    node = next(n for n in gltf["nodes"] if n["name"] == "water")
    accessor = gltf["accessors"][gltf["meshes"][node["mesh"]]["primitives"][0]["attributes"]["POSITION"]]
    view = gltf["bufferViews"][accessor["bufferView"]]
    data = base64.b64decode(gltf["buffers"][view["buffer"]]["uri"].split(",", 1)[1])
    positions = numpy.frombuffer(data, "<f4", 3 * accessor["count"], view["byteOffset"]).reshape(-1, 3).astype(float)
    return (positions + node.get("translation", (0, 0, 0))) / MM


def profile(vertices, radius):
    """[(distance from the wall, height)], mm: means of the vertices between stations, which lie the denser the nearer to the wall."""
    distance = numpy.maximum(numpy.hypot(vertices[:, 0], vertices[:, 2]) - radius, 0)
    near = distance < 1.5 * REACH  # the last station shown has a neighbour
    station = (STATIONS * numpy.sqrt(distance[near] / REACH)).astype(int)
    count = numpy.bincount(station)
    used = count > 0
    means = [numpy.bincount(station, v[near])[used] / count[used] for v in (distance, vertices[:, 1])]
    return list(zip(*means))


def rise(vertices):
    """Height of the contact line, mm."""
    return vertices[numpy.abs(vertices[:, 1]).argmax(), 1]


def rings(channels):
    """Mean irradiance of the floor's rings, relative to that in the open."""
    ring = (numpy.hypot(channels["position.X"], channels["position.Z"]) / MM / RING).astype(int).ravel()
    return (numpy.bincount(ring, irradiance(channels).ravel()) / numpy.bincount(ring))[:round(SEEN / RING)]


def rows(table):
    with open(os.path.join(TABLES, table), encoding="ascii") as file:
        return list(csv.DictReader(file))


def reference_profile(radius, angle):
    return [(float(r["dist_from_wall_mm"]), float(r["h_mm"])) for r in rows("profiles.csv")
            if r["case"] == "cyl" and float(r["R_mm"]) == radius and float(r["theta"]) == angle]


def reference_rings(angle):
    return numpy.array([float(r[f"theta_{angle}"]) for r in rows("caustic_exact_cyl_R2_H50_full.csv")])[:round(SEEN / RING)]


def by_radius(irradiances, radius, every=1):
    """[(radius, irradiance)] of the rings outside the post."""
    return [(RING * (k + 0.5), e) for k, e in enumerate(irradiances) if RING * k >= radius and k % every == 0]


def rms(values):
    """Over the rings, each as wide as the others, from CLEAR outward."""
    return float(numpy.sqrt(numpy.mean(values[round(CLEAR / RING):] ** 2)))


class Case:
    """A post: of each model the CPU seconds of `meniscal mesh`, the water's vertices, and the floor's rings."""

    def __init__(self, meniscal, folder, radius, angle, repeats):
        self.radius, self.angle = radius, angle
        scene = os.path.join(folder, f"post_{radius:g}_{angle}.gltf")
        mesh, picture = os.path.join(folder, "mesh.gltf"), os.path.join(folder, "floor.exr")
        write_scene(radius, angle, scene)
        self.cost, self.vertices, self.rings = {model: float("inf") for model in MODELS}, {}, {}
        for _ in range(repeats):
            for model in MODELS:  # by turns: what else runs on the machine delays both
                spent = cpu_seconds([meniscal.path, "mesh", scene, "--meniscus", model, "--output", mesh])
                self.cost[model] = min(self.cost[model], spent)
                self.vertices[model] = water(mesh)
        for model in MODELS:
            meniscal.render(scene, picture, "--meniscus", model, *SETTINGS)
            self.rings[model] = rings(exr.read(picture))

    def profiles(self):
        return {**{m: profile(v, self.radius) for m, v in self.vertices.items()}, REFERENCE: reference_profile(self.radius, self.angle)}

    def floors(self):
        floors = {m: by_radius(r, self.radius) for m, r in self.rings.items()}
        if self.radius == TABULATED:
            floors[REFERENCE] = by_radius(reference_rings(self.angle), self.radius, EVERY)
        return floors


def report(cases):
    table = Table("radius, mm", "contact angle", "height at the wall, mm", *MODELS, *(f"CPU s, {m}" for m in MODELS), words=0)
    for c in cases:
        table.row(f"{c.radius:g}", c.angle, f"{reference_profile(c.radius, c.angle)[0][1]:.3f}",
                  *(f"{rise(c.vertices[m]):.3f}" for m in MODELS), *(seconds(c.cost[m]) for m in MODELS))
    print(f"\nFloor round the post of {TABULATED} mm, rings from {CLEAR} to {SEEN} mm: RMS of what the meniscus changes, by the "
          "table, and of each model's deviations from the table, relative to the irradiance in the open\n")
    table = Table("contact angle", "change", *MODELS, *(f"{m}, of the change" for m in MODELS), words=0)
    for c in cases:
        if c.radius == TABULATED:
            truth = reference_rings(c.angle)
            off, change = [rms(c.rings[m] - truth) for m in MODELS], rms(truth - LEVEL)
            table.row(c.angle, f"{change:.3f}", *(f"{o:.3f}" for o in off), *(f"{100 * o / change:.0f} %" for o in off))


def draw(cases, path):
    def row(angle, label, x_span, y_span, curves):
        return panels.Row((f"contact angle {angle}&#176;", label), x_span, y_span, [curves(c) for c in cases if c.angle == angle])

    def height_span(angle):
        heights = [h for c in cases if c.angle == angle for curve in c.profiles().values() for _, h in curve]
        margin = 0.08 * (max(heights) - min(heights))
        return min(heights) - margin, max(heights) + margin

    heads = [f"post of {radius:g} mm radius" for radius in RADII]
    panels.write(path, (*MODELS, REFERENCE), [
        (heads, [row(a, "height, mm", (0, REACH), height_span(a), Case.profiles) for a in ANGLES], "distance from the wall, mm"),
        (heads, [row(a, "irradiance, relative", (0, SEEN), (0, TOPS[a]), Case.floors) for a in ANGLES],
         "distance from the post's axis, on the floor, mm")])


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--repeats", type=int, default=3, metavar="K", help="runs of `meniscal mesh`; the cheapest counts (default 3)")
    parser.add_argument("--meniscal", default=os.path.join(ROOT, "build", "release", "meniscal"), help="program to measure")
    parser.add_argument("--folder", default=os.path.join(ROOT, "build", "profiles"), help="where scenes, pictures and the plot go")
    options = parser.parse_args()
    if not os.path.exists(options.meniscal):
        parser.error(f"there is no {options.meniscal}; build it with tools/build.sh release, or name it with --meniscal")
    os.makedirs(options.folder, exist_ok=True)
    meniscal = Meniscal(options.meniscal)
    cases = [Case(meniscal, options.folder, radius, angle, options.repeats) for angle in ANGLES for radius in RADII]
    report(cases)
    plot = os.path.join(options.folder, "profiles.svg")
    draw(cases, plot)
    print(f"\nPlot: {plot}")


if __name__ == "__main__":
    main()
