"""Faults during a run: kills at any moment, full disks, removed folders, signals, a killed process of several."""
import hashlib
import json
import os
import random
import resource
import shutil
import signal
import subprocess
import sys
import time
import unittest

from support import PROGRAM, SCENES, ProgramTest, lichtmc

CUBE = SCENES / "cube_paper.gltf"
KILLS = int(os.environ.get("LICHTMC_KILLS", "40"))
MPIRUN = os.environ.get("LICHTMC_MPIRUN", "")


def digests(folder):
    return {path.relative_to(folder).as_posix(): hashlib.sha256(path.read_bytes()).hexdigest()
            for path in sorted(folder.rglob("*")) if path.is_file()}


def start(*arguments, **options):
    return subprocess.Popen([PROGRAM, *map(str, arguments)], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, **options)


def wait_for(condition, seconds=20.0):
    end = time.monotonic() + seconds
    while not condition():
        if time.monotonic() > end:
            raise AssertionError("timeout")
        time.sleep(0.002)


class FaultTest(ProgramTest):
    # Some seconds on two cores; 15000 tiles: a checkpoint of half a megabyte.
    OPTIONS = ["--tile", "0.02", "--photons", "1e7", "--grid", "0.5", "--no-report", "--quiet"]

    def reference(self):
        whole = self.folder / "whole"
        done = lichtmc("run", CUBE, "-o", whole, *self.OPTIONS)
        self.assertEqual(done.returncode, 0, done.stderr)
        return whole

    def assert_same(self, whole, folder):
        for table in ("tiles.csv", "surfaces.csv", "receivers.csv"):
            self.assertEqual((whole / table).read_bytes(), (folder / table).read_bytes(), table)


