"""bench_report on small recorded inputs: test_bench_report.py TOOLS_FOLDER WORK_FOLDER"""

import pathlib
import shutil
import subprocess
import sys
import unittest
import xml.etree.ElementTree

TOOLS, WORK = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])
INPUTS = pathlib.Path(__file__).parent / "report"


def run(*results, output):
    command = [sys.executable, str(TOOLS / "bench_report"), *map(str, results), "-o", str(output)]
    return subprocess.run(command, capture_output=True, text=True, check=False)


class Report(unittest.TestCase):
    def setUp(self):
        self.folder = WORK / self._testMethodName
        shutil.rmtree(self.folder, ignore_errors=True)
        self.folder.mkdir(parents=True)

    def report(self, name):
        done = run(INPUTS / f"{name}.json", output=self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.check_plots()
        return (self.folder / "report.md").read_text(encoding="utf-8")

    def check_plots(self):
        """Plots are XML, are shown, and what is shown is there."""
        text = (self.folder / "report.md").read_text(encoding="utf-8")
        plots = sorted(self.folder.glob("*.svg"))
        for plot in plots:
            self.assertEqual(xml.etree.ElementTree.parse(plot).getroot().tag,
                             "{http://www.w3.org/2000/svg}svg")
            self.assertIn(f"({plot.name})", text)
        self.assertEqual(text.count("]("), len(plots))
        return plots

    def test_traversal(self):
        text = self.report("traversal")
        # Median 0.05 s for a million rays; the best variant by its median is 0.06.
        self.assertIn("| camera | 1,000,000 | 20.0 (1.20) | 10.0 (0.60) | 2.50 (0.15) | 16.7 | 16 coherent, high |",
                      text)
        self.assertIn("| diffuse 1 | 500,000 | 5.00 (2.00) | 2.50 (1.00) | 0.625 (0.25) | 2.50 | 1, medium |", text)
        # (0.06 + 0.2) / (0.05 + 0.1), without mirror; 0.09 / 0.1; root of the product.
        self.assertIn("| avx512/stream/auto | 1.73 | 0.90 | **1.25** | 0.50 (box, mirror) |", text)
        self.assertIn("| box | avx512/stream/auto | 2 | 1.90 / 1.95 | 1.90 / 1.95 | 1.90 / 1.95 |",
                      text)
        self.assertIn("| box | 7,500,000 | 14 | 4 | 0 | 2 | 0 | 0 | 0 | 0 |", text)
        self.assertIn("| avx2/stream/auto | 4.00 | 4.00 | **4.00** |", text)
        self.assertIn("Test CPU, 2 cores, GNU 12.2.0, commit 0123456789ab", text)
        self.assertEqual(len(self.check_plots()), 1)

    def test_build(self):
        text = self.report("build")
        # 50 ns / (N log2 N) by construction, at half of HIGH's time and twice MEDIUM's.
        self.assertIn("| hall | 1,048,576 | 1 | 1.05 | 1.05 | 2.00 | 2.00 | 0.50 | 0.50 | 50.0 |",
                      text)
        self.assertIn("| hall | 1,024 | 2 | 0.000256 | 0.000512 | 2.00 | 2.00 | 0.50 | 0.50 | 25.0 |",
                      text)
        self.assertIn("| hall | 1,048,576 | 1 | 52.4 | 105 | 0.50 | 0.50 | 0.80 | 0.80 | 1.12 | 12.50 "
                      "| 90 % | 9 |", text)
        self.assertEqual(len(self.check_plots()), 4)

    def test_google_benchmark(self):
        text = self.report("google")
        self.assertIn("| ns per row | avx2 | avx512 |", text)
        self.assertIn("| shade/matte/active:50 | 3.00 | 1.50 |", text)
        self.assertIn("| cornell-box/render/threads:1 | 250 | 40.5 |", text)

    def test_stats(self):
        text = self.report("stats")
        self.assertIn("4.00 million paths and 12.0 million rays per second", text)
        self.assertIn("| intersect | 75.0 % | 167 | 18,000,000 | 93.7 % |", text)
        self.assertIn("| accumulate | 25.0 % |  | 0 |  |", text)

    def test_all_together(self):
        names = ["traversal", "build", "google", "stats"]
        done = run(*[INPUTS / f"{n}.json" for n in names], output=self.folder / "new" / "folder")
        self.assertEqual(done.returncode, 0, done.stderr)
        text = (self.folder / "new" / "folder" / "report.md").read_text(encoding="utf-8")
        self.assertEqual(text.count("\n## "), 4)

    def expect_error(self, content, message):
        file = self.folder / "bad.json"
        file.write_text(content, encoding="utf-8")
        done = run(file, output=self.folder / "out")
        self.assertEqual(done.returncode, 1)
        self.assertTrue(done.stderr.startswith(f"{file}: error: {message}"), done.stderr)
        self.assertEqual(done.stderr.count("\n"), 1)
        self.assertFalse((self.folder / "out").exists())

    def test_errors_name_the_file(self):
        self.expect_error("not JSON", "is not JSON")
        self.expect_error("[1]", "is not the JSON of a measurement")
        self.expect_error("{}", "is no measurement that this program knows")
        self.expect_error('{"program": "bench_build", "rows": []}',
                          "lacks what its program writes (KeyError('machine')")
        done = run(self.folder / "none.json", output=self.folder / "out")
        self.assertEqual(done.returncode, 1)
        self.assertEqual(done.stderr, f"{self.folder / 'none.json'}: error: cannot be read (No such "
                                      "file or directory); check the name\n")

    def test_folder_that_cannot_be_made(self):
        (self.folder / "file").write_text("", encoding="utf-8")
        done = run(INPUTS / "stats.json", output=self.folder / "file")
        self.assertEqual(done.returncode, 3)
        self.assertIn("cannot be written", done.stderr)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
