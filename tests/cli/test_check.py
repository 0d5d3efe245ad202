"""lichtmc check: findings, messages and exit status."""
import json
import os
import pathlib
import resource
import subprocess
import time
import unittest

from support import PROGRAM, SCENES, ProgramTest, lichtmc

ROOMS = pathlib.Path(os.environ["LICHTMC_ROOMS"])


class CheckTest(ProgramTest):
    def check(self, room, *options, status=0):
        done = lichtmc("check", room, *options)
        self.assertEqual(done.returncode, status, done.stderr + done.stdout)
        self.assertEqual(done.stderr, "")
        return done.stdout

    def findings(self, room, *options, status=0):
        facts = json.loads(self.check(room, "--json", *options, status=status))
        return facts, {f["topic"]: f for f in reversed(facts["findings"])}

    def cuboid(self, *options):
        room = self.folder / "room.glb"
        self.assertEqual(lichtmc("cuboid", "--size", 5, 2.6, 4, "--light", "point:2.5,2,2:1000lm", "-o", room, *options).returncode, 0)
        return room


class Check(CheckTest):
    def test_a_valid_room_has_no_warnings(self):
        facts, _ = self.findings(self.cuboid())
        self.assertEqual((facts["faults"], facts["warnings"]), (0, 0))
        self.assertTrue(facts["usable"] and facts["cuboid"] and facts["convex"] and facts["closed"])
        self.assertEqual((facts["triangles"], facts["open_edges"], facts["flights_that_left"]), (12, 0, 0))
        self.assertEqual(facts["high"], [5, 2.5999999046325684, 4])
        self.check(self.cuboid(), "--strict")
        self.assertIn("accepts this room", self.check(self.cuboid()))

    def test_every_finding_says_what_to_do(self):
        for scene in (*SCENES.glob("*.glb"), *SCENES.glob("*.gltf")):
            facts, _ = self.findings(scene)
            for finding in facts["findings"]:
                self.assertTrue(finding["text"] and finding["advice"], finding)
                self.assertTrue(finding["advice"].endswith("."), finding)

    def test_strict(self):
        room = self.cuboid("--walls", "0.97")
        self.check(room)
        self.assertIn("more than 95 %", self.check(room, "--strict", status=1))
        self.check(room, "--strict", "--max-reflectance", "0.9")

    def test_no_emitter_is_a_fault_and_a_position_is_proposed(self):
        room = self.folder / "dark.glb"
        self.assertEqual(lichtmc("cuboid", "--size", 5, 2.6, 4, "-o", room).returncode, 0)
        facts, found = self.findings(room, status=2)
        self.assertFalse(facts["usable"])
        self.assertIn("--light point:2.5,1.3,2:1000lm", found["emitters"]["advice"])
        self.check(room, "--light", "point:2.5,1.3,2:1000lm")
        # run agrees with check.
        self.refused("run", room, "-o", self.folder / "out", says=["no emitter"])

    def test_units_and_axes(self):
        room = self.folder / "large.glb"
        self.assertEqual(lichtmc("cuboid", "--size", 500, 270, 400, "--light", "point:1,1,1:1000lm", "-o", room).returncode, 0)
        facts, found = self.findings(room, "--tile", 10)
        self.assertEqual(facts["suggested_scale"], 0.01)
        self.assertEqual(found["size"]["severity"], "warning")
        facts, found = self.findings(room, "--scale", "0.01")
        self.assertEqual((facts["suggested_scale"], found["size"]["severity"]), (1, "note"))
        self.assertEqual(facts["mended"], ["Lengths multiplied by 0.01."])
        lying = self.folder / "lying.glb"
        self.assertEqual(lichtmc("cuboid", "--size", 5, 8, 2.6, "--light", "point:1,1,1:1000lm", "-o", lying).returncode, 0)
        self.assertEqual(self.findings(lying)[0]["suggested_up"], "z")
        facts, found = self.findings(lying, "--up", "z")
        self.assertEqual(facts["suggested_up"], "y")
        self.assertNotIn("up-axis", found)

    def test_an_open_room(self):
        facts, found = self.findings(SCENES / "living_room.glb")
        self.assertFalse(facts["closed"])
        self.assertEqual(facts["openings"][0]["side"], "-z")  # the window
        self.assertEqual(found["openings"]["severity"], "warning")
        self.assertGreater(facts["open_edges"], 0)

    def test_an_enclosure_without_absorption(self):
        facts, found = self.findings(self.cuboid("--reflectance", "1"), status=2)
        self.assertEqual(found["trapped-light"]["severity"], "fault")

    def test_tiles_beyond_memory(self):
        facts, found = self.findings(self.cuboid(), "--tile", "0.00001", status=2)
        self.assertEqual(found["tiles"]["severity"], "fault")
        self.assertGreater(facts["flights"], 0)  # the other checks are made too

    def test_power_in_the_wrong_unit(self):
        _, found = self.findings(self.cuboid("--light", "point:1,1,1:1e9lm"))
        self.assertIn("for every square metre of floor", found["emitters"]["text"])

    def test_duplicates(self):
        document = json.loads((SCENES / "cube_paper.gltf").read_text())
        # The floor twice.
        document["nodes"].append({"name": "floor again", "mesh": document["nodes"][0]["mesh"]})
        document["scenes"][0]["nodes"].append(len(document["nodes"]) - 1)
        facts, found = self.findings(self.write_gltf(document))
        self.assertEqual(facts["duplicate_triangles"], 2)
        self.assertEqual(found["one-plane"]["severity"], "warning")

    def test_wrong_options(self):
        self.refused("check", SCENES / "cube_paper.gltf", "--tile", "-1", says=["tile edge", "-1"])
        self.refused("check", SCENES / "cube_paper.gltf", "--up", "x", says=["--up", "y or z"])
        self.refused("check", SCENES / "cube_paper.gltf", "--scale", "0", says=["scale", "above 0"])
        self.refused("check", self.folder / "none.glb", says=["none.glb"])


