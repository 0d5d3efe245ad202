"""What the program says of rooms that need much memory or time."""
import unittest

from support import PROGRAM, SCENES, ProgramTest, lichtmc, subprocess

LIVING_ROOM = SCENES / "living_room.glb"


class Memory(ProgramTest):
    """Limits of the address space stand for little memory. The runs are refused for their tiles, after the message."""

    def run_with(self, kilobytes, tile):
        limited = f"ulimit -v {kilobytes} && exec \"$0\" run \"$1\" --tile {tile} --photons 1000 -o \"$2\""
        return subprocess.run(["bash", "-c", limited, PROGRAM, LIVING_ROOM, self.folder / "out"], capture_output=True, text=True)

    def test_less_than_needed(self):
        done = self.run_with(1_200_000, 0.005)
        self.assertEqual(done.returncode, 2)
        self.assertRegex(done.stderr, r"Warning: The run needs about 1\.[3-9] GB of memory, but only 1(\.\d)? GB are free: .*"
                                      r"Give --tile a greater length")

    def test_much(self):
        done = lichtmc("run", LIVING_ROOM, "--tile", "0.001", "--photons", "1", "-o", self.folder / "out", "--no-report",
                       "--no-images", "--only", "receivers", "--max-time", "0.1s")
        self.assertRegex(done.stderr, r"(Note: the|Warning: The) run needs about \d+ GB of memory")

    def test_little_is_not_told(self):
        done = lichtmc("run", LIVING_ROOM, "--photons", "1000", "-o", self.folder / "out", "--no-report", "--no-images")
        self.assertNotIn("GB of memory", done.stderr)
        self.assertEqual(done.returncode, 0)

    def test_check(self):
        done = lichtmc("check", LIVING_ROOM)
        self.assertRegex(done.stdout, r"tiles, 2228 triangles: about \d+(\.\d)? MB of memory for a run of two threads")


if __name__ == "__main__":
    unittest.main()
