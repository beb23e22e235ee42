"""Small linear plots of several curves, in rows and columns, as one SVG."""
import math

from plot import COLORS, text

WIDTH, HEIGHT = 250, 112  # of a panel
LEFT, COLUMN, RIGHT = 66, 284, 12  # to the first panel; from panel to panel; beyond the last
HEADING, GAP, BETWEEN = 22, 18, 34  # above a block's panels; below each; below the block
TICKS = 4  # at most about so many along an axis
DOT = 2.8  # across


def ticks(low, high):
    """Multiples of 1, 2 or 5 times a power of ten."""
    rough = (high - low) / TICKS
    power = 10.0 ** math.floor(math.log10(rough))
    step = next(m * power for m in (1, 2, 5, 10) if m * power >= rough)
    return [k * step for k in range(math.ceil(low / step - 1e-9), math.floor(high / step + 1e-9) + 1)]


class Row:
    """Panels that share their axes. `labels`: lines beside them; `panels`: of each, name -> [(x, y)]."""

    def __init__(self, labels, x_span, y_span, panels):
        self.labels, self.spans, self.panels = labels, (x_span, y_span), panels


def write(path, legend, blocks):
    """legend: names of curves, in the order of their colours, and last that of the dots; blocks: (heads of columns, rows, label of x).
    What lies outside an axis' span is cut off."""
    width, y = LEFT + COLUMN * (max(len(heads) for heads, _, _ in blocks) - 1) + WIDTH + RIGHT, 20
    lines = key(legend, y)
    for heads, rows, x_label in blocks:
        y += HEADING
        lines += [text(left(k) + WIDTH / 2, y - 5, head, font_weight="bold") for k, head in enumerate(heads)]
        for number, row in enumerate(rows):
            lines += [text(x, y + HEIGHT / 2, label, transform=f"rotate(-90 {x} {y + HEIGHT / 2})") for x, label in zip((13, 28), row.labels)]
            for k, curves in enumerate(row.panels):
                lines += panel(row.spans, left(k), y, curves, legend, f"p{len(lines)}", number == len(rows) - 1)
            y += HEIGHT + GAP
        lines += [text(left(k) + WIDTH / 2, y + 13, x_label) for k in range(len(heads))]
        y += BETWEEN
    with open(path, "w", encoding="ascii") as file:
        file.write("\n".join([f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {y}" font-family="sans-serif" font-size="11">',
                              f'<rect width="{width}" height="{y}" fill="white"/>', *lines, "</svg>", ""]))


def left(column):
    return LEFT + COLUMN * column


def key(legend, y):
    lines, x = [], LEFT
    for name in legend:
        lines.append(dots([(x + 6 * k, y - 4) for k in range(5)]) if name == legend[-1] else
                     line([(x, y - 4), (x + 24, y - 4)], COLORS[legend.index(name)]))
        lines.append(text(x + 30, y, name, text_anchor="start"))
        x += 50 + 6 * len(name)
    return lines


def panel(spans, x0, y0, curves, legend, clip, numbered):
    """`clip`: a name for the clipping path, unique in the file; `numbered`: whether numbers stand below the axis of x."""
    def place(x, y):
        (x_low, x_high), (y_low, y_high) = spans
        return x0 + (x - x_low) / (x_high - x_low) * WIDTH, y0 + (y_high - y) / (y_high - y_low) * HEIGHT

    lines = [f'<clipPath id="{clip}"><rect x="{x0}" y="{y0}" width="{WIDTH}" height="{HEIGHT}"/></clipPath>',
             f'<rect x="{x0}" y="{y0}" width="{WIDTH}" height="{HEIGHT}" fill="none" stroke="#999"/>']
    for tick in ticks(*spans[0]):
        x, _ = place(tick, 0)
        lines.append(f'<path d="M{x:.1f} {y0}v{HEIGHT}" stroke="#ddd"/>')
        lines += [text(x, y0 + HEIGHT + 14, f"{tick:.6g}")] if numbered else []
    for tick in ticks(*spans[1]):
        _, y = place(0, tick)
        lines += [f'<path d="M{x0} {y:.1f}h{WIDTH}" stroke="#ddd"/>', text(x0 - 4, y + 4, f"{tick:.6g}", text_anchor="end")]
    lines.append(f'<g clip-path="url(#{clip})">')
    for name, curve in curves.items():
        placed = [place(x, y) for x, y in curve]
        lines.append(dots(placed) if name == legend[-1] else line(placed, COLORS[legend.index(name)]))
    return [*lines, "</g>"]


def line(points, color):
    return f'<path d="M{" ".join(f"{x:.1f} {y:.1f}" for x, y in points)}" fill="none" stroke="{color}" stroke-width="2"/>'


def dots(points):
    return f'<path d="{"".join(f"M{x:.1f} {y:.1f}h0" for x, y in points)}" stroke="black" stroke-width="{DOT}" stroke-linecap="round"/>'
