"""A benchmark scene and its renderings' cost and errors."""
import os

import exr
from score import SIDE, Scorer, irradiance


class Case:
    def __init__(self, name, meniscal, folder):
        """The scene is FOLDER/NAME.gltf."""
        self.name, self.meniscal, self.folder = name, meniscal, folder
        self.scorer = Scorer(name)

    def render(self, *settings, repeats=1):
        """CPU seconds of the whole process, started cold, and the errors."""
        scene, output = (os.path.join(self.folder, f"{self.name}.{ending}") for ending in ("gltf", "exr"))
        seconds, _ = self.meniscal.render(scene, output, "--resolution", f"{SIDE}x{SIDE}", "--diffuse-bounces", 0, *settings,
                                          repeats=repeats)
        return seconds, self.scorer.score(irradiance(exr.read(output)))
