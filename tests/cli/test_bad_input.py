"""Bad input gives exit status 2 and one message that names the file and the item in it, and says what to do."""
import math
import os
import resource
import subprocess
import unittest

from support import PROGRAM, SCENES, ProgramTest, lichtmc, triangle_room

CUBE = SCENES / "cube_paper.gltf"


class BadFiles(ProgramTest):
    def run_refused(self, document, *says):
        path = self.write_gltf(document)
        message = self.refused("run", path, "-o", self.folder / "out", says=[str(path), *says])
        self.assertFalse((self.folder / "out" / "summary.json").exists())
        return message

    def test_missing_file(self):
        self.refused("run", self.folder / "none.glb", says=["none.glb"])

    def test_folder_in_place_of_a_file(self):
        self.refused("run", self.folder, says=[str(self.folder)])

    def test_pipes_and_devices_are_refused_at_once(self):
        pipe = self.folder / "pipe.glb"
        os.mkfifo(pipe)
        self.refused("check", pipe, says=["it is a pipe", "allowed: a regular file"])
        self.refused("run", "/dev/zero", says=["/dev/zero", "it is a device"])
        room = self.write_gltf(triangle_room())
        self.refused("run", room, "--receivers", "/dev/zero", says=["/dev/zero", "device"])
        self.refused("resume", pipe, says=["pipe.glb", "it is no state of lichtmc, but a folder, pipe or device"])

    def test_files_outside_the_folder_of_the_room(self):
        document = triangle_room()
        document["buffers"][0]["uri"] = "../../../../../../etc/passwd"
        self.refused("check", self.write_gltf(document), says=["'../../../../../../etc/passwd' of buffer 0", "leads out of the folder"])

    def test_memory_that_is_not_sufficient(self):
        """The message is lichtmc's own, not that of a library."""
        document = triangle_room()
        document["padding"] = [[0] * 10] * 1_000_000
        room = self.write_gltf(document)
        limit = 200 << 20
        done = subprocess.run([PROGRAM, "check", room], capture_output=True, text=True, timeout=60, check=False,
                              preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS, (limit, limit)))
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertIn("The memory was not sufficient.", done.stderr)
        self.assertNotIn("std::", done.stderr)

    def test_without_and_reflectance_of_names_that_do_not_exist(self):
        room = self.write_gltf(triangle_room())
        self.refused("check", room, "--without", "flor", says=["'flor' of --without", "'floor'"])
        self.refused("check", room, "--reflectance", "pant=0.5", says=["no material or surface 'pant'", "'paint'"])
        self.refused("check", room, "--without", "floor", says=["no triangle with an area"])

    def test_truncated_file(self):
        whole = (SCENES / "living_room.glb").read_bytes()
        for size in (0, 3, 12, 19, 25, len(whole) // 2, len(whole) - 1):
            path = self.folder / "cut.glb"
            path.write_bytes(whole[:size])
            self.refused("run", path, "-o", self.folder / "out", says=["cut.glb"])

    def test_no_triangles(self):
        document = triangle_room()
        del document["nodes"][0]["mesh"]
        self.run_refused(document, "triangle")

    def test_only_triangles_without_area(self):
        self.run_refused(triangle_room([(0, 0, 0), (0, 0, 0), (1, 0, 0)]), "triangle")

    def test_no_emitter(self):
        document = triangle_room()
        del document["nodes"][1]["extensions"]
        self.run_refused(document, "emitter", "--light")

    def test_reflectance_out_of_range(self):
        for value in (-0.1, 1.5, "white"):
            self.run_refused(triangle_room(reflectance=value), "paint", "reflectance")

    def test_negative_exponent(self):
        document = triangle_room()
        document["nodes"][1]["extras"] = {"lambert_exponent": -1}
        self.run_refused(document, "lamp", "-1", "lambert_exponent")

    def test_negative_power(self):
        document = triangle_room()
        document["nodes"][1]["extras"] = {"power": -5}
        self.run_refused(document, "lamp", "-5", "power")

    def test_position_that_is_not_finite(self):
        for value in (math.nan, math.inf):
            self.run_refused(triangle_room([(0, 0, 0), (0, value, 1), (1, 0, 0)]), "triangle")

    def test_unknown_required_extension(self):
        document = triangle_room()
        document["extensionsUsed"].append("EXT_of_the_future")
        document["extensionsRequired"] = ["EXT_of_the_future"]
        self.run_refused(document, "EXT_of_the_future")

    def test_mixed_units(self):
        document = triangle_room()
        document["nodes"].append({"name": "laser", "extras": {"lambert_exponent": 100, "power": 1, "unit": "W"}})
        document["scenes"][0]["nodes"].append(2)
        self.run_refused(document, "laser", "lamp", "W", "lm")

    def test_nothing_absorbs_in_a_closed_room(self):
        path = self.folder / "mirror.glb"
        self.assertEqual(lichtmc("cuboid", "--size", 1, 1, 1, "--reflectance", 1, "--light", "point:.5,.5,.5:1lm", "-o", path).returncode, 0)
        self.refused("run", path, "-o", self.folder / "out", says=["mirror.glb", "absorbs", "reflectance"])

    def test_nothing_absorbs_but_max_bounces_ends_the_histories(self):
        path = self.folder / "mirror.glb"
        lichtmc("cuboid", "--size", 1, 1, 1, "--reflectance", 1, "--light", "point:.5,.5,.5:1lm", "-o", path)
        done = lichtmc("run", path, "-o", self.folder / "out", "--estimator", "weight", "--max-bounces", 5, "--photons", 5000, "--no-report")
        self.assertEqual(done.returncode, 0, done.stderr)

    def test_absorption_with_reflectance_one(self):
        message = self.refused("run", CUBE, "--estimator", "absorption", "--reflectance", "wall=1", "-o", self.folder / "out",
                               says=["absorption", "wall"])
        self.assertIn("collision", message)


class BadOptions(ProgramTest):
    def test_values_out_of_range(self):
        for options, says in (
            (["--photons", "0"], ["--photons"]),
            (["--photons", "-5"], ["--photons"]),
            (["--photons", "1.5"], ["--photons"]),
            (["--photons", "many"], ["--photons", "many"]),
            (["--tile", "-1"], ["-1", "--tile"]),
            (["--tile", "0"], ["--tile"]),
            (["--tile", "nan"], ["--tile"]),
            (["--tile", "1e-7"], ["--tile"]),
            (["--target-error", "0"], ["--target-error"]),
            (["--target-error", "3"], ["--target-error", "3%"]),
            (["--seed", "-1"], ["--seed"]),
            (["--seed", "99999999999999999999"], ["--seed"]),
            (["--max-time", "-1s"], ["--max-time"]),
            (["--max-bounces", "0", "--estimator", "weight"], ["--max-bounces"]),
            (["--max-bounces", "5", "--estimator", "collision"], ["--max-bounces", "weight"]),
            (["--error-floor", "-1%"], ["--error-floor", "1lx"]),
            (["--error-floor", "3"], ["--error-floor", "1%"]),
            (["--error-floor", "1lx"], ["--error-floor", "W/m^2"]),
            (["--direct-error", "0"], ["--direct-error"]),
            (["--measure", "wal"], ["wal", "wall"]),
            (["--estimator", "guess"], ["--estimator", "guess", "collision"]),
            (["--engine", "warp"], ["--engine", "warp"]),
            (["--unit", "cd"], ["--unit"]),
            (["--threads", "0"], ["--threads"]),
            (["--reflectance", "wall"], ["--reflectance"]),
            (["--reflectance", "wal=0.5"], ["wal", "wall"]),
            (["--reflectance", "wall=2"], ["wall", "2"]),
            (["--max-reflectance", "1.1"], ["1.1"]),
            (["--light", "point:1,2:5lm"], ["--light", "1,2"]),
            (["--light", "point:.5,.5,.5:5"], ["--light", "unit"]),
            (["--light", "torch:.5,.5,.5:5W"], ["torch", "point"]),
            (["--light", "point:.5,.5,.5:5lm"], ["lm", "W"]),
            (["--scene", "attic"], ["attic"]),
            (["--nonsense"], ["--nonsense"]),
        ):
            with self.subTest(options=options):
                self.refused("run", CUBE, "-o", self.folder / "out", *options, says=says)
                self.assertFalse((self.folder / "out" / "summary.json").exists())

    def test_cuboid_values(self):
        out = self.folder / "room.glb"
        for options, says in (
            (["--size", "1", "0", "1"], ["0"]),
            (["--size", "1", "1"], ["--size"]),
            (["--size", "1", "1", "nan"], ["--size"]),
            (["--size", "1", "1", "1", "--floor", "1.2"], ["1.2"]),
            (["--size", "1", "1", "1", "--light", "lambert:.5,.5,.5:0,0,0:1:1W"], ["0"]),
            (["--size", "1", "1", "1", "--light", "lambert:.5,.5,.5:0,-1,0:-2:1W"], ["-2"]),
        ):
            with self.subTest(options=options):
                self.refused("cuboid", *options, "-o", out, says=says)
                self.assertFalse(out.exists())
        self.refused("cuboid", "--size", "1", "1", "1", "-o", self.folder / "room.obj", says=["room.obj", ".glb"])

    def test_tiles_beyond_the_memory(self):
        message = self.refused("run", CUBE, "--tile", "1e-5", "-o", self.folder / "out", says=["--tile", "memory"])
        self.assertIn("metres", message)

    def test_cuboid_into_a_folder_that_does_not_exist(self):
        self.refused("cuboid", "--size", "1", "1", "1", "-o", self.folder / "none" / "room.glb", says=["none", "--output"])

    def test_engine_that_cannot_serve_the_room(self):
        self.refused("run", SCENES / "l_room.gltf", "--engine", "cuboid", "-o", self.folder / "out", says=["cuboid", "embree"])

    def test_no_command(self):
        self.refused(says=["--help"])
        self.refused("walk", says=["walk", "run", "cuboid", "--help"])

    def test_output_folder_that_cannot_be_written(self):
        (self.folder / "file").write_text("")
        self.refused("run", CUBE, "-o", self.folder / "file" / "out", says=["file/out", "--output"])
        self.refused("run", CUBE, "-o", self.folder / "file", says=["file", "--output"])

    @unittest.skipIf(os.geteuid() == 0, "root may write everywhere")
    def test_output_folder_without_permission(self):
        locked = self.folder / "locked"
        locked.mkdir(mode=0o555)
        self.refused("run", CUBE, "-o", locked, says=["locked", "--output"])


if __name__ == "__main__":
    unittest.main(verbosity=2)
