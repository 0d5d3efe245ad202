"""lichtmc study: files and advice, and a run with the advised settings; and the estimator auto."""
import csv
import json
import shlex
import unittest

from support import SCENES, ProgramTest, lichtmc

CUBE = SCENES / "cube_paper.gltf"
COLUMNS = ("direction,estimator,engine,histories,max_bounces,tile,direct,seconds,rms_error,bias,standard_error,"
           "figure_of_merit").split(",")


class Study(ProgramTest):
    def test_files_and_advice(self):
        out = self.folder / "study"
        done = lichtmc("study", CUBE, "-o", out, "--max-time", "6s", "--tile", "0.25")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("forward, collision", done.stderr)
        self.assertEqual(done.stdout, (out / "advice.txt").read_text())
        with open(out / "study.csv", newline="", encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual(list(rows[0]), COLUMNS)
        self.assertEqual({row["estimator"] for row in rows}, {"weight", "collision", "absorption"})
        self.assertEqual({row["direction"] for row in rows}, {"forward", "backward"})
        self.assertEqual({row["engine"] for row in rows}, {"cuboid", "embree", "embree-fast"})
        self.assertEqual({float(row["tile"]) for row in rows}, {0.125, 0.25, 0.5})
        for picture in ("error_over_time.svg", "bias_over_bounces.svg", "figures_of_merit.svg"):
            self.assertTrue((out / picture).read_text().startswith("<svg"))
        # The command advised for 10 % reaches 10 %.
        line = next(line for line in done.stdout.splitlines() if line.startswith("For 10 %: "))
        command = shlex.split(line.removeprefix("For 10 %: ").split("   (")[0])
        self.assertEqual(command[:2], ["lichtmc", "run"])
        followed = lichtmc(*command[1:], "-o", self.folder / "followed", "--quiet")
        self.assertEqual(followed.returncode, 0, followed.stderr)
        summary = json.loads((self.folder / "followed/summary.json").read_text())
        self.assertEqual(summary["stopped_by"], "target-error")
        self.assertLessEqual(summary["rms_relative_error"], 0.1)

    def test_invalid_studies(self):
        self.refused("study", CUBE, "--quick", "--max-time", "10s", says=["--quick", "--max-time"])
        self.refused("study", CUBE, "--max-time", "1s", "-o", self.folder / "x", says=["5 s or more"])
        self.refused("study", self.folder / "missing.glb", says=["missing.glb"])
        self.refused("study", CUBE, "--threads", "0", says=["threads"])


class Auto(ProgramTest):
    def test_reports_the_choice_and_the_reason(self):
        out = self.folder / "out"
        done = lichtmc("run", CUBE, "-o", out, "--estimator", "auto", "--photons", "300k", "--tile", "0.25", "--no-report")
        self.assertEqual(done.returncode, 0, done.stderr)
        summary = json.loads((out / "summary.json").read_text())
        self.assertIn(summary["estimator"], ("weight", "collision", "absorption"))
        self.assertEqual(len(summary["choices"]), 1)
        self.assertIn(f"'{summary['estimator']}' was chosen for the tiles", summary["choices"][0])
        self.assertIn(summary["choices"][0], done.stdout + done.stderr)
        # Identical to a run with this estimator from the start.
        fixed = self.folder / "fixed"
        done = lichtmc("run", CUBE, "-o", fixed, "--estimator", summary["estimator"], "--photons", "300k", "--tile", "0.25", "--no-report")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual((out / "surfaces.csv").read_text(), (fixed / "surfaces.csv").read_text())
        self.assertEqual(json.loads((fixed / "summary.json").read_text())["choices"], [])


if __name__ == "__main__":
    unittest.main()
