#!/usr/bin/env python3
"""Time to equal error of yat and LuxRender's console renderer, by pictures that LuxRender made. See README.md.

    luxrender.py --pictures FOLDER --scenes FOLDER --yat BUILD/bin/yat -o RESULT.json [NAME...]

LuxRender does not run here. Of each picture is known how many samples it took and how many samples a second of
processor time; its error is taken against the mean of yat's runs.
"""

import argparse
import json
import os
import subprocess
import sys
import tempfile
import time

import numpy as np

import measure

# picture: scene, options of yat, samples per pixel done, camera samples per second of processor time (one thread).
PICTURES = {
    "cornell-path10-64spp": ("CornellBox/cornell-box.lxs", "--max-depth 10", 67.1, 360e3),
    "cornell-path10-256spp": ("CornellBox/cornell-box.lxs", "--max-depth 10", 259.5, 387e3),
    "dragon-202k-path10-32spp": ("Dragon/dragon-202k.lxs", "--max-depth 10", 33.5, 432e3),
    "sponza-full-lampflip-path10-32spp": ("Sponza/sponza-full.lxs", "--max-depth 10", 35.9, 33e3),
    "sponza-textured-lampflip-path10": ("Sponza/sponza-textured.lxs", "--max-depth 10", 96, 34e3),
    "luxcornell-path10-64spp": ("LuxCornell/path.lxs", "--max-depth 10", 64.3, 235e3),
    "luxtime-path16-16spp": ("LuxTime/luxtime.lxs", "--max-depth 16", 20.0, 31e3),
    "depth-of-field-high-path10": ("DepthOfField/depth-of-field-high.lxs", "--max-depth 10", 183, 375e3),
    "goku-path10": ("Goku/goku.lxs", "--max-depth 10", 117, 211e3),
}
TILE = 32


def chromaticities(primaries, white):
    """Matrix from linear RGB to XYZ."""
    columns = np.array([[x / y, 1, (1 - x - y) / y] for x, y in primaries]).T
    x, y = white
    return columns * np.linalg.solve(columns, np.array([x / y, 1, (1 - x - y) / y]))


SMPTE_C = chromaticities([(.63, .34), (.31, .595), (.155, .07)], (.314275, .329411))
REC_709 = chromaticities([(.64, .33), (.3, .6), (.15, .06)], (.3127, .3290))


def tiles(x):
    """Sums over tiles of TILE x TILE pixels, those at the right and lower border smaller. x: (H, W) -> (count,)"""
    rows, columns = np.arange(0, x.shape[0], TILE), np.arange(0, x.shape[1], TILE)
    return np.add.reduceat(np.add.reduceat(x, rows, axis=0), columns, axis=1).ravel()


def tile_means_removed(x, mask):
    """x (H, W, 3) less its mean over the pixels of mask in each tile."""
    made = x.copy()
    for y in range(0, x.shape[0], TILE):
        for z in range(0, x.shape[1], TILE):
            part, inside = made[y:y + TILE, z:z + TILE], mask[y:y + TILE, z:z + TILE]
            if inside.any():
                part[inside] -= part[inside].mean(axis=0)
    return made


def without_lamps(o, scene, options, folder, size):
    """Pixels that see no lamp themselves, (H, W) bool: LuxRender shows what is behind some lamps, by up to a third
    of their radiance, and a border's error is not noise."""
    seen, _ = measure.run_yat(o.yat, scene, folder, 16, 1000, 1, [*options, "--max-depth", "0", "--resolution", size])
    return ~(np.abs(seen).max(axis=2) > 0)


