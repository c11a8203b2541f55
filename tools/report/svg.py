"""Plots as plain SVG text."""

import math
from xml.sax.saxutils import escape

# Okabe and Ito 2008: told apart by all kinds of colour vision.
COLOURS = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#000000", "#999999"]
DASHES = ["", "6 3", "2 3", "8 3 2 3"]
WIDTH, HEIGHT = 760, 380
LEFT, RIGHT, TOP, BOTTOM = 64, 16, 40, 64


def _text(x, y, text, anchor="middle", size=12, rotate=None, weight="normal"):
    turn = f' transform="rotate({rotate} {x:.1f} {y:.1f})"' if rotate else ""
    return (f'<text x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}" font-size="{size}" '
            f'font-weight="{weight}"{turn}>{escape(str(text))}</text>')


def _line(x1, y1, x2, y2, colour="#cccccc", width=1.0, dash=""):
    style = f' stroke-dasharray="{dash}"' if dash else ""
    return (f'<line x1="{x1:.1f}" y1="{y1:.1f}" x2="{x2:.1f}" y2="{y2:.1f}" stroke="{colour}" '
            f'stroke-width="{width}"{style}/>')


def _page(title, parts, height=HEIGHT):
    return "\n".join(
        [f'<svg xmlns="http://www.w3.org/2000/svg" width="{WIDTH}" height="{height}" '
         f'viewBox="0 0 {WIDTH} {height}" font-family="sans-serif">',
         f'<title>{escape(title)}</title>',
         f'<rect width="{WIDTH}" height="{height}" fill="white"/>',
         _text(WIDTH / 2, 18, title, size=14, weight="bold")] + parts + ["</svg>", ""])


def _legend(names, colours, dashes=None):
    """Under the title, in one row."""
    parts, x = [], LEFT
    for i, name in enumerate(names):
        if dashes is None:
            parts.append(f'<rect x="{x}" y="25" width="10" height="10" fill="{colours[i]}"/>')
        else:
            parts.append(_line(x, 30, x + 18, 30, colours[i], 2, dashes[i]))
        parts.append(_text(x + (14 if dashes is None else 22), 34, name, "start", 11))
        x += 34 + 7 * len(name)
    return parts


def _steps(top):
    """Round values from 0 to at least `top`."""
    raw = top / 6
    unit = 10 ** math.floor(math.log10(raw))
    step = next(unit * f for f in (1, 2, 2.5, 5, 10) if unit * f >= raw)
    return [i * step for i in range(math.ceil(top / step) + 1)]


def bars(title, groups, series, unit, line=None):
    """Bars side by side: series is [(name, one value or None per group)]; `line` marks a value."""
    values = [v for _, row in series for v in row if v is not None]
    top = max(values + ([line] if line else []))
    steps = _steps(top)
    plot_height = HEIGHT - TOP - BOTTOM
    y_of = lambda v: HEIGHT - BOTTOM - plot_height * v / steps[-1]
    parts = _legend([name for name, _ in series], COLOURS * 4)
    for step in steps:
        parts.append(_line(LEFT, y_of(step), WIDTH - RIGHT, y_of(step)))
        parts.append(_text(LEFT - 6, y_of(step) + 4, f"{step:g}", "end", 11))
    parts.append(_text(16, TOP + plot_height / 2, unit, rotate=-90))
    slot = (WIDTH - LEFT - RIGHT) / len(groups)
    width = slot * 0.8 / len(series)
    for g, group in enumerate(groups):
        parts.append(_text(LEFT + slot * (g + 0.5), HEIGHT - BOTTOM + 16, group, size=11))
        for s, (_, row) in enumerate(series):
            if row[g] is None:
                continue
            x = LEFT + slot * (g + 0.1) + width * s
            parts.append(f'<rect x="{x:.1f}" y="{y_of(row[g]):.1f}" width="{width * 0.94:.1f}" '
                         f'height="{HEIGHT - BOTTOM - y_of(row[g]):.1f}" '
                         f'fill="{COLOURS[s % len(COLOURS)]}"/>')
    if line:
        parts.append(_line(LEFT, y_of(line), WIDTH - RIGHT, y_of(line), "#000000", 1.2, "4 3"))
    return _page(title, parts)


def lines(title, series, x_label, y_label, log_y=True):
    """Lines over a logarithmic x: series is [(name, [(x, y)], dash number)]."""
    xs = [x for _, points, _ in series for x, _ in points]
    ys = [y for _, points, _ in series for _, y in points]
    x_low, x_high = math.log10(min(xs)), math.log10(max(xs))
    x_high = max(x_high, x_low + 1e-6)
    if log_y:
        y_low, y_high = math.floor(math.log10(min(ys))), math.ceil(math.log10(max(ys)))
        ticks = [10.0 ** e for e in range(y_low, max(y_high, y_low + 1) + 1)]
        place = lambda v: (math.log10(v) - y_low) / (max(y_high, y_low + 1) - y_low)
    else:
        ticks = _steps(max(ys))
        place = lambda v: v / ticks[-1]
    plot_height = HEIGHT - TOP - BOTTOM
    y_of = lambda v: HEIGHT - BOTTOM - plot_height * place(v)
    x_of = lambda v: LEFT + 8 + (WIDTH - LEFT - RIGHT - 16) * (math.log10(v) - x_low) / (x_high - x_low)
    names = [name for name, _, _ in series]
    colours = [COLOURS[i % len(COLOURS)] for i in range(len(series))]
    dashes = [DASHES[dash % len(DASHES)] for _, _, dash in series]
    parts = _legend(names, colours, dashes)
    for tick in ticks:
        parts.append(_line(LEFT, y_of(tick), WIDTH - RIGHT, y_of(tick)))
        parts.append(_text(LEFT - 6, y_of(tick) + 4, f"{tick:g}", "end", 11))
    for exponent in range(math.floor(x_low), math.ceil(x_high) + 1):
        for factor, name in ((1, True), (2, False), (5, False)):
            x = factor * 10.0 ** exponent
            if x_low - 1e-9 <= math.log10(x) <= x_high + 1e-9:
                parts.append(_line(x_of(x), TOP, x_of(x), HEIGHT - BOTTOM,
                                   "#cccccc" if name else "#eeeeee"))
                parts.append(_text(x_of(x), HEIGHT - BOTTOM + 16, _short(x), size=11))
    parts.append(_text((LEFT + WIDTH) / 2, HEIGHT - 18, x_label))
    parts.append(_text(16, TOP + plot_height / 2, y_label, rotate=-90))
    for i, (_, points, _) in enumerate(series):
        path = " ".join(f"{x_of(x):.1f},{y_of(y):.1f}" for x, y in points)
        style = f' stroke-dasharray="{dashes[i]}"' if dashes[i] else ""
        parts.append(f'<polyline points="{path}" fill="none" stroke="{colours[i]}" '
                     f'stroke-width="2"{style}/>')
        parts += [f'<circle cx="{x_of(x):.1f}" cy="{y_of(y):.1f}" r="3" fill="{colours[i]}"/>'
                  for x, y in points]
    return _page(title, parts)


def _short(value):
    """2000000 -> 2M"""
    for unit, name in ((1e6, "M"), (1e3, "k")):
        if value >= unit:
            return f"{value / unit:g}{name}"
    return f"{value:g}"
