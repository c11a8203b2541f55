"""bench_traversal: ratios to Embree per set and scene, path mixes, threads, differences."""

from report import svg
from report.common import count, geometric_mean, median, number, origin, table


def _rate(row, mine):
    return row["rays"] / median(mine["seconds"]) * 1e-6


def _embree_best(row):
    """(seconds, "variant, quality") of the fastest variant by medians, or None."""
    variants = [(median(v["seconds"]), f"{v['variant']}, {v['quality']}")
                for v in row.get("embree", [])]
    return min(variants, default=None)


def _ratio(row, mine):
    best = _embree_best(row)
    return best[0] / median(mine["seconds"]) if best else None


def _mix_ratio(scene, config):
    """Of the total time of all rows but mirror."""
    ours = theirs = 0.0
    for row in scene["rows"]:
        best = _embree_best(row)
        if row["set"] == "mirror" or best is None:
            continue
        theirs += best[0]
        ours += median(row["yat"][config]["seconds"])
    return theirs / ours if ours else None


def _cell(rate, ratio):
    return number(rate) + (f" ({ratio:.2f})" if ratio is not None else "")


def _scene(scene):
    """One table: a row per set, a column per config, Embree's best last."""
    configs = [m["config"] for m in scene["rows"][0]["yat"]]
    embree = "embree" in scene["rows"][0]
    lines = [f"### {scene['scene']}, {count(scene['triangles'])} triangles", ""]
    rows = []
    for row in scene["rows"]:
        cells = [row["set"], count(row["rays"])]
        cells += [_cell(_rate(row, m), _ratio(row, m)) for m in row["yat"]]
        if embree:
            seconds, name = _embree_best(row)
            cells += [number(row["rays"] / seconds * 1e-6), name]
        rows.append(cells)
    if embree:
        mix = [_mix_ratio(scene, c) for c in range(len(configs))]
        rows.append(["path mix", ""] + [f"**{m:.2f}**" for m in mix] + ["", ""])
    elif len(configs) > 1:
        rows.append(["speed of the path mix", ""]
                    + [f"**{_seconds(scene, 0) / _seconds(scene, c):.2f}**"
                       for c in range(len(configs))])
    return lines + table(["rays", "number"] + configs
                         + (["Embree's best", "variant, build"] if embree else []), rows)


def _summary(data):
    """Path mix per scene and config, their geometric mean, and the least row."""
    configs = [m["config"] for m in data["scenes"][0]["rows"][0]["yat"]]
    rows = []
    for c, config in enumerate(configs):
        mixes = [_mix_ratio(scene, c) for scene in data["scenes"]]
        least = min((_ratio(row, row["yat"][c]), scene["scene"], row["set"])
                    for scene in data["scenes"] for row in scene["rows"])
        rows.append([config] + [f"{m:.2f}" for m in mixes]
                    + [f"**{geometric_mean(mixes):.2f}**",
                       f"{least[0]:.2f} ({least[1]}, {least[2]})"])
    lines = ["### Path mix, ratio to Embree's best of each row", "",
             "Total time of all rows but mirror; above 1, yat is faster.", ""]
    return lines + table(["yat"] + [s["scene"] for s in data["scenes"]]
                         + ["geometric mean", "least row"], rows)


def _seconds(scene, config):
    """Of all rows but mirror."""
    return sum(median(row["yat"][config]["seconds"]) for row in scene["rows"]
               if row["set"] != "mirror")


def _over_scalar(data):
    """How much faster than the fastest config of plain code each other config is."""
    configs = data["scenes"][0]["rows"][0]["yat"]
    plain = [c for c, m in enumerate(configs) if m["kernel"] == "scalar"]
    if not plain:
        return []
    rows = []
    for c, mine in enumerate(configs):
        if c in plain:
            continue
        best = [min(_seconds(s, p) for p in plain) / _seconds(s, c) for s in data["scenes"]]
        rows.append([mine["config"]] + [f"{b:.2f}" for b in best]
                    + [f"**{geometric_mean(best):.2f}**"])
    lines = ["### Path mix against plain code", "",
             "How much less time than the fastest scalar traversal (one ray, one box, one triangle "
             "at a time).", ""]
    return lines + table(["yat"] + [s["scene"] for s in data["scenes"]] + ["geometric mean"], rows)


