"""Mitsuba 3 as a servant of peer_mitsuba.py: reads commands, a JSON object a line, from standard input and answers each
by one line. It stays alive, so that what is compiled at run time is compiled once and timed apart.

    {"do": "load", "scene": FILE.lxs, "resolution": [W, H], "folder": F, "sampler": S, "rr_depth": N, "threads": N}
        -> {"load": seconds}
    {"do": "render", "spp": N, "seed": N, "out": FILE.npy}
        -> {"wall": seconds, "cpu": seconds}
"""

import json
import resource
import sys
import time

import drjit as dr
import mitsuba as mi
import numpy as np

mi.set_variant(sys.argv[1])

from lxs_scene import read_lxs  # noqa: E402
from mitsuba_scene import mitsuba_dict  # noqa: E402


def cpu_seconds():
    usage = resource.getrusage(resource.RUSAGE_SELF)
    return usage.ru_utime + usage.ru_stime


def load(c):
    dr.set_thread_count(c["threads"])
    start = time.perf_counter()
    made = mitsuba_dict(mi, read_lxs(c["scene"]), c["resolution"], c["folder"], c["sampler"], c["rr_depth"])
    scene = mi.load_dict(made)
    dr.eval()
    dr.sync_thread()
    return scene, {"load": time.perf_counter() - start}


def render(scene, c):
    wall, cpu = time.perf_counter(), cpu_seconds()
    image = mi.render(scene, spp=c["spp"], seed=c["seed"])
    dr.eval(image)
    dr.sync_thread()
    wall, cpu = time.perf_counter() - wall, cpu_seconds() - cpu
    if c["out"]:
        np.save(c["out"], np.array(image, dtype=np.float32))
    return {"wall": wall, "cpu": cpu}


def main():
    scene = None
    answers = sys.stdout
    sys.stdout = sys.stderr  # whatever Mitsuba prints is not an answer
    print(json.dumps({"mitsuba": mi.__version__, "drjit": dr.__version__, "variant": mi.variant(),
                      "llvm": ".".join(map(str, dr.detail.llvm_version())) if "llvm" in sys.argv[1] else None}),
          file=answers, flush=True)
    for line in sys.stdin:
        command = json.loads(line)
        if command["do"] == "load":
            scene, answer = load(command)
        else:
            answer = render(scene, command)
        print(json.dumps(answer), file=answers, flush=True)


main()
