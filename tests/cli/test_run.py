"""lichtmc run and cuboid: files, messages and exit status."""
import csv
import hashlib
import json
import math
import os
import pathlib
import signal
import subprocess
import time
import unittest

from support import PROGRAM, SCENES, ProgramTest, lichtmc

CUBE = SCENES / "cube_paper.gltf"

SUMMARY_KEYS = ("version room unit engine estimator seed threads histories impacts rays seconds impacts_per_second emitted absorbed escaped residual "
                "lost incident incident_standard_error rms_relative_error figure_of_merit stopped_by surfaces receivers ignored").split()
TILE_COLUMNS = "tile,surface,column,row,x,y,z,area,power,irradiance,standard_error,hits".split(",")


def digest(path):
    return hashlib.sha256(path.read_bytes()).hexdigest()


class Run(ProgramTest):
    def run_room(self, *options, room=CUBE):
        out = self.folder / "out"
        done = lichtmc("run", room, "-o", out, "--no-report", *options)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(done.stdout, "")
        with open(out / "tiles.csv", newline="") as file:
            tiles = list(csv.DictReader(file))
        return out, json.loads((out / "summary.json").read_text()), tiles, done.stderr

    def test_files_and_columns(self):
        out, summary, tiles, said = self.run_room("--photons", "100k", "--seed", "5", "--threads", "2")
        for key in SUMMARY_KEYS:
            self.assertIn(key, summary)
        self.assertEqual(list(tiles[0])[:12], TILE_COLUMNS)
        self.assertEqual(len(tiles), 600)
        self.assertEqual([int(t["tile"]) for t in tiles], list(range(600)))
        self.assertEqual(summary["unit"], "W")
        self.assertEqual(summary["histories"], 100000)
        self.assertEqual(summary["seed"], 5)
        self.assertEqual(summary["engine"], "cuboid")
        self.assertEqual(summary["stopped_by"], "photons")
        self.assertEqual(sorted(p.name for p in out.iterdir()), ["emitters.csv", "state.h5", "summary.json", "surfaces.csv", "tiles", "tiles.csv"])
        self.assertEqual(len(list((out / "tiles").glob("*.exr"))), 6)
        # Sums of 600 rounded numbers.
        self.assertTrue(math.isclose(sum(float(t["power"]) for t in tiles), summary["incident"], rel_tol=1e-12))
        self.assertTrue(math.isclose(sum(float(t["area"]) for t in tiles), 6.0, rel_tol=1e-12))
        balance = sum(summary[k] for k in ("absorbed", "escaped", "residual", "lost"))
        self.assertTrue(math.isclose(balance, summary["emitted"], rel_tol=1e-12))
        for tile in tiles:
            self.assertTrue(math.isclose(float(tile["power"]), float(tile["irradiance"]) * float(tile["area"]), rel_tol=1e-12))
        self.assertIn("100k photons", said)
        self.assertIn(str(out), said)

    def test_report(self):
        out = self.folder / "out"
        command = ["run", CUBE, "-o", out, "--photons", "20k", "--paths", "7", "--pictures", "exr", "--scale-max", "2.5", "--colormap", "inferno"]
        done = lichtmc(*command)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn(str(out / "report.html"), done.stderr)
        page = (out / "report.html").read_text()
        self.assertIn(f"lichtmc run {CUBE} -o {out} --photons 20k --paths 7", page)
        self.assertIn("7 photon paths", page)
        self.assertIn('data-high="2.5"', page)
        self.assertIn('data-colours="inferno"', page)
        self.assertEqual((out / "room_lit.glb").read_bytes()[:4], b"glTF")
        pictures = {p.name for p in (out / "pictures").iterdir()}
        self.assertLessEqual({"room.svg", "room.png", "room.exr", "above.svg", "floor.svg", "paths.svg"}, pictures)
        # A run without a report removes the report of the earlier run.
        self.assertEqual(lichtmc("run", CUBE, "-o", out, "--photons", "20k", "--no-report").returncode, 0)
        self.assertFalse((out / "report.html").exists())
        self.assertEqual(list((out / "pictures").iterdir()), [])

    def test_lighting_report(self):
        out = self.folder / "out"
        words = ["--project", "School <A>", "--author", "Jane Doe", "--date", "1 May"]
        done = lichtmc("run", CUBE, "-o", out, "--photons", "20k", "--report-style", "lighting", *words)
        self.assertEqual(done.returncode, 0, done.stderr)
        first, technical = (out / "report.html").read_text().split("Technical details", 1)
        for text in ("<dd>School &lt;A&gt;</dd>", "<dd>Jane Doe</dd>", "<dd>1 May</dd>", "<dd>cube_paper.gltf</dd>"):
            self.assertIn(text, first)
        self.assertIn("Balance of the power", technical)
        # resume takes them as the run gave them, and as it is told otherwise.
        done = lichtmc("resume", out, "--photons", "30k", "--date", "2 May")
        self.assertEqual(done.returncode, 0, done.stderr)
        page = (out / "report.html").read_text()
        for text in ("<dd>Jane Doe</dd>", "<dd>2 May</dd>"):
            self.assertIn(text, page)
        done = lichtmc("resume", out, "--photons", "40k", "--report-style", "technical")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertNotIn("Technical details", (out / "report.html").read_text())

    def test_report_of_areas_alone(self):
        out = self.folder / "out"
        room = pathlib.Path(__file__).parent.parent / "data" / "office.glb"
        done = lichtmc("run", room, "-o", out, "--plane", "0.75:0.5:spacing=0.5:target_lx=1e6", "--only", "receivers", "--photons", "20k")
        self.assertEqual(done.returncode, 0, done.stderr)
        first, technical = (out / "report.html").read_text().split("Technical details", 1)
        for text in ('id="areas"', "✗ fail", "Fails: plane.", 'class="area-plan"', 'id="picture-room"', "<polygon"):
            self.assertIn(text, first)
        self.assertIn('id="area-details"', technical)
        self.assertNotIn("gain, dB", first + technical)
        self.assertEqual({p.name for p in (out / "pictures").iterdir()}, {"room.svg", "room.png", "above.svg", "above.png"})
        self.assertFalse((out / "room_lit.glb").exists())

    def test_report_options_are_checked(self):
        out = self.folder / "out"
        for options, says in ((["--scale-max", "0"], "number above 0"), (["--scale-type", "even"], "auto, linear, log"),
                              (["--colormap", "jet"], "viridis, inferno"), (["--pictures", "bmp"], "exr"),
                              (["--paths", "20000"], "10000"), (["--no-report", "--paths", "5"], "--no-report"),
                              (["--report-style", "pretty"], "lighting, technical"), (["--no-report", "--author", "A. B."], "--author requires"),
                              (["--no-report", "--report-style", "lighting"], "--report-style requires")):
            self.refused("run", CUBE, "-o", out, *options, says=[says])
        self.assertFalse(out.exists())

    def test_paths(self):
        out = self.folder / "paths"
        done = lichtmc("paths", CUBE, "-o", out, "--photons", "20", "--seed", "3")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(sorted(p.name for p in out.iterdir()), ["paths.csv", "paths.glb", "paths.svg"])
        with open(out / "paths.csv", newline="") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual(list(rows[0]), "photon,flight,x,y,z,surface,weight,event".split(","))
        self.assertEqual(sum(row["event"] == "emitted" for row in rows), 20)
        self.assertEqual(sum(row["event"] == "absorbed" for row in rows), 20)
        self.assertEqual({row["photon"] for row in rows}, {str(k) for k in range(20)})
        self.refused("paths", CUBE, "-o", out, "--photons", "20k", says=["10000"])

    def test_receivers_of_a_table_and_a_grid(self):
        table = self.folder / "points.csv"
        table.write_text("x,y,z,nx,ny,nz,name\n# desk\n0.5,0.2,0.5,0,1,0,\"desk, left\"\n\n0.1,0.5,0.5,1,0,0,\n")
        out, summary, tiles, said = self.run_room("--receivers", table, "--grid", "0.1", "--grid-spacing", "0.25", "--photons", "50k")
        with open(out / "receivers.csv", newline="") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual(list(rows[0])[:13], "receiver,name,x,y,z,nx,ny,nz,irradiance,direct,indirect,standard_error,gain".split(","))
        self.assertEqual([r["name"] for r in rows[:3]], ["desk, left", "receiver_1", "grid_0_0"])
        self.assertEqual(len(rows), 2 + 16)
        self.assertIn("Note: 16 receivers of the grid 0.1 m above the floor at y = 0 m.", said)
        self.assertEqual(len(summary["receivers"]), 18)
        for row, one in zip(rows, summary["receivers"]):
            self.assertEqual(float(row["irradiance"]), one["irradiance"])
            self.assertTrue(math.isclose(float(row["direct"]) + float(row["indirect"]), float(row["irradiance"]), rel_tol=1e-12))
            self.assertGreater(float(row["standard_error"]), 0)
            self.assertTrue(math.isclose(10 * math.log10(float(row["gain"])), float(row["gain_db"]), rel_tol=1e-12))
        self.assertEqual(summary["backward"]["shadow_rays"], 0)  # a cuboid casts no shadow
        self.assertEqual(len(tiles), 600)
        self.assertIn("18 receivers", said)

    def test_the_aliases_of_only(self):
        measured = {}
        for value in ("tiles", "forward", "receivers", "backward"):
            out = self.folder / value
            done = lichtmc("run", CUBE, "-o", out, "--photons", "2k", "--grid", "0.5", "--only", value, "--no-report")
            self.assertEqual(done.returncode, 0, done.stderr)
            measured[value] = (sorted(p.name for p in out.iterdir()), [p.read_bytes() for p in sorted(out.glob("*.csv"))])
        self.assertEqual(measured["forward"], measured["tiles"])
        self.assertEqual(measured["backward"], measured["receivers"])
        self.assertNotEqual(measured["tiles"], measured["receivers"])

    def test_only_tiles_or_receivers(self):
        done = lichtmc("run", CUBE, "-o", self.folder / "out", "--photons", "10k", "--grid", "0.5", "--only", "receivers", "--no-report")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(sorted(p.name for p in (self.folder / "out").iterdir()), ["emitters.csv", "receivers.csv", "state.h5", "summary.json"])
        out, summary, _, _ = self.run_room("--photons", "10k", "--grid", "0.5", "--only", "tiles")
        self.assertFalse((out / "receivers.csv").exists())  # that of the run before is removed
        self.assertIsNone(summary["backward"])
        self.assertIn("only tiles were requested", " ".join(summary["ignored"]))
        table = self.folder / "wrong.csv"
        table.write_text("0,0,0,0,1,0\n1,2,x,0,1,0\n")
        self.refused("run", CUBE, "-o", out, "--receivers", table, says=["row 2", "'x'"])
        table.write_text("0.5,0.2,0.5,0,0,0\n")
        self.refused("run", CUBE, "-o", out, "--receivers", table, says=["row 1", "0,0,0"])
        table.write_text("0.5,0.5,0.5,0,1,0\n")
        self.refused("run", CUBE, "-o", out, "--receivers", table, says=["receiver_0", "on the emitter"])
        self.refused("run", CUBE, "-o", out, "--only", "sideways", says=["sideways", "tiles, receivers"])
        self.refused("run", CUBE, "-o", out, "--grid-spacing", "1", says=["without --grid"])
        self.refused("run", CUBE, "-o", out, "--only", "receivers", says=["no receiver"])

    def test_identical_results_for_any_number_of_threads(self):
        files = []
        for threads in (1, 2, 7):
            out, _, _, _ = self.run_room("--photons", "50001", "--threads", threads)
            files.append(digest(out / "tiles.csv"))
        self.assertEqual(len(set(files)), 1)
        out, _, _, _ = self.run_room("--photons", "50001", "--seed", "2")
        self.assertNotEqual(digest(out / "tiles.csv"), files[0])

    def test_estimator_numbers_are_aliases(self):
        for number, name in ("1", "weight"), ("2", "collision"), ("3", "absorption"):
            _, summary, _, _ = self.run_room("--photons", "2000", "--estimator", number)
            self.assertEqual(summary["estimator"], name)

    def test_forms_of_counts(self):
        for text, count in ("2000", 2000), ("2e3", 2000), ("2k", 2000), ("1.005k", 1005), ("0.003M", 3000):
            _, summary, _, _ = self.run_room("--photons", text)
            self.assertEqual(summary["histories"], count)

    def test_target_error_and_the_photons_it_requires(self):
        _, summary, _, _ = self.run_room("--target-error", "10%", "--tile", "0.25")
        self.assertEqual(summary["stopped_by"], "target-error")
        self.assertLessEqual(summary["rms_relative_error"], 0.10)
        _, summary, _, said = self.run_room("--target-error", "0.001%", "--photons", "10000")
        self.assertEqual(summary["stopped_by"], "photons")
        self.assertIn("was not reached", said)

    def test_max_time(self):
        _, summary, _, _ = self.run_room("--photons", "1T", "--max-time", "0.5s")
        self.assertEqual(summary["stopped_by"], "max-time")

    def test_input_overrides_are_listed(self):
        room = self.folder / "dark.glb"
        self.assertEqual(lichtmc("cuboid", "--size", 2, 2, 2, "-o", room).returncode, 0)
        _, summary, _, _ = self.run_room("--photons", "2000", "--light", "point:1,1,1:500lm", "--light", "lambert:1,1.9,1:0,-1,0:3:100lm",
                                         "--max-reflectance", "0.4", room=room)
        self.assertEqual(summary["emitted"], 600)
        self.assertEqual(summary["unit"], "lm")
        self.assertEqual(len(summary["mended"]), 3)

    def test_with_a_target_error_alone_the_number_of_photons_has_no_limit(self):
        _, summary, _, _ = self.run_room("--target-error", "1.2%")
        self.assertEqual(summary["stopped_by"], "target-error")
        self.assertGreater(summary["histories"], 1_000_000)

    def test_warnings(self):
        _, summary, _, said = self.run_room("--photons", "2000", "--light", "point:5,.5,.5:1W", "--reflectance", "wall=1",
                                            "--estimator", "weight", "--max-bounces", "3")
        self.assertEqual(len(summary["warnings"]), 5)  # two of the run, three of the check
        for words in "outside the room", "cut off as residual", "more than 95 %":
            self.assertIn(words, said)
        _, summary, _, said = self.run_room("--photons", "2000")
        self.assertEqual(summary["warnings"], [])
        self.assertNotIn("Warning", said)

    def test_the_warnings_of_check_are_repeated(self):
        room = self.folder / "inches.glb"
        self.assertEqual(lichtmc("cuboid", "--size", 197, 102, 157, "--walls", "0.97", "--light", "point:98,80,78:2e7lm", "-o", room).returncode, 0)
        out = self.folder / "out"
        for quiet in ([], ["--quiet"]):
            done = lichtmc("run", room, "-o", out, "--photons", "2000", "--tile", "20", "--no-report", *quiet)
            self.assertEqual(done.returncode, 0, done.stderr)
            warnings = [line for line in done.stderr.splitlines() if line.startswith("Warning: ")]
            self.assertEqual(len(warnings), 2, done.stderr)
            self.assertIn("--scale 0.0254", warnings[0])
            self.assertIn("more than 95 %", warnings[1])
            summary = json.loads((out / "summary.json").read_text())
            self.assertEqual(["Warning: " + warning for warning in summary["warnings"]], warnings)

    def test_quiet(self):
        done = lichtmc("run", CUBE, "-o", self.folder / "out", "--photons", "2000", "--quiet", "--no-report")
        self.assertEqual((done.stdout, done.stderr), ("", ""))

    def test_default_output_folder(self):
        self.assertEqual(lichtmc("run", CUBE, "--photons", "2000", "--no-report", cwd=self.folder).returncode, 0)
        self.assertTrue((self.folder / "cube_paper.out" / "summary.json").exists())

    def test_an_interrupt_keeps_the_results(self):
        for number in (signal.SIGINT, signal.SIGTERM):
            out = self.folder / f"out{number}"
            program = subprocess.Popen([PROGRAM, "run", str(CUBE), "-o", str(out), "--photons", "1T"], stderr=subprocess.PIPE, text=True)
            time.sleep(1.0)
            program.send_signal(number)
            _, said = program.communicate(timeout=20)
            self.assertEqual(program.returncode, 0, said)
            summary = json.loads((out / "summary.json").read_text())
            self.assertEqual(summary["stopped_by"], "interrupt")
            self.assertGreater(summary["histories"], 0)
            self.assertLess(summary["histories"], 10**12)
            self.assertIn("interrupted", said)

    def test_a_second_run_replaces_the_first(self):
        self.run_room("--photons", "2000", room=SCENES / "l_room.gltf")
        out, summary, tiles, _ = self.run_room("--photons", "2000")
        self.assertEqual(len(list((out / "tiles").glob("*.exr"))), 6)
        self.assertEqual(len(tiles), 600)
        self.assertEqual([p.name for p in out.rglob("*") if "tmp" in p.name], [])

    def test_a_written_cuboid_is_recognised_as_a_cuboid(self):
        for name in "room.glb", "room.gltf":
            room = self.folder / name
            done = lichtmc("cuboid", "--size", 5, 2.6, 4, "--walls", 0.6, "--ceiling", 0.8, "--floor", 0.3, "--light", "point:2.5,2.4,2:2000lm", "-o", room)
            self.assertEqual((done.returncode, done.stdout), (0, ""), done.stderr)
            _, summary, _, _ = self.run_room("--photons", "2000", room=room)
            self.assertEqual(summary["engine"], "cuboid")
            self.assertEqual(summary["unit"], "lm")
            reflectances = {s["name"]: s["reflectance"] for s in summary["surfaces"]}
            self.assertEqual(reflectances["ceiling"], 0.8)
            self.assertEqual(reflectances["wall_z1"], 0.6)


class Help(ProgramTest):
    def test_every_command_has_a_help_text(self):
        top = lichtmc("--help")
        self.assertEqual(top.returncode, 0)
        for command in "run", "cuboid":
            self.assertIn(command, top.stdout)
            done = lichtmc(command, "--help")
            self.assertEqual(done.returncode, 0)
            self.assertIn("Example", done.stdout)
            self.assertEqual(done.stderr, "")
        for option in ("--photons --estimator --target-error --max-time --max-bounces --tile --seed --threads --engine --unit --light "
                       "--max-reflectance --reflectance --output --quiet").split():
            self.assertIn(option, lichtmc("run", "--help").stdout)

    def test_version(self):
        self.assertRegex(lichtmc("--version").stdout, r"^lichtmc \d+\.\d+\.\d+\n$")


if __name__ == "__main__":
    unittest.main(verbosity=2)
