"""Log-log plots as SVG."""
import math

WIDTH, HEIGHT, LEFT, BOTTOM, TOP, RIGHT = 560, 400, 70, 50, 20, 20
COLORS = ("#1b6ca8", "#c8553d", "#4b8b3b", "#7a4fa3")


def decades(low, high):
    """Ticks at 1, 2 and 5 times powers of ten."""
    first, last = math.floor(math.log10(low)), math.ceil(math.log10(high))
    return [m * 10.0 ** e for e in range(first, last + 1) for m in (1, 2, 5) if low <= m * 10.0 ** e <= high]


def write(path, title, x_label, y_label, curves):
    """curves: name -> [(x, y)], all above 0."""
    points = [p for curve in curves.values() for p in curve]
    spans = [(min(p[k] for p in points) / 1.15, max(p[k] for p in points) * 1.15) for k in (0, 1)]

    def place(value, axis):
        low, high = spans[axis]
        part = math.log(value / low) / math.log(high / low)
        return LEFT + part * (WIDTH - LEFT - RIGHT) if axis == 0 else HEIGHT - BOTTOM - part * (HEIGHT - BOTTOM - TOP)

    def text(x, y, words, **attributes):
        listed = " ".join(f'{k.replace("_", "-")}="{v}"' for k, v in {"text_anchor": "middle", **attributes}.items())
        return f'<text x="{x:.1f}" y="{y:.1f}" {listed}>{words}</text>'

    lines = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {HEIGHT}" font-family="sans-serif" font-size="11">',
             f'<rect width="{WIDTH}" height="{HEIGHT}" fill="white"/>', text(WIDTH / 2, 14, title)]
    for tick in decades(*spans[0]):
        x = place(tick, 0)
        lines += [f'<path d="M{x:.1f} {TOP}V{HEIGHT - BOTTOM}" stroke="#ddd"/>', text(x, HEIGHT - BOTTOM + 15, f"{tick:g}")]
    for tick in decades(*spans[1]):
        y = place(tick, 1)
        lines += [f'<path d="M{LEFT} {y:.1f}H{WIDTH - RIGHT}" stroke="#ddd"/>', text(LEFT - 6, y + 4, f"{tick:g}", text_anchor="end")]
    lines += [text((LEFT + WIDTH - RIGHT) / 2, HEIGHT - 12, x_label),
              text(16, HEIGHT / 2, y_label, transform=f"rotate(-90 16 {HEIGHT / 2})")]
    for k, (name, curve) in enumerate(curves.items()):
        color, placed = COLORS[k % len(COLORS)], [(place(x, 0), place(y, 1)) for x, y in sorted(curve)]
        lines.append(f'<path d="M{" L".join(f"{x:.1f} {y:.1f}" for x, y in placed)}" fill="none" stroke="{color}" stroke-width="2"/>')
        lines += [f'<circle cx="{x:.1f}" cy="{y:.1f}" r="3" fill="{color}"/>' for x, y in placed]
        lines.append(text(WIDTH - RIGHT - 8, TOP + 16 * (k + 1), name, text_anchor="end", fill=color))
    with open(path, "w", encoding="ascii") as file:
        file.write("\n".join([*lines, "</svg>", ""]))
