"""The contact sheet: rows of pictures as wide as each other, each with its caption below."""
from PIL import Image, ImageChops, ImageDraw, ImageFont

GAP = 12              # pixels between pictures, and round all
LINES = 70            # of captions, on a square sheet
PAPER, INK = (250, 249, 246), (40, 40, 44)
FONT = "DejaVuSans.ttf"
MIDDLE = 128          # of a difference: no difference


def widths(count, width):
    """Of `count` pictures side by side on a sheet of `width`."""
    return (width - GAP * (count + 1)) // count


def difference(first, second, amplification):
    """Of two pictures, about grey."""
    plus, minus = ImageChops.subtract(first, second), ImageChops.subtract(second, first)
    grey = Image.new("RGB", first.size, (MIDDLE,) * 3)
    return ImageChops.subtract(ImageChops.add(grey, plus.point(lambda v: v * amplification)), minus.point(lambda v: v * amplification))


def wrapped(draw, text, font, width):
    """Lines that are no wider, broken between words."""
    lines = [""]
    for word in text.split():
        longer = f"{lines[-1]} {word}".strip()
        if lines[-1] and draw.textlength(longer, font) > width:
            lines.append(word)
        else:
            lines[-1] = longer
    return lines


def sheet(rows, width):
    """rows: [[(picture, caption)]], all of an aspect; the pictures are scaled to the sheet's width."""
    leading = width // LINES
    font = ImageFont.truetype(FONT, round(0.8 * leading))
    ruler = ImageDraw.Draw(Image.new("RGB", (1, 1)))
    placed, y = [], GAP
    for row in rows:
        side = widths(len(row), width)
        captions = [wrapped(ruler, caption, font, side) for _, caption in row]
        height = max(round(picture.height * side / picture.width) for picture, _ in row)
        for k, (picture, _) in enumerate(row):
            placed.append((GAP + k * (side + GAP), y, side, height, picture, captions[k]))
        y += height + 6 + leading * max(map(len, captions)) + GAP
    result = Image.new("RGB", (width, y), PAPER)
    draw = ImageDraw.Draw(result)
    for x, top, side, height, picture, lines in placed:
        result.paste(picture.resize((side, round(picture.height * side / picture.width)), Image.LANCZOS), (x, top))
        for k, line in enumerate(lines):
            draw.text((x, top + height + 6 + leading * k), line, INK, font)
    return result
