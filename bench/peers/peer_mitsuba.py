#!/usr/bin/env python3
"""Error against time of yat and Mitsuba 3 on one scene, both given what lxs_scene reads of it. See README.md.

    peer_mitsuba.py SCENE.lxs --mitsuba VENV/bin/python --yat BUILD/bin/yat -o RESULT.json [--threads 2] ...

Writes a record of everything as JSON and prints the tables (or: --print RESULT.json ... for records made before).
"""

import argparse
import json
import os
import platform
import subprocess
import sys
import tempfile
import time

import numpy as np

import lxs_scene
import measure

HERE = os.path.dirname(os.path.abspath(__file__))
TARGETS = (1e-1, 1e-2, 1e-3)


class Yat:
    def __init__(self, o, folder):
        self.name, self.o, self.folder = "yat", o, folder
        self.scene = os.path.join(folder, "scene.lxs")
        self.options = ["--colour", "rgb", *o.yat_options.split()]
        lxs_scene.write_lxs(lxs_scene.read_lxs(o.scene), self.scene, o.resolution)
        self.rungs = o.spp_yat
        self.about = {"options": " ".join(self.options)}
        # What a process costs apart from rendering, in processor time: of one sample of few pixels.
        corner = ["--crop", "0,0.02,0,0.02", *self.options]
        self.start = min(measure.run_yat(o.yat, self.scene, folder, 1, 0, o.threads, corner)[1]["cpu"] for _ in range(3))

    def render(self, spp, seed):
        picture, t = measure.run_yat(self.o.yat, self.scene, self.folder, spp, seed, self.o.threads, self.options)
        stats = t["stats"]
        self.about.update(version=stats["version"], commit=stats["commit"], build=stats["build"],
                          settings=stats["settings"])
        return picture, {"wall": t["wall"], "cpu": max(0.0, t["cpu"] - self.start), "setup": t["setup"],
                         "rays": stats["rays"], "stages": {k: v["time"] for k, v in stats["stages"].items()}}

    def close(self):
        pass


