"""The animation: the water rises and falls again. All frames have one seed and one exposure, so what does not move stands still."""
import math
import os
import sys
import tempfile

from PIL import Image

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(1, os.path.join(HERE, "..", "scenes"))

import water_level  # noqa: E402

SIZE = 320, 240
FRAMES = 16           # from the lowest level to the highest; shown there and back
MILLISECONDS = 100    # of a frame
EXPOSURE = -8.6       # EV; with a linear tone map: its scale is the same in all frames


def levels():
    """Slow at both ends, as the water turns there."""
    middle, half = (water_level.HIGH + water_level.LOW) / 2, (water_level.HIGH - water_level.LOW) / 2
    return [middle - half * math.cos(math.pi * k / (FRAMES - 1)) for k in range(FRAMES)]


def settings(quality):
    """Grain that is the same all over does no harm in a picture, but boils in an animation: more passes, and no final gathering."""
    return ("--quality", "draft") if quality == "draft" else ("--quality", "preview", "--passes", 4)


def render(renderer, path, quality):
    """Writes the animation, a PNG; returns its path."""
    frames = []
    options = (*settings(quality), "--tonemap", "linear", "--exposure", EXPOSURE)
    with tempfile.TemporaryDirectory() as scratch:
        for k, level in enumerate(levels()):
            frame = os.path.join(scratch, f"water_level_{k:02}")
            water_level.water_level(level).write(frame + ".gltf")
            renderer.scene(frame + ".gltf", frame, options, SIZE)
            frames.append(Image.open(frame + ".png").convert("RGB"))
    there_and_back = frames + frames[-2:0:-1]
    there_and_back[0].save(path, save_all=True, append_images=there_and_back[1:], duration=MILLISECONDS, loop=0)
    return path
