"""What lichtmc run does where no option says so, and what repeats it."""
import csv
import json
import shlex
import unittest

from support import SCENES, ProgramTest, lichtmc

CUBE = SCENES / "cube_paper.gltf"
LIVING_ROOM = SCENES / "living_room.glb"


class Defaults(ProgramTest):
    def run_room(self, *options, room=CUBE, name="out"):
        out = self.folder / name
        done = lichtmc("run", room, "-o", out, "--no-report", "--no-images", *options)
        self.assertEqual(done.returncode, 0, done.stderr)
        return out, json.loads((out / "summary.json").read_text()), done.stderr

    def test_no_option(self):
        _, summary, said = self.run_room()
        asked = summary["settings"]
        self.assertEqual(asked["estimator"], "auto")
        self.assertEqual(asked["target_error"], 0.05)
        self.assertEqual(asked["max_seconds"], 60.0)
        self.assertEqual(asked["error_floor_share"], 0.01)
        self.assertEqual(summary["stopped_by"], "target-error")
        self.assertLessEqual(summary["rms_relative_error"], 0.05)
        self.assertIn("In about two of three places", said)

    def test_rules_and_estimators(self):
        for options, photons, target, seconds, estimator in (
            (["--photons", "20k"], 20000, None, None, "auto"),
            (["--target-error", "20%"], 2**62, 0.2, None, "auto"),
            (["--max-time", "0.2s"], 2**62, None, 0.2, "auto"),
            (["--histories", "0:20480"], 20480, None, None, "collision"),
            (["--max-bounces", "9"], 2**62, 0.05, 60.0, "weight"),
            (["--histories", "0:20480", "--max-bounces", "9"], 20480, None, None, "weight"),
            (["--estimator", "absorption"], 2**62, 0.05, 60.0, "absorption"),
        ):
            with self.subTest(options=options):
                asked = self.run_room(*options)[1]["settings"]
                self.assertEqual(asked["photons"], photons)
                self.assertEqual(asked["target_error"], target)
                self.assertEqual(asked["max_seconds"], seconds)
                self.assertEqual(asked["estimator"], estimator)

    def test_error_floor(self):
        results = {}
        for floor in ("1%", "0", "0.5W/m^2"):
            _, summary, _ = self.run_room("--photons", "50k", "--error-floor", floor)
            results[floor] = summary
        for summary in results.values():
            self.assertEqual(summary["rms_relative_error_without_floor"], results["0"]["rms_relative_error"])
            self.assertEqual(summary["units"]["error_floor"], "W/m^2")
        self.assertEqual(results["0"]["error_floor"], 0.0)
        self.assertEqual(results["0.5W/m^2"]["error_floor"], 0.5)
        # The cube's surfaces have together 6 m²; its darkest tile has far more than 1 % of the mean.
        self.assertAlmostEqual(results["1%"]["error_floor"], 0.01 * results["1%"]["incident"] / 6.0, delta=1e-12)
        self.assertEqual(results["1%"]["rms_relative_error"], results["0"]["rms_relative_error"])
        self.assertLess(results["0.5W/m^2"]["rms_relative_error"], results["0"]["rms_relative_error"])

    def test_resume_with_another_floor(self):
        out, before, _ = self.run_room("--photons", "50k")
        done = lichtmc("resume", out, "--no-report", "--no-images", "--error-floor", "0.5W/m^2")
        self.assertEqual(done.returncode, 0, done.stderr)
        after = json.loads((out / "summary.json").read_text())
        self.assertEqual(after["error_floor"], 0.5)
        self.assertEqual(after["histories"], before["histories"])
        self.assertEqual(after["rms_relative_error_without_floor"], before["rms_relative_error_without_floor"])


