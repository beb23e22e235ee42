"""The contact sheet: rows of pictures as wide as each other, each with its caption below."""
from PIL import Image, ImageChops, ImageDraw, ImageFont

GAP = 12              # pixels between pictures, and round all
ABOVE_CAPTION = 6
LINES = 70            # of captions would fill a square sheet
BACKGROUND, INK = (250, 249, 246), (40, 40, 44)
FONT = "DejaVuSans.ttf"
GREY = 128            # where there is no difference


def widths(count, width):
    """Of `count` pictures side by side on a sheet of `width`."""
    return (width - GAP * (count + 1)) // count


def difference(first, second, amplification):
    """Of two pictures, amplified and added to grey."""
    plus, minus = ImageChops.subtract(first, second), ImageChops.subtract(second, first)
    grey = Image.new("RGB", first.size, (GREY,) * 3)
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
    """rows: [[(picture, caption)]]; the pictures of a row are scaled to fill the sheet's width."""
    leading = width // LINES
    font = ImageFont.truetype(FONT, round(0.8 * leading))
    ruler = ImageDraw.Draw(Image.new("RGB", (1, 1)))
    pictures, lines, y = [], [], GAP  # with the places of their upper left corners
    for row in rows:
        side = widths(len(row), width)
        lefts = [GAP + k * (side + GAP) for k in range(len(row))]
        scaled = [picture.resize((side, round(picture.height * side / picture.width)), Image.LANCZOS) for picture, _ in row]
        pictures += [(picture, (x, y)) for picture, x in zip(scaled, lefts)]
        y += max(picture.height for picture in scaled) + ABOVE_CAPTION
        captions = [wrapped(ruler, caption, font, side) for _, caption in row]
        lines += [(line, (x, y + leading * k)) for caption, x in zip(captions, lefts) for k, line in enumerate(caption)]
        y += leading * max(map(len, captions)) + GAP
    result = Image.new("RGB", (width, y), BACKGROUND)
    for picture, corner in pictures:
        result.paste(picture, corner)
    draw = ImageDraw.Draw(result)
    for line, corner in lines:
        draw.text(corner, line, INK, font)
    return result
