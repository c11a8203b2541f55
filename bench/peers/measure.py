"""Pictures, errors between seeds, intervals: what both comparisons share. Needs numpy and OpenImageIO's Python module."""

import json
import os
import subprocess
import sys

import numpy as np

try:
    import OpenImageIO as oiio
except ImportError:  # a Python beside the system's: Debian and Ubuntu keep the module here
    sys.path.append("/usr/lib/python3/dist-packages")
    import OpenImageIO as oiio


def read_picture(path):
    """The first three channels, (H, W, 3) doubles. By ImageInput: ImageBuf keeps pictures by name and hands out the old
    one when a file was written anew."""
    file = oiio.ImageInput.open(path)
    if file is None:
        raise OSError(f"{path}: {oiio.geterror()}")
    pixels = np.array(file.read_image(0, 0, 0, 3, oiio.FLOAT)).astype(np.float64)
    file.close()
    return pixels


def run_yat(program, scene, folder, spp, seed, threads, options):
    """One render in a process of its own. Returns the picture and {wall, cpu, setup, stats}: wall is the time of
    rendering alone, cpu the processor time of the whole process, setup the time to read and build."""
    picture, record = os.path.join(folder, "yat.exr"), os.path.join(folder, "yat.json")
    subprocess.run([program, "render", scene, "-q", "--progress", "none", "--spp", str(spp), "--seed", str(seed),
                    "--threads", str(threads), "-o", picture, "--stats", record, *options], check=True)
    with open(record, encoding="utf-8") as file:
        stats = json.load(file)
    time = stats["time"]
    return read_picture(picture), {"wall": time["render"], "cpu": stats["cpu_time"],
                                   "setup": time["read"] + time["build"], "stats": stats}


class Errors:
    """Errors of runs with independent seeds against the mean of the others, scaled by (R - 1) / R: their mean is the
    variance of one run, exactly. weight (H, W, 3) multiplies squared errors."""

    def __init__(self, pictures, weight=None):
        pictures = np.asarray(pictures)
        count = len(pictures)
        deviation = (pictures - pictures.mean(axis=0)) ** 2 * (count / (count - 1))
        if weight is not None:
            deviation = deviation * weight
        self.runs = deviation.mean(axis=(1, 2, 3))
        self.mean = self.runs.mean()
        # Without the 0.1 % of pixels that vary most: where much is missing then, rare samples make the error.
        pixels = np.sort(deviation.mean(axis=(0, 3)).ravel())
        self.trimmed = pixels[:len(pixels) - max(1, len(pixels) // 1000)].sum() / len(pixels)


def relative_weight(reference):
    """1 / (r^2 + epsilon), epsilon = 0.01 mean(r)^2: relMSE as `yat diff` defines it."""
    return 1 / (reference ** 2 + 0.01 * reference.mean() ** 2)


def bootstrap(function, *samples, draws=2000):
    """function(*samples) and the 95 % percentiles of it over resamplings of each; samples: arrays along runs."""
    generator = np.random.default_rng(1)
    values = []
    for _ in range(draws):
        values.append(function(*[s[generator.integers(0, len(s), len(s))] for s in samples]))
    low, high = np.percentile(values, [2.5, 97.5])
    return {"value": float(function(*samples)), "low": float(low), "high": float(high)}


def levels(a, b, tile=32):
    """How well two sets of runs agree: relative difference of the whole picture and, by tiles, its root mean square in
    standard errors (1: chance alone), the largest in standard errors, and the share of light that differs."""
    a, b = np.asarray(a).mean(axis=3), np.asarray(b).mean(axis=3)

    def tiles(x):
        x = x[:, :x.shape[1] // tile * tile, :x.shape[2] // tile * tile]
        return x.reshape(len(x), x.shape[1] // tile, tile, x.shape[2] // tile, tile).mean(axis=(2, 4))

    def difference(x, y):
        error = np.sqrt(x.var(axis=0, ddof=1) / len(x) + y.var(axis=0, ddof=1) / len(y))
        return x.mean(axis=0) - y.mean(axis=0), error

    whole, whole_error = difference(a.mean(axis=(1, 2)), b.mean(axis=(1, 2)))
    parts, part_error = difference(tiles(a), tiles(b))
    z = parts[part_error > 0] / part_error[part_error > 0]
    mean = b.mean()
    return {"whole": float(whole / mean), "whole_error": float(whole_error / mean),
            "tile_rms_z": float(np.sqrt((z ** 2).mean())), "tile_max_z": float(np.abs(z).max()), "tiles": int(z.size),
            "tile_rms": float(np.sqrt((parts ** 2).mean()) / mean),
            "tile_rms_by_chance": float(np.sqrt((part_error ** 2).mean()) / mean)}


def interval(r, form="{:.2f}"):
    return f"{form.format(r['value'])} ({form.format(r['low'])} to {form.format(r['high'])})"
