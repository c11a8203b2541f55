"""bench_build: time, memory and quality over the number of triangles."""

import math

from report import svg
from report.common import count, median, number, origin, table


def _builder(row, name):
    return next((b for b in row["builders"] if b["builder"] == name), None)


def _ratio(ours, theirs):
    return f"{ours / theirs:.2f}" if theirs else "-"


def _times(data):
    others = [b["builder"] for b in data["rows"][0]["builders"][1:]]
    rows = []
    for row in data["rows"]:
        yat = row["builders"][0]
        wall, cpu = median(yat["wall"]), median(yat["cpu"])
        cells = [row["scene"], count(row["triangles"]), row["threads"], number(wall), number(cpu)]
        for name in others:
            theirs = _builder(row, name)
            cells += [_ratio(wall, median(theirs["wall"])), _ratio(cpu, median(theirs["cpu"]))]
        cells.append(number(wall / (row["triangles"] * math.log2(row["triangles"])) * 1e9))
        rows.append(cells)
    header = ["scene", "triangles", "threads", "s", "processor s"]
    for name in others:
        header += [f"/ {name}", "by processor"]
    return table(header + ["ns / (N log2 N)"], rows)


def _memory(data):
    others = [b["builder"] for b in data["rows"][0]["builders"][1:]]
    rows = []
    for row in data["rows"]:
        yat = row["builders"][0]
        cells = [row["scene"], count(row["triangles"]), row["threads"],
                 number(yat["bytes"] * 1e-6), number(yat["peak_resident_bytes"] * 1e-6)]
        for name in others:
            theirs = _builder(row, name)
            cells += [_ratio(yat["bytes"], theirs["bytes"]),
                      _ratio(yat["peak_resident_bytes"], theirs["peak_resident_bytes"])]
        cells += [f"{row['references'] / row['triangles']:.2f}", f"{row['sah_cost']:.2f}",
                  f"{100 * row['block_fill']:.0f} %", row["max_depth"]]
        rows.append(cells)
    header = ["scene", "triangles", "threads", "MB", "peak MB"]
    for name in others:
        header += [f"MB / {name}", "peak"]
    return table(header + ["references", "SAH", "blocks full", "depth"], rows)


def _plots(stem, data, plots):
    groups = {}
    for row in data["rows"]:
        groups.setdefault((row["scene"], row["threads"]), []).append(row)
    names = []
    for (scene, threads), rows in groups.items():
        if len(rows) < 2:
            continue
        rows = sorted(rows, key=lambda r: r["triangles"])
        series, scaled = [], []
        for i, builder in enumerate(b["builder"] for b in rows[0]["builders"]):
            points = [(r["triangles"], median(_builder(r, builder)["wall"])) for r in rows]
            series.append((builder, points, i))
            scaled.append((builder, [(n, t / (n * math.log2(n)) * 1e9) for n, t in points], i))
        what = f"{scene}, {threads} thread" + ("s" if threads > 1 else "")
        for kind, content, label, log in (("time", series, "seconds", True),
                                          ("growth", scaled, "ns / (N log2 N)", False)):
            name = f"{stem}-{scene}-{threads}-{kind}.svg"
            plots[name] = svg.lines(f"Building {what}", content, "triangles", label, log)
            names.append((name, f"{kind}, {what}"))
    return [f"![{text}]({name})" for name, text in names] + [""] if names else []


def report(stem, data, plots):
    """Markdown lines; adds SVG texts to plots by file name."""
    lines = [f"## Building the tree ({stem})", ""] + origin(data)
    if not data["rows"]:
        return lines
    lines += ["Medians of rounds in turn; ratios below 1: yat takes less. A time that grows as N "
              "log N is a level line in the growth plots.", ""]
    lines += _times(data)
    lines += ["Memory of the finished tree, and the most that the process held while building "
              "above what it held before.", ""]
    lines += _memory(data)
    return lines + _plots(stem, data, plots)