class Mitsuba:
    """Mitsuba 3 in a process of its own (mitsuba_worker.py)."""

    def __init__(self, o, folder, variant, sampler, rr_depth):
        self.name, self.o = f"{variant} {sampler}" + ("" if rr_depth == 5 else f" rr{rr_depth}"), o
        self.rungs = o.spp_mitsuba
        self.out = os.path.join(folder, "mitsuba.npy")
        home = tempfile.mkdtemp(dir=folder)  # an empty cache of kernels: the first render compiles
        environment = dict(os.environ, HOME=home, PYTHONPATH=HERE)
        if o.libllvm:
            environment["DRJIT_LIBLLVM_PATH"] = o.libllvm
        self.process = subprocess.Popen([o.mitsuba, os.path.join(HERE, "mitsuba_worker.py"), variant], env=environment,
                                        stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
        self.about = self.answer()
        self.about.update(sampler=sampler, rr_depth=rr_depth)
        self.about.update(self.ask(do="load", scene=o.scene, resolution=o.resolution, folder=home, sampler=sampler,
                                   rr_depth=rr_depth, threads=o.threads))
        self.about["first_render"] = {}

    def answer(self):
        line = self.process.stdout.readline()
        if not line:
            raise RuntimeError(f"{self.name}: Mitsuba has ended")
        return json.loads(line)

    def ask(self, **command):
        self.process.stdin.write(json.dumps(command) + "\n")
        self.process.stdin.flush()
        return self.answer()

    def render(self, spp, seed):
        if spp not in self.about["first_render"]:  # compiles
            self.about["first_render"][spp] = self.ask(do="render", spp=spp, seed=1000000, out="")["wall"]
        t = self.ask(do="render", spp=spp, seed=seed, out=self.out)
        return np.load(self.out).astype(np.float64), t

    def close(self):
        self.process.stdin.close()
        self.process.wait()


def measure_scene(o):
    with tempfile.TemporaryDirectory(dir=o.folder) as folder:
        programs = [Yat(o, folder)]
        for variant in o.variants:
            programs += [Mitsuba(o, folder, variant, sampler, rr) for sampler in o.samplers for rr in o.rr_depths]
        runs = {(p.name, spp): [] for p in programs for spp in p.rungs}
        pictures = {key: [] for key in runs}
        begin = time.monotonic()
        for seed in range(o.runs + 1):
            if seed > 2 and time.monotonic() - begin > o.seconds:
                print(f"only {seed - 1} runs within {o.seconds:g} s", file=sys.stderr)
                break
            for spp in sorted({spp for p in programs for spp in p.rungs}):
                for p in programs:  # in turn, so that what the machine does meets all alike
                    if spp in p.rungs:
                        picture, t = p.render(spp, seed + 1)
                        if seed:  # the first round warms up
                            pictures[p.name, spp].append(picture)
                            runs[p.name, spp].append(t)
        for p in programs:
            p.close()
    return evaluate(o, programs, runs, pictures)


def evaluate(o, programs, runs, pictures):
    # Every picture weighs as its samples do: the best that is known of the scene, if levels agree.
    total = sum(spp * np.mean(pictures[name, spp], axis=0) for name, spp in pictures)
    weight = measure.relative_weight(total / sum(spp for _, spp in pictures))
    rows = []
    for (name, spp), done in runs.items():
        mse, rel = measure.Errors(pictures[name, spp]), measure.Errors(pictures[name, spp], weight)
        rows.append({"program": name, "spp": spp, "mse": mse.mean, "relmse": rel.mean, "relmse_trimmed": rel.trimmed,
                     "mse_runs": mse.runs.tolist(), "relmse_runs": rel.runs.tolist(),
                     "wall": float(np.median([r["wall"] for r in done])),
                     "cpu": float(np.median([r["cpu"] for r in done])), "runs": done})

    def pooled(name):
        top = max(spp for n, spp in pictures if n == name)
        return pictures[name, top]

    first = programs[0].name
    return {"scene": lxs_scene.read_lxs(o.scene).name, "date": time.strftime("%Y-%m-%d"), "resolution": o.resolution,
            "runs": min(map(len, runs.values())), "threads": o.threads,
            "machine": {"cpu": cpu_name(), "cores": os.cpu_count(), "system": platform.platform()},
            "programs": {p.name: p.about for p in programs}, "rows": rows,
            "levels": {p.name: measure.levels(pooled(p.name), pooled(first)) for p in programs[1:]}}


def cpu_name():
    with open("/proc/cpuinfo", encoding="utf-8") as file:
        return next((line.split(":")[1].strip() for line in file if line.startswith("model name")), "unknown")


def time_to(rows, target, clock):
    """Time until relMSE is target, along straight lines through the rungs on logarithmic axes; (seconds, whether the
    target is outside of what was measured). There, error times time is taken as constant: so it is for independent
    samples, and no guess of a slope."""
    rows = sorted(rows, key=lambda r: r["spp"])
    t = np.log([r[clock] for r in rows])
    e = np.log([r["relmse"] for r in rows])
    goal = np.log(target)
    if not e.min() <= goal <= e.max():
        near = e.argmin() if goal < e.min() else e.argmax()
        return float(np.exp(t[near] + e[near] - goal)), True
    i = int(np.clip(np.searchsorted(-e, -goal), 1, len(e) - 1)) if len(e) > 1 else 0
    if i == 0:
        return float(np.exp(t[0])), False
    return float(np.exp(t[i - 1] + (goal - e[i - 1]) * (t[i] - t[i - 1]) / (e[i] - e[i - 1]))), False


def ratios(peer, own, error, clock):
    def efficiency(a, b):
        return a[:, 0].mean() * np.median(a[:, 1]) / (b[:, 0].mean() * np.median(b[:, 1]))

    columns = [np.stack([np.array(r[error + "_runs"]), np.array([x[clock] for x in r["runs"]])], axis=1)
               for r in (peer, own)]
    return measure.bootstrap(efficiency, *columns)


def drawn(rows, generator):
    """The rows as another set of as many runs would have them: runs drawn with replacement, anew for every rung."""
    made = []
    for r in rows:
        at = generator.integers(0, len(r["runs"]), len(r["runs"]))
        made.append({"spp": r["spp"], "relmse": np.array(r["relmse_runs"])[at].mean(),
                     "wall": np.median([r["runs"][i]["wall"] for i in at])})
    return made


def time_ratio(peer, own, target):
    """Ratio of the wall times to a relMSE, with its interval, and whether either had to be guessed."""
    generator = np.random.default_rng(1)
    (a, a_outside), (b, b_outside) = time_to(peer, target, "wall"), time_to(own, target, "wall")
    draws = [time_to(drawn(peer, generator), target, "wall")[0] / time_to(drawn(own, generator), target, "wall")[0]
             for _ in range(1000)]
    low, high = np.percentile(draws, [2.5, 97.5])
    return {"value": a / b, "low": float(low), "high": float(high)}, a_outside or b_outside


def print_tables(record):
    rows = record["rows"]
    own = {r["spp"]: r for r in rows if r["program"] == "yat"}
    print(f"\n### {record['scene']}, {record['resolution'][0]} x {record['resolution'][1]}, "
          f"{record['threads']} thread{'s' if record['threads'] > 1 else ''}\n")
    print("| program | spp | wall s | CPU s | MSE | relMSE | trimmed | TTUV / yat's, wall | CPU | relMSE x time / yat's, wall | CPU |")
    print("|---|---|---|---|---|---|---|---|---|---|---|")
    for r in rows:
        cells = [""] * 4
        if r["program"] != "yat" and r["spp"] in own:
            cells = [measure.interval(ratios(r, own[r["spp"]], e, c)) for e in ("mse", "relmse") for c in ("wall", "cpu")]
        print(f"| {r['program']} | {r['spp']} | {r['wall']:.3f} | {r['cpu']:.3f} | {r['mse']:.3e} | {r['relmse']:.3e} |"
              f" {r['relmse_trimmed']:.3e} | {' | '.join(cells)} |")
    print("\n| program | wall s to relMSE " + " | ".join(f"{t:g} | / yat's" for t in TARGETS) + " |")
    print("|---" * (1 + 2 * len(TARGETS)) + "|")
    for name in record["programs"]:
        cells, of_program = [], [r for r in rows if r["program"] == name]
        for target in TARGETS:
            t, outside = time_to(of_program, target, "wall")
            cells.append(f"{t:.3g}{'*' if outside else ''}")
            if name == "yat":
                cells.append("")
            else:
                ratio, outside = time_ratio(of_program, list(own.values()), target)
                cells.append(measure.interval(ratio) + ("*" if outside else ""))
        print(f"| {name} | " + " | ".join(cells) + " |")
    print("\n(* beyond what was measured)\n")
    for name, v in record["levels"].items():
        print(f"- {name}: level {100 * v['whole']:+.3f} % +- {100 * v['whole_error']:.3f} of yat's; {v['tiles']} tiles of 32 x 32: "
              f"rms {v['tile_rms_z']:.2f} standard errors, largest {v['tile_max_z']:.1f}; rms {100 * v['tile_rms']:.3f} % of the mean, "
              f"{100 * v['tile_rms_by_chance']:.3f} % by chance")
    for name, about in record["programs"].items():
        if "load" in about:
            print(f"- {name}: load {about['load']:.3f} s, first render of each count (compiles) "
                  + ", ".join(f"{k}: {v:.2f} s" for k, v in about["first_render"].items()))
        else:
            setup = np.median([x["setup"] for r in own.values() for x in r["runs"]])
            print(f"- yat: read and build {setup:.3f} s in every process")


def parse(argv):
    p = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    counts = lambda text: [int(v) for v in text.split(",")]  # noqa: E731
    words = lambda text: text.split(",")  # noqa: E731
    p.add_argument("scene", nargs="?")
    p.add_argument("--print", nargs="+", help="show the tables of records instead", metavar="RESULT")
    p.add_argument("-o", "--output", help="record to write")
    p.add_argument("--yat", default="build/release/bin/yat")
    p.add_argument("--yat-options", default="", help="further options of yat render")
    p.add_argument("--mitsuba", default="python3", help="Python that has the module mitsuba")
    p.add_argument("--libllvm", default="", help="LLVM library (15 or newer) for the variants llvm_*")
    p.add_argument("--variants", type=words, default=["llvm_ad_rgb", "scalar_rgb"])
    p.add_argument("--samplers", type=words, default=["independent", "multijitter"])
    p.add_argument("--rr-depths", type=counts, default=[5], help="Mitsuba's rr_depth; 5 is its default")
    p.add_argument("--resolution", type=lambda t: [int(v) for v in t.split("x")], default=[256, 256])
    p.add_argument("--runs", type=int, default=16)
    p.add_argument("--seconds", type=float, default=float("inf"), help="begin no further runs after this time")
    p.add_argument("--threads", type=int, default=1)
    p.add_argument("--spp-yat", type=counts, default=[4, 16, 64])
    p.add_argument("--spp-mitsuba", type=counts, default=[4, 16, 64])
    p.add_argument("--folder", default=None, help="where temporary files go")
    return p.parse_args(argv)


def main():
    o = parse(sys.argv[1:])
    for path in o.print or []:
        with open(path, encoding="utf-8") as file:
            print_tables(json.load(file))
    if o.scene:
        o.scene = os.path.abspath(o.scene)
        record = measure_scene(o)
        if o.output:
            with open(o.output, "w", encoding="utf-8") as file:
                json.dump(record, file, indent=1)
        print_tables(record)


if __name__ == "__main__":
    main()
