"""lichtmc resume and merge: a run in parts gives the results of one run, and states that do not match are refused."""
import json
import os
import shutil
import unittest

from support import SCENES, ProgramTest, lichtmc

ROOM = SCENES / "living_room.glb"  # has a receiver
TABLES = ("tiles.csv", "surfaces.csv", "receivers.csv")


class LongRuns(ProgramTest):
    def run_to(self, name, *options, room=ROOM):
        folder = self.folder / name
        done = lichtmc("run", room, "-o", folder, "--tile", "0.5", "--no-report", *options)
        self.assertEqual(done.returncode, 0, done.stderr)
        return folder

    def succeeds(self, *arguments):
        done = lichtmc(*arguments)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(done.stdout, "")
        return done.stderr

    def assert_same(self, a, b):
        for table in TABLES:
            self.assertEqual((a / table).read_bytes(), (b / table).read_bytes(), table)

    def test_resume_gives_the_results_of_one_run(self):
        whole = self.run_to("whole", "--photons", "200001")
        part = self.run_to("part", "--photons", "50k")
        self.assertNotEqual((whole / "tiles.csv").read_bytes(), (part / "tiles.csv").read_bytes())
        said = self.succeeds("resume", part, "--photons", "200001")
        self.assertIn("200k photons", said)
        self.assert_same(whole, part)
        # If the rules are met, nothing is simulated, and the results are those of the state.
        elsewhere = self.folder / "elsewhere"
        self.succeeds("resume", part / "state.h5", "-o", elsewhere)
        self.assert_same(whole, elsewhere)
        summary = json.loads((elsewhere / "summary.json").read_text())
        self.assertEqual(summary["histories"], 200001)

    def test_resume_keeps_the_options_of_the_run(self):
        options = ["--estimator", "weight", "--seed", "9", "--light", "point:2,2,2:500lm", "--max-reflectance", "0.7", "--direct", "analytic"]
        whole = self.run_to("whole", "--photons", "90k", *options)
        part = self.run_to("part", "--photons", "30k", *options)
        self.succeeds("resume", part, "--photons", "90k", "--threads", "1")
        self.assert_same(whole, part)

    def test_resume_to_a_smaller_error(self):
        options = ["--estimator", "auto", "--only", "tiles"]
        whole = self.run_to("whole", "--target-error", "15%", *options)
        part = self.run_to("part", "--target-error", "30%", *options)
        self.succeeds("resume", part, "--target-error", "15%")
        self.assertEqual((whole / "tiles.csv").read_bytes(), (part / "tiles.csv").read_bytes())
        self.assertEqual(json.loads((part / "summary.json").read_text())["stopped_by"], "target-error")

    def test_resume_with_the_new_path_of_a_moved_room(self):
        moved = self.folder / "moved.glb"
        shutil.copy(ROOM, moved)
        part = self.run_to("part", "--photons", "30k", room=moved)
        moved.rename(self.folder / "new.glb")
        self.refused("resume", part, says=["moved.glb"])
        self.succeeds("resume", part, "--photons", "40k", "--room", self.folder / "new.glb")
        self.refused("resume", part, "--room", SCENES / "cube_paper.gltf", says=["another room", "cube_paper"])

    def test_merge_in_any_order_and_grouping(self):
        whole = self.run_to("whole", "--photons", "100000", "--estimator", "collision")  # as parts
        parts = [self.run_to(name, "--histories", histories)
                 for name, histories in (("a", "0:30720"), ("b", "30720:61440"), ("c", "61440:100000"))]
        both = self.folder / "both"
        self.succeeds("merge", parts[2], parts[0], "-o", both)
        summary = json.loads((both / "summary.json").read_text())
        self.assertEqual(summary["histories"], 69280)
        merged = self.folder / "merged"
        self.succeeds("merge", both / "state.h5", parts[1], "-o", merged)
        self.assert_same(whole, merged)
        self.succeeds("merge", *reversed(parts), "-o", merged)
        self.assert_same(whole, merged)
        # The sum can be resumed.
        longer = self.run_to("longer", "--photons", "150k", "--estimator", "collision")
        self.succeeds("resume", merged, "--photons", "150k")
        self.assert_same(longer, merged)

    def test_states_that_do_not_match_are_refused_and_nothing_is_written(self):
        one = self.run_to("one", "--histories", "0:20480")
        two = self.run_to("two", "--histories", "20480:40960", "--seed", "2")
        three = self.run_to("three", "--histories", "40960:61440")
        nothing = self.folder / "nothing"
        self.refused("merge", one, one, "-o", nothing, says=["overlap", "0:20480", "twice"])
        self.refused("merge", one, two, "-o", nothing, says=["'seed' (--seed): 1 and 2"])
        self.refused("merge", one, self.folder, "-o", nothing, says=["No such file", "state.h5"])
        self.refused("merge", one, three / "tiles.csv", "-o", nothing, says=["no state of lichtmc"])
        damaged = self.folder / "damaged.h5"
        content = bytearray((three / "state.h5").read_bytes())
        content[len(content) // 2] ^= 4
        damaged.write_bytes(content)
        self.refused("merge", one, damaged, "-o", nothing, says=["damaged", "checksum"])
        self.refused("resume", damaged, "-o", nothing, says=["damaged", "checksum"])
        self.assertFalse(nothing.exists())
        self.refused("merge", one, three, "-o", one, says=["would replace", "one of its parts"])
        gap = self.folder / "gap"
        self.succeeds("merge", one, three, "-o", gap)
        self.refused("resume", gap, "--photons", "1e6", says=["gaps", "20480", "40959", "--histories"])

    def test_many_receivers_in_small_parts(self):
        """Rounds of walks for 100 receivers end elsewhere than the parts: each round is in one part only."""
        options = ["--grid", "0.5", "--grid-spacing", "0.1", "--no-report"]
        whole = self.folder / "whole"
        self.succeeds("run", SCENES / "cube_paper.gltf", "-o", whole, "--photons", "32768", "--estimator", "collision", *options)
        names = []
        for first, last in ((0, 8192), (8192, 16384), (16384, 32768)):
            names.append(self.folder / str(first))
            self.succeeds("run", SCENES / "cube_paper.gltf", "-o", names[-1], "--histories", f"{first}:{last}", *options)
        merged = self.folder / "merged"
        self.succeeds("merge", *names, "-o", merged)
        self.assert_same(whole, merged)
        self.assertIn("No part contains the histories 8192 to 16383", self.succeeds("merge", names[0], names[2], "-o", merged))

    def test_a_stop_before_the_receivers_keeps_the_tiles(self):
        """The direct light of many receivers takes long: a stop during it must not discard the scores of the photons."""
        out = self.folder / "out"
        done = lichtmc("run", ROOM, "-o", out, "--tile", "0.5", "--max-time", "0.4s", "--grid", "0.85", "--grid-spacing", "0.01", "--no-report")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("Warning: The run was stopped before the first round of walks for the receivers", done.stderr)
        self.assertTrue((out / "tiles.csv").exists())
        self.assertFalse((out / "receivers.csv").exists())
        summary = json.loads((out / "summary.json").read_text())
        self.assertGreater(summary["histories"], 0)
        self.assertEqual(summary["stopped_by"], "max-time")
        # Parts without a gap cause no warning.
        one = self.run_to("one", "--histories", "0:20480")
        two = self.run_to("two", "--histories", "20480:40960")
        said = self.succeeds("merge", one, two, "-o", self.folder / "both")
        for words in ("has no backward histories", "The run was stopped", "No part contains"):
            self.assertNotIn(words, said)

    def test_resume_after_max_time_keeps_the_results(self):
        """When the time of a run is used up, resume must not need more, although direct light is integrated again."""
        for options in (["--direct", "analytic", "--grid", "0.5"], ["--tiles", "backward", "--grid", "0.5"]):
            out = self.folder / options[1]
            self.succeeds("run", SCENES / "cube_paper.gltf", "-o", out, "--max-time", "1s", "--no-report", *options)
            tables = [(out / table).read_bytes() for table in TABLES]
            self.succeeds("resume", out)
            self.assertEqual([(out / table).read_bytes() for table in TABLES], tables)

    def test_a_resumed_part_keeps_to_its_histories(self):
        part = self.run_to("part", "--histories", "0:20480", "--target-error", "0.1%", "--only", "tiles")
        self.assertEqual(json.loads((part / "summary.json").read_text())["stopped_by"], "photons")
        self.succeeds("resume", part, "--target-error", "0.01%")
        self.assertEqual(json.loads((part / "summary.json").read_text())["histories"], 20480)
        self.succeeds("resume", part, "--photons", "30720")
        self.assertEqual(json.loads((part / "summary.json").read_text())["histories"], 30720)

    def test_merge_uses_the_given_number_of_threads(self):
        part = self.run_to("part", "--photons", "20k", "--threads", "2")
        merged = self.folder / "merged"
        self.succeeds("merge", part, "-o", merged, "--threads", "1")
        self.assertEqual(json.loads((merged / "summary.json").read_text())["threads"], 1)
        self.assert_same(part, merged)

    def test_a_copy_of_a_state_does_not_replace_the_state_in_the_same_folder(self):
        part = self.run_to("part", "--photons", "20k")
        copy = part / "copy.h5"
        shutil.copy(part / "state.h5", copy)
        self.refused("resume", copy, "--photons", "30k", says=["copy.h5", "would replace", "--output"])
        shutil.copy(copy, self.folder / "alone.h5")
        self.succeeds("resume", self.folder / "alone.h5", "--photons", "30k", "-o", self.folder / "further")
        # Without another state in the folder of the file, the results are written there.
        alone = self.folder / "folder"
        alone.mkdir()
        shutil.copy(copy, alone / "alone.h5")
        self.succeeds("resume", alone / "alone.h5", "--photons", "30k")
        self.assert_same(alone, self.folder / "further")

    def test_a_refused_run_leaves_no_folder(self):
        part = self.run_to("part", "--photons", "20k")
        deep = self.folder / "a" / "b"
        self.refused("resume", part, "--room", SCENES / "cube_paper.gltf", "-o", deep, says=["another room"])
        self.refused("merge", part, "--room", SCENES / "cube_paper.gltf", "-o", deep, says=["another room"])
        self.refused("run", ROOM, "--photons", "0", "-o", deep, says=["photons"])
        self.assertFalse((self.folder / "a").exists())

    def test_unconnected_processes_cause_a_warning(self):
        environment = {**os.environ, "SLURM_STEP_NUM_TASKS": "4", "SLURM_PROCID": "0"}
        command = ("run", SCENES / "cube_paper.gltf", "-o", self.folder / "out", "--no-report", "--photons", "2k")
        said = lichtmc(*command, env=environment)
        self.assertEqual(said.returncode, 0, said.stderr)
        self.assertIn("srun has started 4 processes without a connection between them", said.stderr)
        self.assertNotIn("srun", lichtmc(*command, env={**environment, "SLURM_PROCID": "1"}).stderr)
        self.assertNotIn("srun", lichtmc(*command, env={**environment, "SLURM_STEP_NUM_TASKS": "1"}).stderr)

    def test_options_are_checked(self):
        for histories, says in (("10:2000", "Begin at 0 or 1024"), ("2048", "A:B"), ("2048:1024", "is empty"),
                                ("a:b", "--histories")):
            self.refused("run", ROOM, "--histories", histories, says=[says])
        self.refused("run", ROOM, "--histories", "0:1024", "--photons", "1e6", says=["--photons and --histories"])
        self.refused("run", ROOM, "--histories", "0:2048", "--estimator", "auto", says=["'auto'", "parts"])
        for checkpoint in ("0", "-1s", "soon"):
            self.refused("run", ROOM, "--checkpoint", checkpoint, says=["--checkpoint"])

    def test_receivers_from_stdin_must_be_given_again(self):
        table = "1,1,1,0,1,0\n2,1,2,0,1,0\n"
        part = self.folder / "part"
        done = lichtmc("run", SCENES / "cube_paper.gltf", "-o", part, "--no-report", "--photons", "20k", "--receivers", "-", input=table)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.refused("resume", part, "--photons", "30k", says=["stdin", "--receivers"])
        self.refused("merge", part, "-o", self.folder / "merged", says=["stdin", "--receivers"])
        points = self.folder / "points.csv"
        points.write_text(table)
        self.succeeds("resume", part, "--photons", "30k", "--receivers", points)
        points.write_text(table.replace("2,1,2", "2,1,2.5"))
        self.refused("resume", part, "--photons", "40k", "--receivers", points, says=["another room", "receivers"])


if __name__ == "__main__":
    unittest.main()