class Repeat(ProgramTest):
    """A run that the clock ended is repeated, digit by digit, by the options that it prints."""

    def repeat(self, room, rules, *options):
        first = self.folder / "first"
        done = lichtmc("run", room, "-o", first, "--no-report", "--no-images", *rules, *options)
        self.assertEqual(done.returncode, 0, done.stderr)
        summary = json.loads((first / "summary.json").read_text())
        said = [line.split(": ", 1)[1] for line in done.stderr.splitlines() if line.startswith("The same figures")]
        stored = [options for options in (summary.get("repeat"), (summary["receiver_walk"] or {}).get("repeat")) if options]
        self.assertEqual(said, stored)
        for number, repeating in enumerate(said):
            again = self.folder / f"again{number}"
            done = lichtmc("run", room, "-o", again, "--no-report", "--no-images", *options, *shlex.split(repeating))
            self.assertEqual(done.returncode, 0, done.stderr)
            for table in ("tiles.csv", "receivers.csv"):
                if (again / table).exists():
                    self.assertEqual((again / table).read_bytes(), (first / table).read_bytes(), (table, repeating))
        return said

    def test_tiles_of_the_cube(self):
        self.assertEqual(len(self.repeat(CUBE, ["--max-time", "0.3s"])), 1)

    def test_tiles_and_receivers(self):
        said = self.repeat(LIVING_ROOM, ["--max-time", "3s", "--target-error", "0.1%"], "--tile", "0.5", "--grid", "0.8", "--grid-spacing", "1")
        self.assertEqual(len(said), 2)
        self.assertTrue(any("--estimator auto" in options and "--only receivers" in options for options in said))

    def test_integrated_direct_light(self):
        room = SCENES / "l_room.gltf"
        said = self.repeat(room, ["--max-time", "1s", "--target-error", "0.1%"], "--direct", "analytic", "--tile", "0.5")
        self.assertEqual(len(said), 1)
        self.assertIn("--direct-error", said[0])

    def test_a_run_that_reached_its_target_needs_none(self):
        self.assertEqual(self.repeat(CUBE, ["--photons", "20k"]), [])


class Measure(ProgramTest):
    def tiles(self, out):
        with open(out / "tiles.csv", newline="") as file:
            return [{key: value for key, value in row.items() if key != "tile"} for row in csv.DictReader(file)]

    def test_only_some_surfaces(self):
        for options in (["--estimator", "weight"], ["--tiles", "backward", "--estimator", "weight"]):
            with self.subTest(options=options):
                found = {}
                for name, more in (("all", []), ("some", ["--measure", "f*"])):
                    done = lichtmc("run", CUBE, "-o", self.folder / name, "--photons", "60k", "--no-report", *options, *more)
                    self.assertEqual(done.returncode, 0, done.stderr)
                    found[name] = self.tiles(self.folder / name)
                self.assertEqual(len(found["some"]), 100)
                summary = json.loads((self.folder / "some" / "summary.json").read_text())
                self.assertEqual([s["name"] for s in summary["surfaces"]], ["floor"])
                self.assertIn("Only 1 of 6 surfaces is measured", summary["mended"][-1])
                if "backward" not in options:  # there the histories are shared by fewer tiles
                    self.assertEqual(found["some"], [row for row in found["all"] if row["surface"] == "floor"])
                    self.assertAlmostEqual(summary["absorbed"] + summary["residual"], summary["emitted"], delta=1e-12)

    def test_resumed(self):
        whole, parts = self.folder / "whole", self.folder / "parts"
        options = ["--measure", "floor", "--no-report", "--estimator", "collision"]
        self.assertEqual(lichtmc("run", CUBE, "-o", whole, "--photons", "80k", *options).returncode, 0)
        self.assertEqual(lichtmc("run", CUBE, "-o", parts, "--photons", "30k", *options).returncode, 0)
        done = lichtmc("resume", parts, "--photons", "80k", "--no-report")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual((parts / "tiles.csv").read_bytes(), (whole / "tiles.csv").read_bytes())


if __name__ == "__main__":
    unittest.main()
