"""Google Benchmark programs: bench_kernels as a table of instruction sets, others as a list."""

from report.common import median, number, table

ISAS = ["sse42", "avx2", "avx512", "neon64"]
SECONDS = {"ns": 1e-9, "us": 1e-6, "ms": 1e-3, "s": 1.0}


def _runs(data):
    """{name: [run]} of single runs; aggregates and errors are left out."""
    runs = {}
    for run in data["benchmarks"]:
        if run.get("run_type", "iteration") == "iteration" and not run.get("error_occurred"):
            name = run["name"].removesuffix("/manual_time").removesuffix("/real_time")
            runs.setdefault(name, []).append(run)
    return runs


def _isa_of(name):
    return next((isa for isa in ISAS if isa in name.split("/")), None)


def _kernels(runs):
    """ns per row: a row per kernel and share of active rows, a column per instruction set."""
    found, isas = {}, []
    for name, all_runs in runs.items():
        isa = _isa_of(name)
        if isa not in isas:
            isas.append(isa)
        kernel = "/".join(part for part in name.split("/") if part != isa)
        found.setdefault(kernel, {})[isa] = median([run["s/row"] for run in all_runs]) * 1e9
    rows = [[kernel] + [number(times[isa]) if isa in times else "" for isa in isas]
            for kernel, times in found.items()]
    return table(["ns per row"] + [isa or "all" for isa in isas], rows)


def _list(runs):
    counters = []
    standard = {"real_time", "cpu_time", "iterations", "threads", "repetitions", "repetition_index",
                "family_index", "per_family_instance_index"}
    for all_runs in runs.values():
        for key, value in all_runs[0].items():
            if key not in standard and key not in counters and isinstance(value, (int, float)):
                counters.append(key)
    rows = []
    for name, all_runs in runs.items():
        seconds = median([run["real_time"] * SECONDS[run["time_unit"]] for run in all_runs])
        rows.append([name, number(seconds * 1e3)]
                    + [number(median([run[c] for run in all_runs])) if c in all_runs[0] else ""
                       for c in counters])
    return table(["benchmark", "ms"] + counters, rows)


def report(stem, data, plots):
    """Markdown lines."""
    del plots
    program = data["context"]["executable"].split("/")[-1]
    context = data["context"]
    lines = [f"## {program} ({stem})", "",
             f"{context['num_cpus']} cores, {context['date']}.", ""]
    runs = _runs(data)
    if not runs:
        return lines + ["No benchmark ran.", ""]
    kernels = {n: r for n, r in runs.items() if "s/row" in r[0]}
    others = {n: r for n, r in runs.items() if n not in kernels}
    if kernels:
        lines += _kernels(kernels)
    if others:
        lines += _list(others)
    return lines
