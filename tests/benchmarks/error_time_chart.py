"""Chart of error against time, both logarithmic, as SVG. Needs nothing but Python 3."""

import html
import math

WIDTH, HEIGHT = 760, 470
LEFT, RIGHT, TOP, BOTTOM = 78, 44, 84, 62
COLOURS = ("#b3401e", "#1f5fa8", "#2f7d32", "#7a4fa3")


class LogAxis:
    """Maps values to pixels; its range is that of the values, widened to ticks, with room for a label."""

    STEPS = (1, 2, 5)

    def __init__(self, values, from_px, to_px):
        self.ticks = [m * 10.0 ** e for e in range(-4, 6) for m in self.STEPS]
        below = [t for t in self.ticks if t <= 0.9 * min(values)]
        above = [t for t in self.ticks if t >= 1.4 * max(values)]
        self.low, self.high = below[-1], above[0]
        self.ticks = [t for t in self.ticks if self.low <= t <= self.high]
        self.from_px, self.to_px = from_px, to_px

    def at(self, value):
        share = math.log(value / self.low) / math.log(self.high / self.low)
        return self.from_px + share * (self.to_px - self.from_px)


def text(x, y, words, anchor="middle", size=13, extra=""):
    return (f'<text x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}" font-size="{size}" {extra}>'
            f"{html.escape(words)}</text>")


def line(x0, y0, x1, y1, style):
    return f'<line x1="{x0:.1f}" y1="{y0:.1f}" x2="{x1:.1f}" y2="{y1:.1f}" {style}/>'


def draw_axes(x, y, x_label, y_label):
    grid, frame = 'stroke="#dddddd"', 'stroke="#444444"'
    bottom, right = HEIGHT - BOTTOM, WIDTH - RIGHT
    parts = []
    for tick in x.ticks:
        parts += [line(x.at(tick), TOP, x.at(tick), bottom, grid),
                  text(x.at(tick), bottom + 18, f"{tick:g}")]
    for tick in y.ticks:
        parts += [line(LEFT, y.at(tick), right, y.at(tick), grid),
                  text(LEFT - 8, y.at(tick) + 4, f"{tick:g}", "end")]
    middle = (TOP + bottom) / 2
    parts += [line(LEFT, bottom, right, bottom, frame), line(LEFT, TOP, LEFT, bottom, frame),
              text((LEFT + right) / 2, HEIGHT - 18, x_label),
              text(24, middle, y_label, extra=f'transform="rotate(-90 24 {middle:.1f})"')]
    return parts


def draw_series(number, points, x, y):
    """Line and dots; labels above the dots of the first, below those of the others."""
    colour = COLOURS[number]
    path = " ".join(f"{x.at(t):.1f},{y.at(e):.1f}" for t, e, _ in points)
    parts = [f'<polyline points="{path}" fill="none" stroke="{colour}" '
             'stroke-width="2"/>']
    for t, e, label in points:
        parts.append(f'<circle cx="{x.at(t):.1f}" cy="{y.at(e):.1f}" r="4" fill="{colour}"/>')
        if number == 0:
            parts.append(text(x.at(t) + 8, y.at(e) - 7, label, "start", 12, f'fill="{colour}"'))
        else:
            parts.append(text(x.at(t) - 8, y.at(e) + 15, label, "end", 12, f'fill="{colour}"'))
    return parts


def draw_legend(names):
    parts, at = [], LEFT
    for number, name in enumerate(names):
        style = f'stroke="{COLOURS[number]}" stroke-width="2"'
        parts += [line(at, 56, at + 30, 56, style), text(at + 36, 60, name, "start")]
        at += 60 + 7 * len(name)
    return parts


def write_chart(path, title, labels, series):
    """@param labels  of the time and of the error axis, with units
    @param series  up to four of (name, [(time, error, label of the point)])"""
    every = [point for _, points in series for point in points]
    x = LogAxis([t for t, _, _ in every], LEFT, WIDTH - RIGHT)
    y = LogAxis([e for _, e, _ in every], HEIGHT - BOTTOM, TOP)
    parts = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {HEIGHT}" '
             f'width="{WIDTH}" height="{HEIGHT}" font-family="sans-serif">',
             f'<rect width="{WIDTH}" height="{HEIGHT}" fill="white"/>',
             text(LEFT, 30, title, "start", 16)]
    parts += draw_axes(x, y, *labels)
    for number, (_, points) in enumerate(series):
        parts += draw_series(number, points, x, y)
    parts += draw_legend([name for name, _ in series]) + ["</svg>\n"]
    path.write_text("\n".join(parts))
