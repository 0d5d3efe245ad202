"""Maintenance factors: --maintenance-factor and the custom property, in check, run and the files of a run."""
import csv
import json
import unittest

from support import ProgramTest, lichtmc, triangle_room


class Maintenance(ProgramTest):
    def room(self, **extras):
        document = triangle_room()
        document["nodes"][1]["extras"] = {"power": 1000, **extras}
        document["nodes"].append({"name": "second", "translation": [0.3, 1, 0.2], "extras": {"power": 500, "lambert_exponent": 1},
                                  "rotation": [-0.7071067811865476, 0, 0, 0.7071067811865476]})
        document["nodes"].append({"name": "head", "translation": [0.3, 0.5, 0.1], "extras": {"receiver": {"quantity": "cylindrical"}}})
        document["scenes"][0]["nodes"] = [0, 1, 2, 3]
        return self.write_gltf(document)

    def run_room(self, room, *options):
        out = self.folder / "out"
        done = lichtmc("run", room, "-o", out, "--histories", "0:4096", *options)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.messages = done.stderr
        with open(out / "emitters.csv", encoding="utf-8") as file:
            emitters = list(csv.DictReader(file))
        with open(out / "receivers.csv", encoding="utf-8") as file:
            receivers = list(csv.DictReader(file))
        return json.loads((out / "summary.json").read_text()), emitters, receivers

    def test_all_figures_are_maintained_ones(self):
        room = self.room()
        new, _, at_new = self.run_room(room, "--no-report")
        self.assertNotIn("aintained", self.messages)
        self.assertEqual(new["maintenance_factor"], 1)
        aged, emitters, at_aged = self.run_room(room, "--maintenance-factor", 0.8)
        self.assertEqual(aged["maintenance_factor"], 0.8)
        self.assertEqual(aged["emitted"], 1200)
        said = ("Maintained values: maintenance factor 0.8, the part of the luminous flux when new that remains; "
                "initial values are 1.25 times as high.")
        self.assertIn(said, self.messages)
        self.assertIn(said, (self.folder / "out" / "report.html").read_text(encoding="utf-8"))
        self.assertAlmostEqual(float(at_aged[0]["direct"]) / float(at_new[0]["direct"]), 0.8, delta=1e-12)
        self.assertEqual([(row["power"], row["maintenance_factor"], row["initial_power"]) for row in emitters],
                         [("800", "0.8", "1000"), ("400", "0.8", "500")])
        self.assertIn("Maintenance factor 0.8: 2 emitters have this share of the new power.", aged["mended"])
        self.assertEqual(aged["receivers"][0]["quantity"], "cylindrical")

    def test_a_factor_of_the_file_is_kept(self):
        room = self.room(maintenance_factor=0.7)
        summary, _, _ = self.run_room(room, "--maintenance-factor", 0.8, "--no-report")
        self.assertIn("Maintained values: maintenance factors 0.7 to 0.8, the part of the luminous flux", self.messages)
        self.assertEqual(summary["maintenance_factor"], None)
        self.assertEqual([(e["power"], e["maintenance_factor"]) for e in summary["emitters"]], [(700, 0.7), (400, 0.8)])

    def test_check_shows_factors_and_what_lacks_one(self):
        room = self.room(maintenance_factor=0.7)
        done = lichtmc("check", room)
        self.assertIn("head: 1 m^2, cylindrical", done.stdout)
        self.assertIn("lamp: 700 lm, maintenance factor 0.7 (new: 1000 lm)", done.stdout)
        self.assertIn("1 emitter has a maintenance factor, 1 emitter has none", done.stdout)
        facts = json.loads(lichtmc("check", room, "--json", "--maintenance-factor", 0.9).stdout)
        self.assertEqual([e["maintenance_factor"] for e in facts["emitters"]], [0.7, 0.9])
        self.assertFalse([finding for finding in facts["findings"] if finding["topic"] == "maintenance"])

    def test_refusals(self):
        self.refused("run", self.room(), "--maintenance-factor", 1.2, says=["maintenance factor is 1.2", "above 0 and up to 1"])
        self.refused("check", self.room(maintenance_factor=0), says=["'maintenance_factor' of node 'lamp' is 0", "above 0"])


if __name__ == "__main__":
    unittest.main()
