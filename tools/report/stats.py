"""yat render --stats: where the time of a render went."""

from report import svg
from report.common import count, number, table


def report(stem, data, plots):
    """Markdown lines; adds SVG texts to plots by file name."""
    render = data["time"]["render"]
    rays = sum(data["rays"][kind] for kind in ("camera", "bounce", "shadow"))
    width, height = data["resolution"]
    machine = data["machine"]
    scene = data["scene"].split("/")[-1]
    lines = [f"## Render of {scene} ({stem})", "",
             f"{machine['cpu']}, {machine['threads']} threads, {data['build']['isa']}, "
             f"{data['build']['compiler']}, commit {data['commit']}: {width} x {height}, "
             f"{number(data['spp'])} samples per pixel, {number(render)} s, "
             f"{number(data['paths'] / render * 1e-6)} million paths and "
             f"{number(rays / render * 1e-6)} million rays per second.", ""]
    total = sum(stage["time"] for stage in data["stages"].values())
    rows = []
    for name, stage in data["stages"].items():
        lanes = data["lanes"].get(name)
        items = stage["items"]
        rows.append([name, f"{100 * stage['time'] / total:.1f} %",
                     number(stage["time"] / items * 1e9) if items else "", count(items),
                     f"{100 * lanes:.1f} %" if lanes is not None else ""])
    lines += table(["stage", "share", "ns per row", "rows", "lanes"], rows)
    names = list(data["stages"])
    plots[f"{stem}-stages.svg"] = svg.bars(
        f"{scene}: share of worker time", names,
        [("percent", [100 * data["stages"][n]["time"] / total for n in names])], "%")
    return lines + [f"![stages]({stem}-stages.svg)", ""]