def _threads(data):
    """A row per scene, config and number of threads, a column per set."""
    sets = list(dict.fromkeys(r["set"] for s in data["scenes"] for r in s["rows"]))
    cells, control = {}, {}
    for scene in data["scenes"]:
        for more in scene.get("thread_control", []):
            control[(scene["scene"], more["threads"])] = f"{more['scaling']:.2f}"
        for row in scene["rows"]:
            for mine in row["yat"]:
                for more in mine.get("threads", []):
                    key = (scene["scene"], mine["config"], more["threads"])
                    cells.setdefault(key, {})[row["set"]] = (
                        f"{more['scaling']:.2f} / {more['scaling_cpu']:.2f}")
    if not cells:
        return []
    rows = [list(key) + [by_set.get(name, "") for name in sets] +
            [control.get((key[0], key[2]), "")] for key, by_set in cells.items()]
    lines = ["### Threads", "",
             "Gain over one thread by the clock / by processor time. Other programs disturb the "
             "first; the second shows what the threads cost each other in caches and memory. Control: "
             "arithmetic that stays in registers, by the clock.", ""]
    return lines + table(["scene", "yat", "threads"] + sets + ["control"], rows)


def _differences(data):
    names = ["ties", "rounding", "hit_miss", "yat_t_off", "other_t_off", "yat_wrong", "other_wrong",
             "unjudged"]
    rows = []
    for scene in data["scenes"]:
        total = dict.fromkeys(names, 0)
        rays = 0
        for row in scene["rows"]:
            for mine in row["yat"]:
                rays += row["rays"]
                for name in names:
                    total[name] += mine["differences"][name]
        rows.append([scene["scene"], count(rays)] + [count(total[name]) for name in names])
    lines = ["### Answers compared with Embree's", "",
             "All rows and configs together. Ties: another triangle at the same distance. Rounding: "
             "both answers are right, the ray goes along an edge or a surface. t off: the right "
             "triangle, at a distance that is off by more than rounding moves a ray.", ""]
    return lines + table(["scene", "rays", "ties", "rounding", "hit/miss", "yat's t off",
                          "Embree's t off", "yat wrong", "Embree wrong", "not looked at"], rows)


def report(stem, data, plots):
    """Markdown lines; adds SVG texts to plots by file name."""
    lines = [f"## Traversal ({stem})", ""] + origin(data)
    if not data["scenes"]:
        return lines
    lines += [f"Mrays/s on one thread, medians of up to {data['repetitions']} rounds in turn"
              + ("; in brackets the ratio to Embree's fastest variant of that row."
                 if "embree" in data else "."), ""]
    embree = "embree" in data
    if embree:
        lines += _summary(data)
        sets = list(dict.fromkeys(r["set"] for s in data["scenes"] for r in s["rows"]))
        series = []
        for scene in data["scenes"]:
            by_set = {r["set"]: _ratio(r, r["yat"][0]) for r in scene["rows"]}
            series.append((scene["scene"], [by_set.get(s) for s in sets]))
        config = data["scenes"][0]["rows"][0]["yat"][0]["config"]
        plots[f"{stem}-ratio.svg"] = svg.bars(f"Speed against Embree's best variant ({config})",
                                              sets, series, "ratio", line=1)
        lines += [f"![ratios]({stem}-ratio.svg)", ""]
    for scene in data["scenes"]:
        lines += _scene(scene)
    lines += _over_scalar(data)
    lines += _threads(data)
    if embree:
        lines += _differences(data)
    return lines
