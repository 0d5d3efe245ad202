"""lichtmc scene: emitters dimmed after a run."""
import csv
import json
import re
import unittest

from support import ProgramTest, lichtmc


class Scene(ProgramTest):
    def setUp(self):
        super().setUp()
        self.room = self.folder / "room.glb"
        made = lichtmc("cuboid", "--size", 5, 3, 4, "--reflectance", 0.5, "--light", "point:1.5,2.8,2:3000lm", "--light",
                       "point:3.5,2.8,2:2000lm", "-o", self.room)
        self.assertEqual(made.returncode, 0, made.stderr)
        self.result = self.folder / "out"

    def run_room(self, *options):
        done = lichtmc("run", self.room, "--photons", "50k", "--only", "receivers", "--no-report", "--plane",
                       "0.75:spacing=1:target_lx=10", "-o", self.result, *options)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done

    def names(self):
        made = lichtmc("scene", self.result, "--json")
        self.assertEqual(made.returncode, 0, made.stderr)
        return [one["name"] for one in json.loads(made.stdout)["emitters"]]

    def refused(self, *options):
        done = lichtmc("scene", self.result, *options)
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertEqual(done.stdout, "")
        return done.stderr

    def test_undimmed_is_the_run(self):
        self.run_room("--per-emitter")
        scene = self.folder / "scene"
        done = lichtmc("scene", self.result, "-o", scene)
        self.assertEqual(done.returncode, 0, done.stderr)
        for name in ("receivers.csv", "areas.csv", "areas/plane.csv"):
            self.assertEqual((self.result / name).read_bytes(), (scene / name).read_bytes(), name)
        for name in ("scene.json", "areas/plane.svg", "areas/plane.dxf"):
            self.assertTrue((scene / name).is_file(), name)
        # What the terminal says of the area is what the run has said.
        self.assertRegex(done.stdout, r"plane: Em [0-9.]+ ± [0-9.]+ lx")

    def test_scenes_are_linear(self):
        self.run_room("--per-emitter")
        first, second = self.names()
        values = {}
        for key, dims in (("all", ()), ("first", (f"{second}=0",)), ("second", (f"{first}=0",)),
                          ("both", (f"{first}=50%", f"{second}=2"))):
            scene = self.folder / key
            done = lichtmc("scene", self.result, *(word for one in dims for word in ("--dim", one)), "-o", scene)
            self.assertEqual(done.returncode, 0, done.stderr)
            with open(scene / "receivers.csv", newline="") as file:
                values[key] = [float(row["irradiance"]) for row in csv.DictReader(file)]
        for all_, one, other, both in zip(*(values[key] for key in ("all", "first", "second", "both"))):
            self.assertAlmostEqual(one + other, all_, delta=1e-12 * all_)
            self.assertAlmostEqual(0.5 * one + 2 * other, both, delta=1e-12 * both)
        scene = json.loads((self.folder / "both" / "scene.json").read_text())
        self.assertEqual(scene["emitted"], 0.5 * 3000 + 2 * 2000)

    def test_scenes_are_designs(self):
        self.run_room("--per-emitter")
        first = self.names()[0]
        scene = self.folder / "scene"
        self.assertEqual(lichtmc("scene", self.result, "--dim", f"{first}=0", "-o", scene).returncode, 0)
        done = lichtmc("compare", "--designs", self.result, scene, "--json")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("plane", done.stdout)

    def test_bad_input(self):
        self.run_room("--per-emitter")
        first = self.names()[0]
        self.assertIn("There is no emitter 'lmp'", self.refused("--dim", "lmp=0.5"))
        self.assertIn("allowed: EMITTER=F", self.refused("--dim", "0.5"))
        self.assertIn("0 or more", self.refused("--dim", f"{first}=-1"))
        self.assertIn("two factors", self.refused("--dim", f"{first}=1", "--dim", "*=0"))
        self.assertIn("holds the results of a run", self.refused("-o", str(self.result)))
        parts = self.result / "emitter_parts.h5"
        whole = parts.read_bytes()
        for damaged in (whole[:2000], b"", whole.replace(b"layout 1", b"layout 9"), whole.replace(b'"columns":', b'"coloums":')):
            parts.write_bytes(damaged)
            self.assertIn("emitter_parts.h5", self.refused())

    def test_runs_without_parts(self):
        self.run_room("--per-emitter")
        self.run_room()
        self.assertIn("--per-emitter", self.refused())  # the file of the earlier run is gone
        done = lichtmc("run", self.room, "--photons", "50k", "--per-emitter", "-o", self.result)
        self.assertEqual(done.returncode, 2)
        self.assertTrue(re.search("no receiver and no calculation area", done.stderr), done.stderr)


if __name__ == "__main__":
    unittest.main()
