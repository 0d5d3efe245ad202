"""lichtmc luminaire: figures, JSON and picture of photometric files; the schedule of a run."""
import csv
import json
import math
import os
import pathlib
import unittest
import xml.etree.ElementTree

from support import ProgramTest, lichtmc

LUMINAIRES = pathlib.Path(os.environ["LICHTMC_TEST_DATA"]) / "luminaires"


class Luminaire(ProgramTest):
    def shown(self, name, *options):
        done = lichtmc("luminaire", LUMINAIRES / name, *options)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(done.stderr, "")
        return done.stdout

    def test_text(self):
        text = self.shown("c_lambert.ies")
        first = text.splitlines()[0]
        self.assertTrue(first.startswith("c_lambert.ies: a luminaire of 999.4 lm and 50 W."), first)
        for words in ("rotationally symmetric", "19 angles γ, 0° to 90° in steps of 5°", "120° (60° to either side)",
                      "318.3 cd at C 0°, γ 0°", "30° to 60°: 499.7 lm (50 %)", "rectangle, 0.6 × 0.6 m", "19.99 lm/W"):
            self.assertIn(words, text)
        self.assertNotIn("Warning", text)
        self.assertIn("Warning: TILT factors", self.shown("c_tilt_include.ies"))
        self.assertIn("C0 lies along its shorter side", self.shown("c_ldt_up.ldt"))
        self.assertEqual(sorted(p.name for p in self.folder.iterdir()), [])  # no file without -o

    def test_lamp_sets_and_the_other_count_of_h(self):
        one = json.loads(self.shown("c_ldt_two_sets.ldt", "--json"))
        two = json.loads(self.shown("c_ldt_two_sets.ldt", "--json", "--set", "2"))
        self.assertEqual((one["lamp_set"], two["lamp_set"]), (1, 2))
        self.assertEqual(len(two["lamp_sets"]), 2)
        ratio = two["lamp_sets"][1]["flux"] / one["lamp_sets"][0]["flux"]
        self.assertTrue(math.isclose(two["flux"] / one["flux"], ratio, rel_tol=1e-12))
        plain, flipped = (json.loads(self.shown("c_typeb.ies", "--json", *options))["planes"][1]["beam_angle"] for options in ((), ("--flip-h",)))
        self.assertTrue(math.isclose(plain["from"], -flipped["to"], abs_tol=1e-9))
        self.assertNotAlmostEqual(plain["from"], flipped["from"], 1)
        self.refused("luminaire", LUMINAIRES / "c_ldt_two_sets.ldt", "--set", "3", says=["3"])

    def test_json_of_every_file(self):
        """All keys are those of every file; figures of the table of oracles."""
        with open(LUMINAIRES / "oracles.tsv", newline="") as file:
            oracles = {pathlib.Path(row["file"]).name: row for row in csv.DictReader(file, delimiter="\t")}
        keys = None
        seen = 0
        for name, row in oracles.items():
            if not (LUMINAIRES / name).exists():
                continue
            seen += 1
            facts = json.loads(self.shown(name, "--json"))
            keys = keys or list(facts)
            self.assertEqual(list(facts), keys, name)
            self.assertTrue(math.isclose(facts["flux"], float(row["lumens"]), rel_tol=1e-6), name)
            self.assertTrue(math.isclose(facts["maximum"]["intensity"], float(row["max_cd"]), rel_tol=1e-6), name)
            front = float(row["lumens_front"]) / float(row["lumens"])
            self.assertTrue(math.isclose(facts["share_towards_aim"], front, abs_tol=1e-6), name)
            if facts["photometric_type"] == "C":
                self.assertTrue(math.isclose(sum(zone["flux"] for zone in facts["zones"]), facts["flux"], rel_tol=1e-9), name)
            for plane in facts["planes"]:
                beam = plane["beam_angle"]
                self.assertLessEqual(beam["width"], plane["field_angle"]["width"] + 1e-9, name)
                self.assertTrue(beam["from"] <= plane["maximum_at"] <= beam["to"] or beam["width"] in (0, 360), name)
        self.assertGreater(seen, 10)

    def test_picture(self):
        for name, images in (("c_lambert.ies", 0), ("c_skew.ies", 3), ("c_typeb.ies", 2)):
            picture = self.folder / (name + ".svg")
            self.shown(name, "-o", picture)
            root = xml.etree.ElementTree.parse(picture).getroot()
            self.assertEqual(root.tag, "{http://www.w3.org/2000/svg}svg")
            # Discs, and the colours of their scale.
            self.assertEqual(len(root.findall("{http://www.w3.org/2000/svg}image")), images, name)
        self.refused("luminaire", LUMINAIRES / "c_skew.ies", "-o", self.folder / "lamp.png", says=["lamp.png", ".svg"])
        self.refused("luminaire", LUMINAIRES / "c_skew.ies", "-o", self.folder / "no" / "lamp.svg", says=["does not exist"])

    def test_bad_files(self):
        for name, words in (("b_truncated.ies", ["b_truncated.ies", "234 candela values"]), ("b_ldt_isym7.ldt", [":3:", "symmetry 7"]),
                            ("none.ies", ["none.ies"])):
            self.refused("luminaire", LUMINAIRES / name, says=words)
        picture = self.folder / "bad.svg"
        self.refused("luminaire", LUMINAIRES / "b_nan.ies", "-o", picture, says=["nan"])
        self.assertFalse(picture.exists())
        self.assertEqual(lichtmc("luminaire").returncode, 2)

    def test_schedule_of_a_run(self):
        lamp = LUMINAIRES / "c_lambert.ies"
        out = self.folder / "out"
        room = self.folder / "room.glb"
        self.assertEqual(lichtmc("cuboid", "--size", 4, 3, 4, "--light", "point:1,1,1:10lm", "-o", room).returncode, 0)
        lights = [option for x in (1, 3) for option in ("--light", f"ies:{lamp}:{x},2.9,2")] + ["--light", f"ies:{lamp}:2,2.9,1:lm=500"]
        done = lichtmc("run", room, *lights, "-o", out, "--photons", "20k", "--tile", "0.5", "--quiet")
        self.assertEqual(done.returncode, 0, done.stderr)
        with open(out / "emitters.csv", newline="") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual([row["kind"] for row in rows], ["isotropic", "measured", "measured", "measured"])
        self.assertEqual([row["watts"] for row in rows], ["", "50", "50", "50"])
        self.assertEqual(float(rows[3]["power"]), 500)
        summary = json.loads((out / "summary.json").read_text())
        self.assertEqual([entry["count"] for entry in summary["luminaires"]], [2, 1])
        self.assertEqual(summary["luminaires"][0]["total_watts"], 100)
        page = (out / "report.html").read_text()
        self.assertEqual(page.count('class="diagram"'), 1)
        self.assertTrue((out / "pictures" / "luminaire_1.svg").exists())


if __name__ == "__main__":
    unittest.main()
