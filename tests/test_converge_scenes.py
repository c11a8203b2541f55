"""converge_scenes with a program that pretends: test_converge_scenes.py TOOLS_FOLDER WORK_FOLDER"""

import pathlib
import shutil
import subprocess
import sys
import unittest

TOOLS, WORK = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])

# Knows two scenes, writes its command line and a report, and fails for the scene "broken".
PROGRAM = r"""#!/usr/bin/env python3
import json, pathlib, sys
command, scene, *rest = sys.argv[1:]
if command == "info":
    print("  camera     pinhole\n  film       400x100, \"out\"")
    sys.exit(0)
if "broken" in scene:
    sys.exit(1)
def measured(value, low, high):
    return {"value": value, "ci95": [low, high]}
def variant(name, slope, ratio, trimmed, noise):
    rung = {"spp": 16, "mse": measured(noise, 0, 0), "ttuv_cpu_ratio": measured(ratio, ratio / 2, ratio * 2),
            "relmse_cpu_ratio": measured(1, .5, 2), "relmse_trimmed": trimmed, "cpu_seconds": 2,
            "unreliable": name == "b"}
    return {"name": name, "slope": measured(slope, slope - .01, slope + .01), "headline_spp": 16, "rungs": [rung],
            "bias": {"difference": .01, "standard_error": .02}}
noise = 0 if "black" in scene else 1
folder = pathlib.Path(rest[rest.index("-o") + 1])
folder.mkdir(parents=True)
(folder / "command").write_text(" ".join(rest))
(folder / "report.json").write_text(json.dumps(
    {"summary": {"variants": [variant("a", -.5, 1, 4, noise), variant("b", -.75, .25, 1, noise)]}}))
"""


class ConvergeScenes(unittest.TestCase):
    def setUp(self):
        self.folder = WORK / self._testMethodName
        shutil.rmtree(self.folder, ignore_errors=True)
        self.folder.mkdir(parents=True)
        self.program = self.folder / "yat"
        self.program.write_text(PROGRAM, encoding="utf-8")
        self.program.chmod(0o755)

    def run_on(self, *words):
        command = [sys.executable, str(TOOLS / "converge_scenes"), *words, "-o", str(self.folder / "out"),
                   "--program", str(self.program)]
        return subprocess.run(command, capture_output=True, text=True, check=False)

    def test_table(self):
        done = self.run_on("box/one.lxs", "box/two.lxs", "black/three.lxs", "--runs", "4", "--pixels", "10000")
        self.assertEqual(done.returncode, 0, done.stderr)
        lines = done.stdout.splitlines()
        self.assertEqual(lines[2], "| box-one | a | -0.500 (-0.510 to -0.490) | 1 | 1 | 1 | +1.000 +- 2.000 |")
        self.assertEqual(lines[3], "|  | b | -0.750 (-0.760 to -0.740) (heavy) | 4.00 (2.00 to 8.00) | "
                                   "1.00 (0.50 to 2.00) | 4.00 | +1.000 +- 2.000 |")
        self.assertTrue(lines[6].startswith("| black-three | without noise |"))
        self.assertIn("b: geometric mean of 2: 4.00 by MSE, 1.00 by relMSE, 4.00 without the worst; least 4.00 "
                      "by MSE.", done.stdout)
        # A quarter of the pixels, as wide as before; what is not its own goes to yat converge.
        said = (self.folder / "out" / "box-one" / "command").read_text(encoding="utf-8")
        self.assertIn("--resolution 200x50", said)
        self.assertIn("--runs 4", said)
        self.assertIn("--variant independent: --sampler independent", said)

    def test_own_variants_and_failures(self):
        done = self.run_on("box/one.lxs", "box/broken.lxs", "--variant", "x: --tree kd")
        self.assertEqual(done.returncode, 1)
        self.assertIn("failed: box/broken.lxs", done.stderr)
        said = (self.folder / "out" / "box-one" / "command").read_text(encoding="utf-8")
        self.assertIn("--variant x: --tree kd", said)
        self.assertNotIn("independent", said)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
