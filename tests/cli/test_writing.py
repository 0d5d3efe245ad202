"""Results in their folder: one writer at a time, all files on the disk before the first is replaced, and no images on request."""
import errno
import hashlib
import os
import pathlib
import shutil
import signal
import subprocess
import time
import unittest

from support import PROGRAM, SCENES, ProgramTest, lichtmc, triangle_room

CUBE = SCENES / "cube_paper.gltf"
FAULTY_DISK = os.environ.get("LICHTMC_FAULTY_DISK", "")
LONG = ("--photons", "1e12", "--tile", "0.1", "--no-report", "--quiet", "--checkpoint", "0.05s")
SHORT = ("--photons", "20k", "--tile", "0.1", "--no-report", "--quiet")


def digests(folder):
    return {path.relative_to(folder).as_posix(): hashlib.sha256(path.read_bytes()).hexdigest()
            for path in sorted(folder.rglob("*")) if path.is_file()}


class OneWriter(ProgramTest):
    def start(self, *arguments):
        process = subprocess.Popen([PROGRAM, *map(str, arguments)], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        self.addCleanup(process.communicate)
        self.addCleanup(process.kill)
        return process

    def started(self, folder, *arguments):
        """A run that holds the folder and has written its first checkpoint."""
        process = self.start("run", CUBE, "-o", folder, *LONG, *arguments)
        end = time.monotonic() + 30
        while not (folder / "state.h5").exists():
            self.assertIsNone(process.poll())
            self.assertLess(time.monotonic(), end)
            time.sleep(0.01)
        return process

    def test_the_second_of_two_runs_is_refused_before_it_changes_anything(self):
        out = self.folder / "out"
        self.assertEqual(lichtmc("run", CUBE, "-o", out, *SHORT).returncode, 0)
        (out / "state.h5").unlink()
        other = self.folder / "other"
        self.assertEqual(lichtmc("run", CUBE, "-o", other, *SHORT).returncode, 0)
        first = self.started(out)
        before = {name: digest for name, digest in digests(out).items() if name not in ("state.h5", ".lichtmc.lock")}
        for command in (("run", CUBE, "-o", out, *SHORT), ("resume", out), ("resume", other, "-o", out),
                        ("merge", other, "-o", out), ("paths", CUBE, "-o", out), ("study", CUBE, "--quick", "-o", out)):
            with self.subTest(command=command[0]):
                message = self.refused(*command, says=["The output folder", str(out), f"process {first.pid}", "--output"])
                self.assertNotIn("\n", message.rstrip("\n"))
        self.assertIsNone(first.poll())
        after = {name: digest for name, digest in digests(out).items() if name in before}
        self.assertEqual(after, before)
        first.send_signal(signal.SIGTERM)
        self.assertEqual(first.wait(60), 0)
        self.assertFalse((out / ".lichtmc.lock").exists())
        self.assertEqual(lichtmc("run", CUBE, "-o", out, *SHORT).returncode, 0)

    def test_of_two_runs_started_together_one_is_whole_and_the_other_refused(self):
        for attempt in range(3):
            out = self.folder / f"out{attempt}"
            both = [self.start("run", CUBE, "-o", out, "--photons", "1M", "--tile", "0.1", "--no-report", "--seed", seed) for seed in (1, 2)]
            statuses = [process.wait(60) for process in both]
            self.assertEqual(sorted(statuses), [0, 2])
            alone = self.folder / f"alone{attempt}"
            self.assertEqual(lichtmc("run", CUBE, "-o", alone, "--photons", "1M", "--tile", "0.1", "--no-report", "--seed", 1 + statuses.index(0)).returncode, 0)
            self.assertEqual((out / "tiles.csv").read_bytes(), (alone / "tiles.csv").read_bytes())

    def test_the_lock_of_a_killed_run_does_not_block(self):
        out = self.folder / "out"
        process = self.started(out)
        process.kill()
        process.wait()
        self.assertTrue((out / ".lichtmc.lock").exists())
        self.assertEqual(lichtmc("resume", out, "--photons", "30M", "--quiet").returncode, 0)
        self.assertFalse((out / ".lichtmc.lock").exists())

    def test_a_refused_run_leaves_no_folder_and_no_lock(self):
        out = self.folder / "new" / "out"
        self.refused("run", CUBE, "-o", out, "--estimator", "absorption", "--reflectance", "wall=1", says=["absorption"])
        self.assertFalse((self.folder / "new").exists())

    def test_a_folder_removed_during_the_run_is_locked_again(self):
        out = self.folder / "out"
        process = self.started(out)
        shutil.rmtree(out, ignore_errors=True)
        end = time.monotonic() + 30
        while not (out / "state.h5").exists():
            self.assertLess(time.monotonic(), end)
            time.sleep(0.01)
        self.refused("run", CUBE, "-o", out, *SHORT, says=[f"process {process.pid}"])
        process.send_signal(signal.SIGTERM)
        self.assertEqual(process.wait(60), 0)
        self.assertTrue((out / "summary.json").exists())


class Images(ProgramTest):
    def test_without_images_those_of_the_run_before_are_removed(self):
        out = self.folder / "out"
        self.assertEqual(lichtmc("run", CUBE, "-o", out, *SHORT).returncode, 0)
        self.assertEqual(len(list(out.glob("tiles/*.exr"))), 6)
        tiles = (out / "tiles.csv").read_bytes()
        done = lichtmc("run", CUBE, "-o", out, *SHORT[:-2], "--no-images")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertNotIn(".exr", done.stderr)
        self.assertFalse((out / "tiles").exists())
        self.assertEqual((out / "tiles.csv").read_bytes(), tiles)
        self.assertIn("--no-images", (out / "report.html").read_text().split("To reproduce this")[0])
        self.assertEqual(lichtmc("resume", out, "--quiet").returncode, 0)  # keeps the option of the run
        self.assertFalse((out / "tiles").exists())
        self.assertEqual(lichtmc("resume", out, "--quiet", "--images", "--no-report").returncode, 0)
        self.assertEqual(len(list(out.glob("tiles/*.exr"))), 6)


@unittest.skipUnless(FAULTY_DISK, "the library that simulates faults of a disk is not built")
class Disk(ProgramTest):
    SURFACES = 40

    def room(self):
        document = triangle_room()
        for k in range(self.SURFACES - 1):
            document["nodes"].append({"name": f"floor{k}", "mesh": 0, "translation": [0, -0.01 * k, 0]})
            document["scenes"][0]["nodes"].append(k + 2)
        return self.write_gltf(document)

    def run_with(self, room, out, *options, fault=None):
        """The finished run, and its calls in order as (call, path below the output folder)."""
        log = self.folder / "calls"
        log.unlink(missing_ok=True)
        environment = {**os.environ, "LD_PRELOAD": FAULTY_DISK, "LICHTMC_DISK_LOG": str(log)}
        if fault:
            environment["LICHTMC_DISK_FAULT"] = fault
        done = lichtmc("run", room, "-o", out, "--photons", "20k", "--tile", "0.5", "--no-report", "--quiet", *options, env=environment)
        calls = [line.split(" ", 1) for line in log.read_text().splitlines()]
        return done, [(call, os.path.relpath(path, out)) for call, path in calls if path.startswith(str(out))]

    @staticmethod
    def after_the_state(calls):
        return calls[calls.index(("rename", "state.h5")) + 1:]

    def test_all_files_are_flushed_together_before_the_first_is_renamed(self):
        out = self.folder / "out"
        done, calls = self.run_with(self.room(), out)
        self.assertEqual(done.returncode, 0, done.stderr)
        calls = self.after_the_state(calls)
        names = [path for call, path in calls if call == "rename"]
        self.assertEqual(len(names), self.SURFACES + 4)  # with tables of surfaces, tiles and emitters, and summary.json
        self.assertEqual(names[-1], "summary.json")
        first = next(k for k, (call, _) in enumerate(calls) if call == "rename")
        self.assertEqual(sum(call == "syncfs" for call, _ in calls), 1)
        self.assertLess(next(k for k, (call, _) in enumerate(calls) if call == "syncfs"), first)
        # The new names are on the disk before summary.json says that all are there.
        last = calls.index(("rename", "summary.json"))
        self.assertLessEqual({("fsync", "."), ("fsync", "tiles")}, set(calls[last - 2:last]))
        self.assertLess(sum(call == "fsync" for call, _ in calls), 10)

    def test_without_that_call_each_file_is_flushed(self):
        out = self.folder / "out"
        room = self.room()
        for number in (errno.ENOSYS, errno.EPERM):
            done, calls = self.run_with(room, out, fault=f"syncfs {number}")
            self.assertEqual(done.returncode, 0, done.stderr)
            calls = self.after_the_state(calls)
            first = next(k for k, (call, _) in enumerate(calls) if call == "rename")
            flushed = {pathlib.PurePath(path).name for call, path in calls[:first] if call == "fsync"}
            self.assertLessEqual({path.name for path in out.rglob("*.exr")} | {"tiles.csv", "surfaces.csv", "emitters.csv", "summary.json"}, flushed)

    def test_a_disk_that_fails_while_files_are_flushed_leaves_the_old_results(self):
        out = self.folder / "out"
        room = self.room()
        done, _ = self.run_with(room, out)
        self.assertEqual(done.returncode, 0, done.stderr)
        old = digests(out)
        for fault in (f"syncfs {errno.EIO}", f"syncfs {errno.ENOSPC}"):
            done, _ = self.run_with(room, out, "--seed", "2", fault=fault)
            self.assertEqual(done.returncode, 1, done.stderr)
            self.assertIn("lichtmc: Cannot write", done.stderr)
            new = digests(out)
            self.assertEqual({name for name in old | new if old.get(name) != new.get(name)}, {"state.h5"})
            self.assertEqual([name for name in os.listdir(out) if name.startswith(".lichtmc")], [])

    def test_a_name_that_cannot_be_replaced_ends_the_run(self):
        done, _ = self.run_with(self.room(), self.folder / "out", fault=f"rename {errno.EACCES}")
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertIn("Permission denied", done.stderr)


if __name__ == "__main__":
    unittest.main()
