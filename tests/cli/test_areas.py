"""Calculation areas on the command line: --plane, --area, --area-on, areas of a file."""
import csv
import json
import os
import pathlib
import unittest

from support import ProgramTest, lichtmc

DATA = pathlib.Path(os.environ["LICHTMC_TEST_DATA"])


class Areas(ProgramTest):
    def setUp(self):
        super().setUp()
        self.room = self.folder / "room.glb"
        made = lichtmc("cuboid", "--size", 5, 3, 4, "--walls", 0.5, "--ceiling", 0.7, "--floor", 0.2, "--light",
                       "point:2.5,2.8,2:3000lm", "-o", self.room)
        self.assertEqual(made.returncode, 0, made.stderr)

    def run_room(self, *options, room=None):
        done = lichtmc("run", room or self.room, "--only", "receivers", "--photons", "20k", "--no-report", "-o", self.folder / "out",
                       *options)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stderr

    def receivers(self):
        with open(self.folder / "out" / "receivers.csv", newline="") as file:
            return list(csv.DictReader(file))

    def test_working_plane(self):
        notes = self.run_room("--plane", "0.75:0.5:spacing=0.5:target_lx=100:target_uniformity=0.4")
        self.assertIn("Note: Area 'plane': 48 points of 8 × 6, spacing 0.5 m × 0.5 m, 0.75 m above the floor at y = 0 m.", notes)
        rows = self.receivers()
        self.assertEqual(len(rows), 48)
        self.assertEqual(rows[0]["name"], "plane_0_0")
        self.assertAlmostEqual(float(rows[0]["x"]), 0.75, places=4)

    def test_areas_are_not_measured_with_tiles_only(self):
        done = lichtmc("run", self.room, "--only", "tiles", "--photons", "20k", "--no-report", "-o", self.folder / "out",
                       "--plane", "0.75", "--area", "board:0.1,1,1:0,1,0:0,0,2")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("Area 'board': 50 points of 10 × 5, spacing 0.2 m × 0.2 m; it looks to +x.", done.stderr)
        warning = "2 calculation areas ('board', 'plane') are not measured: only tiles were requested."
        self.assertIn("Warning: " + warning, done.stderr)
        summary = json.loads((self.folder / "out" / "summary.json").read_text(encoding="utf-8"))
        self.assertTrue(any(one.startswith(warning) for one in summary["warnings"]), summary["warnings"])

    def test_several_areas(self):
        notes = self.run_room("--plane", "0.75", "--plane", "1.2:0:name=eyes", "--area", "desk:1,0.8,1:1.6,0,0:0,0,0.8:role=task",
                              "--area-on", "wall_x0:0.5:spacing=1:name=west")
        for name in ("'plane_0.75'", "'eyes'", "'desk': 50 points of 10 × 5", "'west'"):
            self.assertIn(name, notes)
        self.assertEqual({row["name"].rsplit("_", 2)[0] for row in self.receivers()}, {"plane_0.75", "eyes", "desk", "west"})

    def test_resume_and_merge_know_the_areas(self):
        self.run_room("--plane", "0.75:spacing=1")
        before = self.receivers()
        again = lichtmc("resume", self.folder / "out", "--photons", "40k")
        self.assertEqual(again.returncode, 0, again.stderr)
        self.assertEqual([row["name"] for row in before], [row["name"] for row in self.receivers()])
        merged = lichtmc("merge", self.folder / "out", "-o", self.folder / "merged")
        self.assertEqual(merged.returncode, 0, merged.stderr)
        self.assertTrue((self.folder / "merged" / "receivers.csv").exists())

    def test_bad_options(self):
        run = ("run", self.room, "-o", self.folder / "out")
        for options, says in (
            (("--plane", "high"), ("--plane high", "a number")),
            (("--plane", "0.75:-1"), ("margin", "-1")),
            (("--plane", "7"), ("No point of the working plane",)),
            (("--plane", "0.75:3"), ("No point of the working plane",)),
            (("--plane", "0.75:size=3"), ("'size'", "spacing=M")),
            (("--plane", "0.75:spacing=0"), ("spacing", "above 0")),
            (("--plane", "0.75:quantity=vertical"), ("'vertical'", "cylindrical")),
            (("--plane", "0.75:quantity=semicylindrical"), ("direction",)),
            (("--plane", "0.75:target_uniformity=60"), ("target_uniformity", "0 to 1")),
            (("--plane", "0.75:0.5:margin=0.4"), ("'margin'", "twice")),
            (("--plane", "0.75", "--plane", "0.75"), ("two calculation areas", "'plane_0.75'")),
            (("--area", "desk"), ("NAME:X,Y,Z:UX,UY,UZ:VX,VY,VZ",)),
            (("--area", "desk:1,1,1:1,0:0,0,1"), ("--area desk",)),
            (("--area", "desk:1,1,1:1,0,0:2,0,0"), ("'desk'", "is 0")),
            (("--area", "desk:9,1,1:1,0,0:0,0,1"), ("No point of the calculation area 'desk'",)),
            (("--area-on", "wall"), ("'wall'", "'wall_x0'")),
            (("--area-on", "floor:9"), ("'floor'", "margin of 9 m")),
        ):
            with self.subTest(options=options):
                self.refused(*run, *options, says=says)

    def test_areas_of_a_file(self):
        document = self.document_of_room()
        floor = next(node for node in document["nodes"] if node.get("name") == "floor")
        document["nodes"].append({"name": "work", "mesh": floor["mesh"], "translation": [0, 0.8, 0],
                                  "extras": {"calculation_area": "background", "spacing": 0.5, "target_lx": 200}})
        document["scenes"][0]["nodes"].append(len(document["nodes"]) - 1)
        room = self.write_gltf(document, "drawn.gltf")
        notes = self.run_room(room=room)
        self.assertIn("Area 'work': 48 points of 8 × 6", notes)
        checked = lichtmc("check", room)
        self.assertEqual(checked.returncode, 0, checked.stderr)
        self.assertIn("Calculation areas (1)", checked.stdout)
        self.assertRegex(checked.stdout, "Receivers +0, and 48 points of calculation areas")
        self.assertIn("Role: background. Target: 200 lx.", checked.stdout)
        self.assertIn("0 faults, 0 warnings", checked.stdout)
        self.assertNotIn("work", [s["name"] for s in json.loads(lichtmc("check", room, "--json").stdout)["surfaces"]])
        # An area outside: a fault in check, refused by run.
        document["nodes"][-1]["translation"] = [20, 0.8, 0]
        room = self.write_gltf(document, "outside.gltf")
        checked = lichtmc("check", room)
        self.assertEqual(checked.returncode, 2)
        self.assertIn("No point of the calculation area 'work'", checked.stdout)
        self.refused("run", room, "-o", self.folder / "out2", says=("No point of the calculation area 'work'",))

    def document_of_room(self):
        path = self.folder / "room.gltf"
        made = lichtmc("cuboid", "--size", 5, 3, 4, "--walls", 0.5, "--ceiling", 0.7, "--floor", 0.2, "--light",
                       "point:2.5,2.8,2:3000lm", "-o", path)
        self.assertEqual(made.returncode, 0, made.stderr)
        return json.loads(path.read_text())

    def test_office(self):
        """A furnished room with a window, a door and desks: 10 x 8 points centred between its walls of 6 m x 5 m."""
        notes = self.run_room("--plane", "0.75:0.5:spacing=0.5", room=DATA / "office.glb")
        self.assertIn("of 10 × 8, spacing 0.5 m × 0.5 m, 0.75 m above the floor at y = 0 m. 24 of its points lie on table tops or the like.", notes)
        rows = [row for row in self.receivers() if row["name"].startswith("plane_")]
        self.assertEqual(len(rows), 80)
        self.assertAlmostEqual(float(rows[0]["x"]), 0.75, places=4)
        self.assertAlmostEqual(float(rows[0]["z"]), -4.25, places=4)
        self.assertAlmostEqual(float(rows[79]["x"]), 5.25, places=4)
        self.assertAlmostEqual(float(rows[79]["z"]), -0.75, places=4)


if __name__ == "__main__":
    unittest.main()