@unittest.skipUnless(ROOMS.is_dir(), f"the room files do not exist: {ROOMS}")
class RealRooms(CheckTest):
    """Rooms from other sources."""

    def test_known_properties(self):
        real = ROOMS / "real"
        facts, found = self.findings(real / "bevy_CornellBox.glb", "--scale", "0.01")
        self.assertEqual([o["side"] for o in facts["openings"]], ["+z"])  # the front is open
        facts, _ = self.findings(real / "bevy_CornellBox.glb", status=2)
        self.assertEqual(facts["suggested_scale"], 0.01)
        facts, found = self.findings(real / "habitat_simple_room.glb", status=2)
        self.assertEqual(facts["suggested_up"], "z")
        facts, found = self.findings(real / "godot_living_room.glb", status=2)
        self.assertEqual((facts["triangles"], facts["triangles_without_area"]), (1551, 3537))
        facts, found = self.findings(real / "trimesh_no_indices_3storybuilding.glb", "--max-reflectance", "0.9", status=2)
        self.assertIn("on the back face", found["behind"]["text"])  # outward normals
        self.assertGreater(max(s["seen_from_behind"] or 0 for s in facts["surfaces"]), 0.5)
        facts, found = self.findings(real / "webxr_garage/garage.gltf")
        self.assertIn("'mat21' (1)", found["reflectance"]["text"])
        self.assertEqual(found["emitters"]["severity"], "warning")  # 2 lm in a garage

    def test_malformed_files_take_little_time_and_memory(self):
        """Each within 1 s and 200 MB, with a message and exit status 2."""
        for path in sorted((ROOMS / "malformed").rglob("*.gl*")):
            with self.subTest(path.name):
                began = time.monotonic()
                before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss
                done = subprocess.run([PROGRAM, "check", path], capture_output=True, text=True, errors="replace", timeout=10, check=False)
                self.assertLess(time.monotonic() - began, 1.0)
                self.assertLess(max(before, resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss), 200 * 1024)
                self.assertEqual(done.returncode, 2, done.stderr + done.stdout)
                self.assertIn(path.name, done.stderr + done.stdout)


if __name__ == "__main__":
    unittest.main()
