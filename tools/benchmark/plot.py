"""Log-log plots as SVG."""
import math

WIDTH, HEIGHT, LEFT, BOTTOM, TOP, RIGHT = 640, 400, 60, 50, 24, 120
COLORS = ("#1b6ca8", "#c8553d", "#4b8b3b", "#7a4fa3")


LINE = 14  # between names of curves


def ticks(low, high):
    """At powers of ten, and at 2 and 5 times these where there are less than two decades."""
    first, last = math.floor(math.log10(low)), math.ceil(math.log10(high))
    factors = (1, 2, 5) if high < 100 * low else (1,)
    return [m * 10.0 ** e for e in range(first, last + 1) for m in factors if low <= m * 10.0 ** e <= high]


def spread(heights):
    """Moves names apart that would lie on one another, downward from the highest."""
    placed = {}
    for name, y in sorted(heights.items(), key=lambda item: item[1]):
        placed[name] = max(y, max(placed.values(), default=-math.inf) + LINE)
    return placed


def text(x, y, words, **attributes):
    listed = " ".join(f'{k.replace("_", "-")}="{v}"' for k, v in {"text_anchor": "middle", **attributes}.items())
    return f'<text x="{x:.1f}" y="{y:.1f}" {listed}>{words}</text>'


def write(path, title, x_label, y_label, curves):
    """curves: name -> [(x, y)], all above 0."""
    points = [p for curve in curves.values() for p in curve]
    spans = [(min(p[k] for p in points) / 1.15, max(p[k] for p in points) * 1.15) for k in (0, 1)]

    def place(value, axis):
        low, high = spans[axis]
        part = math.log(value / low) / math.log(high / low)
        return LEFT + part * (WIDTH - LEFT - RIGHT) if axis == 0 else HEIGHT - BOTTOM - part * (HEIGHT - BOTTOM - TOP)

    lines = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {HEIGHT}" font-family="sans-serif" font-size="11">',
             f'<rect width="{WIDTH}" height="{HEIGHT}" fill="white"/>', text((LEFT + WIDTH - RIGHT) / 2, 15, title)]
    for tick in ticks(*spans[0]):
        x = place(tick, 0)
        lines += [f'<path d="M{x:.1f} {TOP}V{HEIGHT - BOTTOM}" stroke="#ddd"/>', text(x, HEIGHT - BOTTOM + 15, f"{tick:,.10g}".replace(",", " "))]
    for tick in ticks(*spans[1]):
        y = place(tick, 1)
        lines += [f'<path d="M{LEFT} {y:.1f}H{WIDTH - RIGHT}" stroke="#ddd"/>',
                  text(LEFT - 6, y + 4, f"{tick:,.10g}".replace(",", " "), text_anchor="end")]
    lines += [text((LEFT + WIDTH - RIGHT) / 2, HEIGHT - 12, x_label),
              text(16, HEIGHT / 2, y_label, transform=f"rotate(-90 16 {HEIGHT / 2})")]
    names = spread({name: place(max(curve)[1], 1) for name, curve in curves.items()})
    for k, (name, curve) in enumerate(curves.items()):
        color, placed = COLORS[k % len(COLORS)], [(place(x, 0), place(y, 1)) for x, y in sorted(curve)]
        lines.append(f'<path d="M{" L".join(f"{x:.1f} {y:.1f}" for x, y in placed)}" fill="none" stroke="{color}" stroke-width="2"/>')
        lines += [f'<circle cx="{x:.1f}" cy="{y:.1f}" r="3" fill="{color}"/>' for x, y in placed]
        lines.append(text(WIDTH - RIGHT + 8, names[name] + 4, name, text_anchor="start", fill=color))
    with open(path, "w", encoding="ascii") as file:
        file.write("\n".join([*lines, "</svg>", ""]))
