"""Luminaires with photometric files: --light ies:FILE, and files that glTF rooms name."""
import csv
import json
import pathlib
import shutil
import unittest

from support import ProgramTest, lichtmc

DATA = pathlib.Path(__file__).parent.parent / "data" / "luminaires"
SKEW = DATA / "c_skew.ies"
POINTS = [(0, 0), (2, 0), (0, -2), (-2, 0), (0, 2), (1.5, -1), (-1, -2.5), (-2, 1.5), (3, 2)]


class Luminaires(ProgramTest):
    def receivers(self):
        table = self.folder / "points.csv"
        table.write_text("x,y,z,nx,ny,nz\n" + "".join(f"{x},0,{z},0,1,0\n" for x, z in POINTS))
        return table

    def direct(self, room, *options):
        """Direct light at the nine points."""
        out = self.folder / "out"
        done = lichtmc("run", room, "-o", out, "--receivers", self.receivers(), "--only", "receivers", "--histories", "0:1024",
                       "--no-report", *options)
        self.assertEqual(done.returncode, 0, done.stderr)
        with open(out / "receivers.csv", encoding="utf-8") as file:
            return [float(row["direct"]) for row in csv.DictReader(file)], done.stderr

    def check_row(self, found, row):
        for value, key in zip(found, [key for key in row if key.startswith("E_lx")]):
            self.assertAlmostEqual(value / float(row[key]), 1, delta=1e-6)

    def poses(self):
        with open(DATA / "illuminance.tsv", encoding="utf-8") as file:
            return list(csv.DictReader(file, delimiter="\t"))

    def cuboid(self, *lights, status=0):
        room = self.folder / "room.glb"
        done = lichtmc("cuboid", "--size", 5, 3, 4, *(part for light in lights for part in ("--light", light)), "-o", room)
        self.assertEqual(done.returncode, status, done.stderr)
        return room

    def test_rooms_of_other_programs_have_the_illuminances_of_the_table(self):
        row = self.poses()[0]
        for sample in ("ext_uri", "ext_datauri", "extras_ies"):
            found, messages = self.direct(DATA / "gltf" / f"{sample}.gltf")
            self.check_row(found, row)
            self.assertIn("0.6 m long towards C0 and 0.3 m towards C90: C0 lies along its longer side", messages)

    def test_lights_of_the_command_line_have_the_illuminances_of_the_table(self):
        for row in self.poses():
            light = f"ies:{DATA / row['file']}:0,3,0:{row['nadir']}:{row['rotation_deg']}"
            found, _ = self.direct(DATA / "gltf" / "ext_uri.gltf", "--without", "luminaire", "--light", light)
            self.check_row(found, row)

    def test_a_written_room_has_the_same_luminaires(self):
        room = self.cuboid(f"ies:{SKEW}:2.5,2.9,2:area", f"ies:{SKEW}:1,2.9,1:0.2,-1,0:30:x=0.5",
                           f"ies:{DATA / 'c_ldt_comma.ldt'}:4,2.9,2:set=1:lm=1500")
        facts = json.loads(lichtmc("check", room, "--json").stdout)
        self.assertEqual([one["name"] for one in facts["emitters"]], ["c_skew", "c_skew_2", "c_ldt_comma"])
        powers = [one["power"] for one in facts["emitters"]]
        self.assertAlmostEqual(powers[1] / powers[0], 0.5, delta=1e-12)
        self.assertEqual(powers[2], 1500)
        self.assertEqual([(one["count"], one["as_points"]) for one in facts["luminaires"]], [(2, 1), (1, 1)])
        text = lichtmc("check", room).stdout
        self.assertIn("c_skew: 2774 lm, c_skew.ies, input 50 W", text)
        self.assertNotIn("not known", text)
        self.assertIn("The luminaire with the photometric file 'c_skew.ies' is taken for a point", text)
        _, messages = self.direct(room)
        self.assertIn("is taken for a point", messages)
        self.assertIn(":area", messages)
        outside = self.folder / "elsewhere"
        outside.mkdir()
        shutil.move(room, outside / "room.glb")
        self.assertEqual(lichtmc("check", outside / "room.glb").returncode, 0)

    def test_watts_make_a_radiometric_room(self):
        facts = json.loads(lichtmc("check", self.cuboid(f"ies:{SKEW}:2.5,2.5,2:W=0.25"), "--json").stdout)
        self.assertEqual((facts["unit"], facts["emitters"][0]["power"]), ("W", 0.25))
        self.refused("cuboid", "--size", 5, 3, 4, "--light", f"ies:{SKEW}:2.5,2.5,2:W=1", "--light", f"ies:{SKEW}:2,2,2", "-o",
                     self.folder / "x.glb", says=["is in lm, the emitters", "are in W"])

    def test_lights_that_cannot_be_used(self):
        for light, says in (
            ("ies:", "it has no position"),
            ("ies::1,2,3", "it names no file"),
            (f"ies:{SKEW}", "it has no position"),
            (f"ies:{SKEW}:C:1,2,3", "'C' is not a position"),
            (f"ies:{SKEW}:1,2", "three numbers"),
            (f"ies:{SKEW}:1,2,1:0,0,0", "The aim of the luminaire is (0, 0, 0)"),
            (f"ies:{SKEW}:1,2,1:30", "three numbers"),
            (f"ies:{SKEW}:1,2,1:lm=5:30", "'30' is not known there"),
            (f"ies:{SKEW}:1,2,1:watts=5", "'watts=5' is not known there"),
            (f"ies:{SKEW}:1,2,1:area:area", "'area' is given twice"),
            (f"ies:{SKEW}:1,2,1:lm=5:x=2", "more than one number scales"),
            (f"ies:{SKEW}:1,2,1:lm=0", "its luminous flux is 0 lm (allowed: a finite number above 0)"),
            (f"ies:{SKEW}:1,2,1:set=0", "set"),
            ("ies:nowhere.ies:1,2,1", "nowhere.ies"),
            (f"ies:{DATA / 'b_type4.ies'}:1,2,1", "b_type4.ies:"),
            (f"ies:{DATA / 'b_ldt_flux0.ldt'}:1,2,1", "lm="),
        ):
            with self.subTest(light):
                self.refused("cuboid", "--size", 3, 3, 3, "--light", light, "-o", self.folder / "x.glb", says=[says])
        # With its flux, a EULUMDAT file without one is accepted.
        self.cuboid(f"ies:{DATA / 'b_ldt_flux0.ldt'}:1,2,1:lm=500")

    def test_rooms_whose_luminaire_cannot_be_read(self):
        for sample, says in (
            ("bad_both", "has both uri and bufferView"),
            ("bad_escape", "it leads out of the folder"),
            ("bad_index", "EXT_lights_ies light 3, but there is 1 profile"),
            ("bad_missing_file", "'nowhere.ies'"),
            ("bad_multiplier", "multiplier -1"),
            ("bad_no_mime", "bufferView without mimeType"),
        ):
            self.refused("check", DATA / "gltf" / f"{sample}.gltf", says=[says, f"{sample}.gltf"])


if __name__ == "__main__":
    unittest.main()