def compare(o, name, folder):
    scene, options, spp, rate = PICTURES[name]
    scene, options = os.path.join(o.scenes, scene), [*options.split(), *o.yat_options.split()]
    peer = measure.read_picture(os.path.join(o.pictures, name + ".exr")) @ (np.linalg.inv(REC_709) @ SMPTE_C).T
    height, width = peer.shape[:2]
    size = f"{width}x{height}"
    rest = [a for i, a in enumerate(options) if a != "--max-depth" and (i == 0 or options[i - 1] != "--max-depth")]
    mask = without_lamps(o, scene, rest, folder, size)
    options += ["--resolution", size]

    corner = [*options, "--crop", "0,0.02,0,0.02"]
    start = min(measure.run_yat(o.yat, scene, folder, 1, 0, 1, corner)[1]["cpu"] for _ in range(3))
    pictures, cpu, stats = [], [], None
    for seed in range(o.runs + 1):
        picture, t = measure.run_yat(o.yat, scene, folder, o.spp, seed + 1, 1, options)
        if seed:  # the first warms up
            pictures.append(picture)
            cpu.append(max(1e-9, t["cpu"] - start))
            stats = t["stats"]
    pictures, cpu = np.array(pictures), np.array(cpu)
    reference, variance = pictures.mean(axis=0), pictures.var(axis=0, ddof=1)
    peer_cpu = width * height * spp / rate
    everything = np.ones((height, width), bool)
    grey = reference.mean(axis=2, keepdims=True)
    relative = 1 / (grey ** 2 + 0.01 * grey.mean() ** 2)

    rows = []
    for error, weight in (("MSE", np.ones_like(grey)), ("relMSE", relative)):
        for where, inside in (("all", everything), ("no lamps", mask)):
            w = weight * inside[:, :, None]
            floor = tiles((variance * w).mean(axis=2)) / o.runs
            own = np.array([tiles((((p - reference) ** 2) * w).mean(axis=2)) for p in pictures]) * (o.runs / (o.runs - 1))
            for level, d in (("raw", peer - reference), ("local mean removed", tile_means_removed(peer - reference, inside))):
                other = tiles((d * d * w).mean(axis=2)) - floor
                ratio = lambda tile, run: (other[tile].sum() * peer_cpu  # noqa: E731
                                           / (own[run][:, tile].mean(axis=0).sum() * np.median(cpu[run])))
                r = measure.bootstrap(ratio, np.arange(len(other)), np.arange(o.runs), draws=1000)
                rows.append({"error": error, "pixels": where, "level": level, "ratio": r,
                             "peer": other.sum() / inside.sum(), "yat": own.mean(axis=0).sum() / inside.sum()})
    done = width * height * o.spp
    return {"picture": name, "resolution": [width, height], "peer": {"spp": spp, "cpu": peer_cpu, "rate": rate},
            "yat": {"spp": o.spp, "cpu": float(np.median(cpu)), "rate": done / float(np.median(cpu)), "start": start,
                    "runs": o.runs, "version": stats["version"], "commit": stats["commit"], "build": stats["build"],
                    "settings": stats["settings"], "stages": {k: v["time"] for k, v in stats["stages"].items()}},
            "level": float(peer.mean() / reference.mean() - 1),
            "level_no_lamps": float(peer[mask].mean() / reference[mask].mean() - 1), "rows": rows}


def print_tables(records):
    print("| picture | LuxRender: S/p, CPU s | yat: S/p, CPU s | samples per CPU s, yat / LuxRender | level of LuxRender's, without lamps |")
    print("|---|---|---|---|---|")
    for r in records:
        print(f"| {r['picture']} | {r['peer']['spp']:g}, {r['peer']['cpu']:.0f} | {r['yat']['spp']}, {r['yat']['cpu']:.2f} |"
              f" {r['yat']['rate'] / r['peer']['rate']:.1f} | {100 * r['level']:+.2f} %, {100 * r['level_no_lamps']:+.2f} % |")
    print("\nTTUV of LuxRender over yat's (95 %):\n")
    heads = [(e, p, v) for e in ("MSE", "relMSE") for p in ("all", "no lamps") for v in ("raw", "local mean removed")]
    print("| picture | " + " | ".join(f"{e}, {p}, {v}" for e, p, v in heads) + " |")
    print("|---" * (1 + len(heads)) + "|")
    for r in records:
        cells = {(x["error"], x["pixels"], x["level"]): measure.interval(x["ratio"], "{:.3g}") for x in r["rows"]}
        print(f"| {r['picture']} | " + " | ".join(cells[h] for h in heads) + " |")


def main():
    p = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    p.add_argument("names", nargs="*", help="pictures, without .exr: " + ", ".join(PICTURES))
    p.add_argument("--print", nargs="+", metavar="RESULT", help="show the tables of records instead")
    p.add_argument("--pictures", help="folder of LuxRender's .exr files")
    p.add_argument("--scenes", help="folder of the scenes")
    p.add_argument("--yat", default="build/release/bin/yat")
    p.add_argument("--yat-options", default="", help="further options of yat render")
    p.add_argument("--spp", type=int, default=16, help="samples per pixel of each of yat's runs")
    p.add_argument("--runs", type=int, default=16)
    p.add_argument("--folder", help="where temporary files go")
    p.add_argument("-o", "--output")
    o = p.parse_args()
    records = []
    for path in o.print or []:
        with open(path, encoding="utf-8") as file:
            records += json.load(file)
    if not o.print:
        with tempfile.TemporaryDirectory(dir=o.folder) as folder:
            for name in o.names or PICTURES:
                records.append(compare(o, name, folder) | {"date": time.strftime("%Y-%m-%d")})
                if o.output:
                    with open(o.output, "w", encoding="utf-8") as file:
                        json.dump(records, file, indent=1)
    print_tables(records)


if __name__ == "__main__":
    try:
        main()
    except subprocess.CalledProcessError as e:
        sys.exit(f"luxrender.py: {e}")