class Faults(FaultTest):
    def wait_and_kill(self, process, folder, at_checkpoint):
        """Kills at a random moment, or while a state is being written. Returns whether it was running, and writing."""
        moment = time.monotonic() + random.uniform(0.0, 0.4)
        while process.poll() is None:
            if at_checkpoint and folder.exists() and any(".h5.tmp" in name for name in os.listdir(folder)):
                time.sleep(random.choice((0.0, 0.0, 0.0005, 0.001, 0.002)))
                break
            if time.monotonic() > moment + (2.0 if at_checkpoint else 0.0):
                break
            if not at_checkpoint:
                time.sleep(0.001)
        alive = process.poll() is None
        writing = alive and folder.exists() and any(".h5.tmp" in name for name in os.listdir(folder))
        process.kill()
        process.communicate()
        return alive, writing

    def test_a_run_killed_at_any_moment_and_resumed_gives_identical_results(self):
        random.seed(8)
        whole = self.reference()
        kills = while_writing = chains = 0
        while kills < KILLS:
            chains += 1
            folder = self.folder / f"chain{chains}"
            for round_ in range(12):
                command = ("resume", folder, "--quiet") if (folder / "state.h5").exists() else ("run", CUBE, "-o", folder, *self.OPTIONS)
                process = start(*command, "--checkpoint", "0.02s")
                if round_ == 11:
                    self.assertEqual(process.wait(120), 0, process.stderr.read())
                    process.stderr.close()
                    break
                alive, writing = self.wait_and_kill(process, folder, at_checkpoint=round_ % 2 == 1)
                kills += alive
                while_writing += writing
            self.assert_same(whole, folder)
            # No incomplete file remains.
            self.assertEqual([name for name in os.listdir(folder) if name.startswith(".lichtmc") or ".tmp" in name], [])
            shutil.rmtree(folder)
        print(f"{kills} kills, {while_writing} of them while a state was being written; {chains} runs with identical results", file=sys.stderr)
        self.assertGreater(while_writing, KILLS // 20)

    def limited(self, kilobytes, *arguments):
        def limit():
            resource.setrlimit(resource.RLIMIT_FSIZE, (kilobytes * 1024, kilobytes * 1024))
        return lichtmc(*arguments, preexec_fn=limit)

    def test_a_full_disk_leaves_the_old_files_complete(self):
        out = self.folder / "out"
        options = ["--tile", "0.05", "--photons", "20k", "--grid", "0.5"]
        self.assertEqual(lichtmc("run", CUBE, "-o", out, *options).returncode, 0)
        old = digests(out)
        complete = self.folder / "complete"
        shutil.copytree(out, complete)
        largest = max(path.stat().st_size for path in out.rglob("*") if path.is_file()) // 1024 + 1
        failed = 0
        left = []  # the sets of files that were new after a failure
        # Limits from 0 to the largest file: the state, a table or the report is the first that does not fit.
        for kilobytes in [0, 1, 2, 4, 8] + [largest * k // 8 for k in range(1, 8)]:
            done = self.limited(kilobytes, "run", CUBE, "-o", out, "--seed", "2", *options)
            if done.returncode == 0:
                continue
            # If no byte can be written, the folder is refused before the run.
            self.assertEqual(done.returncode, 2 if kilobytes == 0 else 1, done.stderr)
            failed += 1
            self.assertIn("lichtmc: Cannot", done.stderr)
            self.assertEqual(done.stderr.count("lichtmc:"), 1, done.stderr)
            new = digests(out)
            changed = {name for name in old if new.get(name) != old[name]}
            # Either only the state is new, or all results are new and only the report is missing.
            # emitters.csv is the same for every seed.
            results = {name for name in old if name.endswith((".csv", ".json"))} - {"emitters.csv"}
            if changed & results:
                self.assertTrue(results <= changed, changed)
            else:
                self.assertTrue(changed <= {"state.h5"}, changed)
            self.assertEqual([name for name in os.listdir(out) if name.startswith(".lichtmc") or ".tmp" in name], [])
            # What follows depends only on the files that are left.
            if changed not in left:
                left.append(changed)
                if changed & results:
                    self.assertEqual(lichtmc("resume", out, "--quiet").returncode, 0)
                self.assertEqual(lichtmc("run", CUBE, "-o", out, *options).returncode, 0)
                self.assertEqual(digests(out)["tiles.csv"], old["tiles.csv"])
            shutil.rmtree(out)
            shutil.copytree(complete, out)
        self.assertGreater(failed, 8)
        self.assertIn({"state.h5"}, left)

    def test_a_checkpoint_that_fails_does_not_end_the_run(self):
        out = self.folder / "out"
        done = self.limited(100, "run", CUBE, "-o", out, "--tile", "0.02", "--photons", "3e7", "--only", "tiles", "--checkpoint", "0.02s")
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertIn("Warning: the checkpoint was not written; the run continues.", done.stderr)
        self.assertIn("lichtmc: Cannot write", done.stderr)

    def test_tallies_beyond_memory_are_refused_before_the_start(self):
        def limit():
            resource.setrlimit(resource.RLIMIT_AS, (2_000_000_000, 2_000_000_000))
        out = self.folder / "out"
        for options, says in ((["--tile", "0.0002"], "150000000 cells, 25000000 of them on the surface"),
                              (["--tile", "0.002", "--threads", "64"], "1500000 tiles")):
            done = lichtmc("run", CUBE, "-o", out, "--photons", "1e9", "--estimator", "collision", *options, preexec_fn=limit)
            self.assertEqual(done.returncode, 2, done.stderr)
            self.assertIn(says, done.stderr)
            self.assertIn("Give --tile", done.stderr)
            self.assertFalse((out / "summary.json").exists())
        self.assertIn("for 64 threads need 4.0 GB of memory (allowed: 2.0 GB, the available memory)", done.stderr.replace(" 4 GB", " 4.0 GB").replace(" 2 GB", " 2.0 GB"))

    def test_a_removed_folder_is_created_again_with_the_results(self):
        whole = self.reference()
        out = self.folder / "out"
        process = start("run", CUBE, "-o", out, *self.OPTIONS, "--checkpoint", "0.02s")
        wait_for(lambda: (out / "state.h5").exists())
        shutil.rmtree(out, ignore_errors=True)
        self.assertEqual(process.wait(120), 0, process.stderr.read())
        process.stderr.close()
        self.assert_same(whole, out)

    def test_a_folder_that_cannot_be_written_to_is_refused_before_the_run(self):
        (self.folder / "file").write_text("")
        self.refused("run", CUBE, "-o", self.folder / "file" / "out", says=["Cannot write into the output folder"])
        part = self.folder / "part"
        self.assertEqual(lichtmc("run", CUBE, "-o", part, "--no-report", "--photons", "20k").returncode, 0)
        self.refused("resume", part, "-o", "/proc/none", says=["Cannot write into the output folder"])

    def test_a_run_ended_by_a_signal_can_be_resumed(self):
        whole = self.reference()
        for number in (signal.SIGINT, signal.SIGTERM):
            out = self.folder / f"out{number}"
            process = start("run", CUBE, "-o", out, *self.OPTIONS, "--checkpoint", "0.05s")
            wait_for(lambda: (out / "state.h5").exists())
            process.send_signal(number)
            self.assertEqual(process.wait(60), 0, process.stderr.read())
            process.stderr.close()
            summary = json.loads((out / "summary.json").read_text())
            self.assertEqual(summary["stopped_by"], "interrupt")
            self.assertEqual(lichtmc("resume", out, "--quiet").returncode, 0)
            self.assert_same(whole, out)

    def test_a_signal_does_not_interrupt_the_writing_of_results(self):
        """Also when a terminal is closed. The walk is short and the files are large."""
        options = ["--tile", "0.004", "--photons", "20k", "--no-report", "--quiet"]
        whole = self.folder / "whole"
        self.assertEqual(lichtmc("run", CUBE, "-o", whole, *options).returncode, 0)
        for number in (signal.SIGTERM, signal.SIGINT, signal.SIGHUP):
            out = self.folder / f"out{number}"
            process = start("run", CUBE, "-o", out, *options)
            wait_for(lambda: out.exists() and any(name.startswith(".lichtmc-") for name in os.listdir(out)))
            process.send_signal(number)
            self.assertEqual(process.wait(60), 0, process.stderr.read())
            process.stderr.close()
            self.assertEqual(set(digests(out)), set(digests(whole)))
            self.assertEqual((out / "tiles.csv").read_bytes(), (whole / "tiles.csv").read_bytes())

    def test_a_closed_terminal_ends_a_run_except_under_nohup(self):
        out = self.folder / "out"
        process = start("run", CUBE, "-o", out, *self.OPTIONS, "--checkpoint", "0.05s")
        wait_for(lambda: (out / "state.h5").exists())
        process.send_signal(signal.SIGHUP)
        self.assertEqual(process.wait(60), 0, process.stderr.read())
        process.stderr.close()
        self.assertEqual(json.loads((out / "summary.json").read_text())["stopped_by"], "interrupt")
        # nohup ignores SIGHUP in the same way.
        process = start("run", CUBE, "-o", out, *self.OPTIONS, "--checkpoint", "0.05s",
                        preexec_fn=lambda: signal.signal(signal.SIGHUP, signal.SIG_IGN))
        wait_for(lambda: not (out / "summary.json").exists() or process.poll() is not None)
        process.send_signal(signal.SIGHUP)
        self.assertEqual(process.wait(60), 0, process.stderr.read())
        process.stderr.close()
        self.assertEqual(json.loads((out / "summary.json").read_text())["stopped_by"], "photons")


@unittest.skipUnless(MPIRUN, "mpirun is missing, or the program was built without MPI")
class Ranks(FaultTest):
    """Several processes that share a run."""
    ENVIRONMENT = {**os.environ, "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}

    def mpirun(self, processes, *arguments):
        return [MPIRUN, "--oversubscribe", "-n", str(processes), PROGRAM, *map(str, arguments)]

    def run_ranks(self, processes, *arguments):
        return subprocess.run(self.mpirun(processes, *arguments), env=self.ENVIRONMENT, capture_output=True, text=True, timeout=120, check=False)

    def test_several_ranks_give_the_results_of_one_process(self):
        for options in (["--photons", "300001"], ["--target-error", "8%", "--estimator", "auto"]):
            options += ["--tile", "0.1", "--grid", "0.5", "--no-report"]
            whole = self.folder / "whole"
            self.assertEqual(lichtmc("run", CUBE, "-o", whole, *options).returncode, 0)
            for processes in (1, 2, 3):
                out = self.folder / f"ranks{processes}"
                done = self.run_ranks(processes, "run", CUBE, "-o", out, "--threads", "1", *options)
                self.assertEqual(done.returncode, 0, done.stderr)
                self.assertEqual(done.stderr.count("Results are in"), 1, done.stderr)
                self.assert_same(whole, out)

    def test_several_ranks_resume_a_run_of_one_process(self):
        options = ["--tile", "0.1", "--grid", "0.5", "--no-report"]
        whole = self.folder / "whole"
        self.assertEqual(lichtmc("run", CUBE, "-o", whole, "--photons", "200k", *options).returncode, 0)
        part = self.folder / "part"
        self.assertEqual(lichtmc("run", CUBE, "-o", part, "--photons", "70k", *options).returncode, 0)
        done = self.run_ranks(2, "resume", part, "--photons", "200k")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assert_same(whole, part)

    def test_errors_are_reported_once_and_end_all_ranks(self):
        done = self.run_ranks(3, "run", self.folder / "missing.glb")
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertEqual(done.stderr.count("Cannot read"), 1, done.stderr)
        done = self.run_ranks(2, "study", CUBE)
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertIn("runs in one process", done.stderr)

    def start_ranks(self, out):
        """Two ranks that have written their first checkpoint: the job, and the process ids in order of rank."""
        job = subprocess.Popen(self.mpirun(2, "run", CUBE, "-o", out, *self.OPTIONS, "--threads", "1", "--checkpoint", "0.05s"),
                               env=self.ENVIRONMENT, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        wait_for(lambda: (out / "state.h5").exists())
        children = subprocess.run(["pgrep", "-P", str(job.pid)], capture_output=True, text=True, check=False).stdout.split()
        programs = [int(pid) for pid in children if os.path.realpath(f"/proc/{pid}/exe") == os.path.realpath(PROGRAM)]
        self.assertEqual(len(programs), 2)
        return job, sorted(programs)

    def test_after_the_kill_of_one_rank_the_job_ends_and_the_checkpoint_is_valid(self):
        whole = self.reference()
        for rank in (0, 1):
            out = self.folder / f"out{rank}"
            job, pids = self.start_ranks(out)
            os.kill(pids[rank], signal.SIGKILL)
            self.assertNotEqual(job.wait(60), 0)
            self.assertFalse((out / "tiles.csv").exists())
            self.assertEqual(lichtmc("resume", out, "--quiet").returncode, 0)
            self.assert_same(whole, out)

    def test_a_signal_to_one_rank_ends_the_run_of_all_with_results(self):
        whole = self.reference()
        for rank in (0, 1):
            out = self.folder / f"out{rank}"
            job, pids = self.start_ranks(out)
            os.kill(pids[rank], signal.SIGTERM)
            self.assertEqual(job.wait(60), 0)
            self.assertEqual(json.loads((out / "summary.json").read_text())["stopped_by"], "interrupt")
            self.assertEqual(lichtmc("resume", out, "--quiet").returncode, 0)
            self.assert_same(whole, out)


if __name__ == "__main__":
    unittest.main()
