#!/usr/bin/env python3
"""What each simplification costs and saves on each scene, as a table in Markdown. Every picture of `--quality final` is compared with many
passes of the scene as it is. Needs Python's standard library alone."""
import argparse
import json
import math
import os
import subprocess
import sys
import tempfile

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.normpath(os.path.join(HERE, ".."))
sys.path.insert(1, os.path.join(HERE, "benchmark"))

from process import Meniscal  # noqa: E402
from tables import Table, percent, seconds  # noqa: E402

SCENES = ("post", "area_light", "shadow_sausage", "tank", "glass_of_water", "two_rods", "curled_hair", "materials")
PAPER, FLAT = "paper profile", "flattened mesh"
OPTIONS = {PAPER: ("--meniscus", "paper"), FLAT: (), "one bounce": ("--diffuse-bounces", 1),
           "no final gathering": ("--final-gathering", "off")}
PHOTONS = 3.2  # a pixel and pass, as `final` has them where pixels are many; few have more
OF_MENISCI = (PAPER, FLAT)  # without menisci there is nothing to simplify


def flattened(scene, folder):
    """A copy of the scene, which holds its buffers and images itself, whose liquids stay level, with their normals alone curved."""
    with open(scene, encoding="utf-8") as file:
        gltf = json.load(file)
    for material in gltf["materials"]:
        if "meniscus_liquid" in material.get("extras", {}):
            material["extras"]["meniscus_flatten"] = 1
    path = os.path.join(folder, "flattened.gltf")
    with open(path, "w", encoding="utf-8") as file:
        json.dump(gltf, file)
    return path


def view(scene, width):
    """Options: as wide as asked for, and as high as the first camera's aspect wants."""
    with open(scene, encoding="utf-8") as file:
        camera = json.load(file)["cameras"][0]
    if "orthographic" in camera:
        aspect = camera["orthographic"]["xmag"] / camera["orthographic"]["ymag"]
    else:
        aspect = camera["perspective"].get("aspectRatio", 4 / 3)
    height = max(1, round(width / aspect))
    return "--resolution", f"{width}x{height}", "--photons", round(PHOTONS * width * height)


class Bench:
    def __init__(self, program, folder, repeats):
        self.meniscal, self.folder, self.repeats = Meniscal(program), folder, repeats

    def path(self, name):
        return os.path.join(self.folder, name + ".exr")

    def render(self, scene, name, *options, repeats=1):
        return self.meniscal.render(scene, self.path(name), "--aov", "none", "--preview", self.path(name) + ".png", *options, repeats=repeats)

    def error(self, name, other):
        """Relative RMSE per pixel."""
        said = subprocess.run([self.meniscal.path, "compare", self.path(name), self.path(other), "--json"], check=True, capture_output=True,
                              text=True).stdout
        return json.loads(said)["layers"][0]["relative_rmse"]

    def row(self, scene, width, passes):
        usual = view(scene, width)
        self.render(scene, "reference", *usual, "--passes", passes, "--seed", 1)
        cost, statistics = self.render(scene, "usual", *usual, repeats=self.repeats)
        error = self.error("usual", "reference")
        yield from (percent(error), seconds(cost))
        menisci = next(f["on"] for f in statistics["plan"] if f["feature"] == "menisci")
        for name, options in OPTIONS.items():
            if name in OF_MENISCI and not menisci:
                yield ""
                continue
            simple = flattened(scene, self.folder) if name == FLAT else scene
            simple_cost, _ = self.render(simple, "simple", *usual, *options, repeats=self.repeats)
            yield f"{added(self.error('simple', 'reference'), error)} / {saved(simple_cost, cost)}"
        draft = (*usual, "--quality", "draft")  # the reference path takes its time
        self.render(scene, "float", *draft)
        self.render(scene, "double", *draft, "--device", "cpu")
        yield f"{100 * self.error('float', 'double'):.2g}"


def added(error, usual):
    """Errors add up as their squares do; negative: less noise and blur is left than the simplification is wrong by."""
    squares = error ** 2 - usual ** 2
    return ("-" if squares < 0 else "") + percent(math.sqrt(abs(squares)))


def saved(cost, usual):
    return f"{100 * (1 - cost / usual):.0f}"


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("scenes", nargs="*", metavar="SCENE.gltf", help="by default those of scenes/ that differ most")
    parser.add_argument("--meniscal", default=os.path.join(ROOT, "build", "release", "meniscal"), metavar="PROGRAM")
    parser.add_argument("--width", type=int, default=128, help="pixels (%(default)s)")
    parser.add_argument("--reference-passes", type=int, default=12, help="(%(default)s)")
    parser.add_argument("--repeats", type=int, default=1, help="runs, of whose CPU seconds the least counts (%(default)s)")
    options = parser.parse_args()
    scenes = options.scenes or [os.path.join(ROOT, "scenes", name + ".gltf") for name in SCENES]
    table = Table("scene", "error %", "CPU s", *OPTIONS, "float for double")
    with tempfile.TemporaryDirectory() as folder:
        bench = Bench(options.meniscal, folder, options.repeats)
        for scene in scenes:
            name = os.path.splitext(os.path.basename(scene))[0]
            table.row(f"`{name}`", *bench.row(scene, options.width, options.reference_passes))


if __name__ == "__main__":
    main()
