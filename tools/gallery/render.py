"""Renders pictures of the gallery with the program."""
import json
import os
import subprocess
import sys
import tempfile


class Renderer:
    """`program`: path of meniscal; `options`: of every rendering."""

    def __init__(self, program, scenes, folder, options):
        self.program, self.scenes, self.folder, self.options = program, scenes, folder, options

    def picture(self, picture, quality, size):
        """FOLDER/NAME.exr and .png, of `size` (width, height) pixels; `quality`: options. Says what it cost."""
        with tempfile.TemporaryDirectory() as scratch:
            scene = os.path.join(self.scenes, picture.scene + ".gltf")
            if picture.liquid:
                scene = with_liquid(scene, picture.liquid, os.path.join(scratch, picture.name + ".gltf"))
            self.scene(scene, os.path.join(self.folder, picture.name), (*quality, *picture.options), size, picture.window)

    def scene(self, scene, output, options, size, window=(0, 0, 1, 1)):
        """OUTPUT.exr and .png of a scene's file."""
        command = [self.program, "render", scene, "--output", output + ".exr", "--preview", output + ".png", "--quiet",
                   *self.options, *map(str, options), *resolution(size, window)]
        process = subprocess.Popen(command, stdin=subprocess.DEVNULL)
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
        if process.returncode != 0:
            print(f"gallery: exit code {process.returncode} of: {' '.join(command)}", file=sys.stderr)
            raise SystemExit(max(process.returncode, 1))
        print(f"{os.path.basename(output)}: {usage.ru_utime + usage.ru_stime:.1f} CPU s", flush=True)


def resolution(size, window):
    """Options with which a window in the camera's view is so large. All of the view then is larger, but only the window is rendered."""
    left, top, right, bottom = window
    whole = round(size[0] / (right - left)), round(size[1] / (bottom - top))
    x, y = round(left * whole[0]), round(top * whole[1])
    options = ["--resolution", f"{whole[0]}x{whole[1]}"]
    if whole != tuple(size):
        options += ["--crop", f"{x},{y},{x + size[0]},{y + size[1]}"]
    return options


def with_liquid(scene, properties, path):
    """Writes the scene with other properties of its liquids; its buffers stay within the file. Returns `path`."""
    with open(scene, encoding="utf-8") as file:
        gltf = json.load(file)
    liquids = [m for m in gltf["materials"] if "meniscus_liquid" in m.get("extras", {})]
    if not liquids:
        raise SystemExit(f"gallery: {scene} has no liquid to give {properties}")
    for material in liquids:
        material["extras"].update(properties)
    with open(path, "w", encoding="utf-8") as file:
        json.dump(gltf, file)
    return path
