"""Progress for programs (--progress), and what --quiet leaves of it."""
import json
import subprocess
import unittest

from support import PROGRAM, SCENES, ProgramTest, lichtmc

CUBE = SCENES / "cube_paper.gltf"
KEYS = ["stage", "step", "fraction", "seconds", "seconds_left", "error", "target_error", "histories"]


def progress_of(stderr):
    return [json.loads(line) for line in stderr.splitlines() if line.startswith("{")]


class Progress(ProgramTest):
    def check(self, lines):
        """Keys, order and range of the lines of a command that was successful."""
        for line in lines:
            self.assertEqual(list(line), KEYS)
            for key in ("fraction", "error"):
                if line[key] is not None:
                    self.assertGreaterEqual(line[key], 0.0)
            self.assertTrue(line["fraction"] is None or line["fraction"] <= 1.0)
        seconds = [line["seconds"] for line in lines]
        self.assertEqual(seconds, sorted(seconds))
        self.assertEqual(lines[-1]["stage"], "done")
        self.assertEqual(lines[-1]["fraction"], 1.0)
        self.assertEqual(lines[-1]["seconds_left"], 0.0)

    def test_a_run_writes_an_object_per_line_at_least_every_second(self):
        done = lichtmc("run", CUBE, "-o", self.folder / "out", "--max-time", "3s", "--progress", "json")
        self.assertEqual(done.returncode, 0, done.stderr)
        lines = progress_of(done.stderr)
        self.check(lines)
        stages = [line["stage"] for line in lines]
        self.assertEqual(stages[0], "preparation")
        for stage in ("tiles", "writing"):
            self.assertIn(stage, stages)
        walking = [line for line in lines if line["stage"] == "tiles"]
        self.assertGreater(walking[-1]["fraction"], walking[0]["fraction"])
        self.assertLess(walking[-1]["seconds_left"], 3.0)
        self.assertGreater(walking[-1]["histories"], 0)
        # 0.9 s between lines, and as much again for a machine that is busy.
        seconds = [line["seconds"] for line in lines]
        self.assertLess(max(b - a for a, b in zip(seconds, seconds[1:])), 1.8)
        # The other messages are still there, as text.
        self.assertIn("Results are in", done.stderr)

    def test_the_target_error_is_told(self):
        done = lichtmc("run", CUBE, "-o", self.folder / "out", "--target-error", "10%", "--no-report", "--progress", "json")
        lines = progress_of(done.stderr)
        self.check(lines)
        self.assertEqual(lines[-1]["target_error"], 0.1)
        self.assertLess(lines[-1]["error"], 0.1)

    def test_with_quiet_only_the_progress_is_left(self):
        arguments = ["run", CUBE, "-o", self.folder / "out", "--photons", "2000", "--no-report", "--quiet"]
        done = lichtmc(*arguments, "--progress", "json")
        self.check(progress_of(done.stderr))
        self.assertEqual([line for line in done.stderr.splitlines() if not line.startswith("{")], [])
        self.assertEqual(lichtmc(*arguments).stderr, "")

    def test_none_leaves_the_messages(self):
        done = lichtmc("run", CUBE, "-o", self.folder / "out", "--photons", "2000", "--no-report", "--progress", "none")
        self.assertEqual(progress_of(done.stderr), [])
        self.assertIn("Results are in", done.stderr)

    def test_resume_merge_and_study(self):
        out = self.folder / "out"
        lichtmc("run", CUBE, "-o", out, "--photons", "2048", "--no-report")
        done = lichtmc("resume", out, "--photons", "4096", "--progress", "json")
        self.check(progress_of(done.stderr))
        parts = [self.folder / "one", self.folder / "two"]
        for part, histories in zip(parts, ("0:2048", "2048:4096")):
            lichtmc("run", CUBE, "-o", part, "--histories", histories, "--no-report")
        done = lichtmc("merge", *parts, "-o", self.folder / "both", "--progress", "json")
        self.check(progress_of(done.stderr))
        done = lichtmc("study", CUBE, "-o", self.folder / "study", "--max-time", "6s", "--progress", "json")
        lines = progress_of(done.stderr)
        self.check(lines)
        self.assertIn("study", {line["stage"] for line in lines})

    def test_a_refused_run_does_not_say_that_it_is_done(self):
        done = lichtmc("run", self.folder / "nothing.glb", "-o", self.folder / "out", "--progress", "json")
        self.assertEqual(done.returncode, 2)
        self.assertNotIn("done", [line["stage"] for line in progress_of(done.stderr)])

    def test_other_forms_are_refused(self):
        self.refused("run", CUBE, "-o", self.folder / "out", "--progress", "xml", says=["--progress", "xml", "bar, json, none"])

    def test_the_example_of_the_docs(self):
        """A front end reads the lines as they come."""
        command = [PROGRAM, "run", CUBE, "-o", self.folder / "out", "--photons", "20000", "--no-report", "--progress", "json"]
        with subprocess.Popen(command, stderr=subprocess.PIPE, text=True) as run:
            stages = [json.loads(line)["stage"] for line in run.stderr if line.startswith("{")]
        self.assertEqual(stages[-1], "done")


if __name__ == "__main__":
    unittest.main()
