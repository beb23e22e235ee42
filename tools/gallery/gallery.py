"""Renders the pictures of the gallery, the sheet of all, and the animation of a rising water level.

Pictures that stand side by side on the sheet are rendered as large as they are shown, those in a row of three with --resolution."""
import argparse
import os
import re

from PIL import Image

import animation
import sheet
from pictures import ROWS, Difference
from render import Renderer

ROOT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..")
ANIMATION = "water_level"
SHEET = "gallery"
OVERRIDES = ("passes", "samples", "photons")
JPEG_QUALITY = 82  # of the sheet's copy for web pages


def size(text):
    if not re.fullmatch(r"[1-9]\d*x[1-9]\d*", text):
        raise argparse.ArgumentTypeError(f"{text}: WxH is wanted, for example 640x480")
    return tuple(map(int, text.split("x")))


def parse():
    names = [picture.name for row in ROWS for picture in row] + [ANIMATION]
    parser = argparse.ArgumentParser(prog="tools/gallery.sh", description=__doc__.split("\n\n")[0])
    parser.add_argument("folder", nargs="?", default="gallery", metavar="FOLDER", help="is made; by default gallery")
    parser.add_argument("--quality", choices=("draft", "preview", "final"), default="final", help="how much to spend; by default final")
    for name in OVERRIDES:
        parser.add_argument("--" + name, metavar="N", help="of the pictures, as for meniscal render; by default the quality's")
    parser.add_argument("--resolution", type=size, default=(640, 480), metavar="WxH",
                        help="of the pictures in rows of three, 640x480 by default; the sheet is thrice as wide")
    parser.add_argument("--device", default="auto", help="as for meniscal render")
    parser.add_argument("--only", action="append", choices=names, metavar="NAME",
                        help=f"renders only this, may be repeated; the sheet shows what FOLDER has of the rest: {', '.join(names)}")
    parser.add_argument("--meniscal", default=os.path.join(ROOT, "build", "release", "meniscal"), help=argparse.SUPPRESS)
    return parser.parse_args()


class Gallery:
    """Pictures in a folder."""

    def __init__(self, arguments):
        self.folder, self.resolution = arguments.folder, arguments.resolution
        self.renderer = Renderer(arguments.meniscal, os.path.join(ROOT, "scenes"), arguments.folder, ("--device", arguments.device))
        self.quality = ["--quality", arguments.quality]
        for name in OVERRIDES:
            if getattr(arguments, name):
                self.quality += ["--" + name, getattr(arguments, name)]
        self.width = 3 * arguments.resolution[0] + 4 * sheet.GAP  # of the sheet

    def path(self, name):
        return os.path.join(self.folder, name + ".png")

    def opened(self, name):
        return Image.open(self.path(name)).convert("RGB")

    def there(self, row):
        return [picture for picture in row if os.path.exists(self.path(picture.name))]

    def render(self, picture, row):
        """As large as it is shown in the row."""
        if isinstance(picture, Difference):
            missing = [name for name in picture.of if not os.path.exists(self.path(name))]
            if missing:
                raise SystemExit(f"gallery: {picture.name} is made of pictures that are not there: {', '.join(missing)}")
            sheet.difference(*map(self.opened, picture.of), picture.amplification).save(self.path(picture.name))
        else:
            side = sheet.widths(len(row), self.width)
            self.renderer.picture(picture, self.quality, (side, round(side * self.resolution[1] / self.resolution[0])))

    def compose(self):
        """The sheet of all pictures that are there."""
        rows = [[(self.opened(p.name), p.caption) for p in self.there(row)] for row in ROWS if self.there(row)]
        whole = sheet.sheet(rows, self.width)
        whole.save(self.path(SHEET), optimize=True)
        small = os.path.join(self.folder, SHEET + ".jpg")
        whole.save(small, quality=JPEG_QUALITY, optimize=True, progressive=True)
        print(f"All pictures: {self.path(SHEET)}, and a smaller file {small}")


def main():
    arguments = parse()
    os.makedirs(arguments.folder, exist_ok=True)
    gallery = Gallery(arguments)

    def wanted(name):
        return arguments.only is None or name in arguments.only

    for row in ROWS:
        for picture in row:
            if wanted(picture.name):
                gallery.render(picture, row)
    if any(map(gallery.there, ROWS)):
        gallery.compose()
    if wanted(ANIMATION):
        print(f"Animation: {animation.render(gallery.renderer, gallery.path(ANIMATION), arguments.quality)}")


if __name__ == "__main__":
    main()
