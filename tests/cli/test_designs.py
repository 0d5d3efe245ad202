"""Calculation areas as users see them: the line of each, its files, and two designs side by side."""
import csv
import json
import unittest

from support import ProgramTest, lichtmc


class Designs(ProgramTest):
    def setUp(self):
        super().setUp()
        self.room = self.folder / "room.glb"
        made = lichtmc("cuboid", "--size", 4, 2.5, 3, "--light", "lambert:2,2.4,1.5:0,-1,0:1:3000lm", "-o", self.room)
        self.assertEqual(made.returncode, 0, made.stderr)

    def run_with(self, name, *options):
        out = self.folder / name
        done = lichtmc("run", self.room, "-o", out, "--only", "receivers", "--target-error", "3%", "--no-report", *options)
        self.assertEqual(done.returncode, 0, done.stderr)
        return out, done.stderr

    def test_the_outcome_has_a_line_for_each_area(self):
        _, printed = self.run_with("out", "--plane", "0.75:0.5:target_lx=10:target_uniformity=0.1:name=desks",
                                   "--area", "board:1,1,0:2,0,0:0,1,0")
        lines = sorted((line for line in printed.splitlines() if ": Em " in line), reverse=True)
        self.assertEqual(len(lines), 2)
        self.assertRegex(lines[0], r"^desks.*: Em [\d.]+ ± [\d.]+ lx, U0 0\.\d+ ± 0\.\d+, target 10 lx, 0\.10: pass$")
        self.assertRegex(lines[1], r"^board.*: Em [\d.]+ ± [\d.]+ lx, U0 0\.\d+ ± 0\.\d+$")
        self.assertIn("areas.csv, areas/*.csv, areas/*.svg, areas/*.dxf", printed)

    def test_files_are_written_and_removed_when_the_areas_vanish(self):
        out, _ = self.run_with("out", "--plane", "0.75:0.5:spacing=0.5:name=desks")
        areas = json.loads((out / "summary.json").read_text())["areas"]
        self.assertEqual([area["name"] for area in areas], ["desks"])
        for file in areas[0]["files"]:
            self.assertTrue((out / file).is_file(), file)
        with open(out / "areas.csv", newline="") as file:
            row = next(csv.DictReader(file))
        self.assertEqual(float(row["em"]), areas[0]["em"])
        self.assertEqual(int(row["points"]), areas[0]["points"])
        # The grid holds as many numbers as the area has points, and the mean of them is near Em.
        with open(out / areas[0]["files"][0], newline="") as file:
            rows = list(csv.reader(file))
        start = rows.index(["illuminance (lx)"]) + 2
        values = [float(value) for row in rows[start:start + areas[0]["rows"]] for value in row[1:] if value]
        self.assertEqual(len(values), areas[0]["points"])
        self.assertLess(abs(sum(values) / len(values) / areas[0]["em"] - 1.0), 1e-6)
        self.run_with("out", "--grid", "0.75")
        self.assertFalse((out / "areas").exists())
        self.assertFalse((out / "areas.csv").exists())

    def test_two_designs_side_by_side(self):
        plane = ["--plane", "0.75:0.5:target_lx=80:name=desks"]
        today, _ = self.run_with("today", *plane, "--area", "board:1,1,0:2,0,0:0,1,0")
        proposal, _ = self.run_with("proposal", *plane, "--seed", "2", "--light", "lambert:1,2.4,1.5:0,-1,0:1:3000lm")
        done = lichtmc("compare", "--designs", today, proposal)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertIn("desks", done.stdout)
        self.assertIn("missing", done.stdout)
        self.assertIn("target 80 lx", done.stdout)
        self.assertRegex(done.stdout, r"luminous flux, lm +3000 +6000 +\+3000")
        found = json.loads(lichtmc("compare", "--designs", today, proposal, "--json").stdout)
        areas = {area["name"]: area for area in found["areas"]}
        self.assertEqual(sorted(areas), ["board", "desks"])
        desks, board = areas["desks"], areas["board"]
        self.assertAlmostEqual(desks["em_difference"], desks["b"]["em"] - desks["a"]["em"], places=9)
        self.assertGreater(desks["em_difference"], 20 * desks["em_difference_se"])
        self.assertIsNone(board["b"])
        self.assertIsNone(board["em_difference"])
        self.assertEqual(found["power"], {"a": 3000.0, "b": 6000.0})
        self.assertEqual(found["watts"], {"a": None, "b": None})
        self.assertEqual(found["maintenance_factor"], {"a": 1.0, "b": 1.0})
        self.assertEqual(desks["a"]["above_floor"], 0.75)
        self.assertEqual(desks["a"]["em_verdict"], desks["a"]["verdict"])
        self.assertIsNone(desks["a"]["u0_verdict"])

    def test_results_without_areas_are_refused(self):
        out, _ = self.run_with("out", "--grid", "0.75")
        self.refused("compare", "--designs", out, out, says=["has no calculation areas", "--plane"])
        self.refused("compare", "--designs", out, self.folder / "nothing", says=["has no calculation areas"])
        self.refused("compare", "--designs", out, out, "--worst", "3", says=["--worst", "--designs"])


if __name__ == "__main__":
    unittest.main()
