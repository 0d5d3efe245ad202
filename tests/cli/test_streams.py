"""What is printed reaches its reader or the program says so; names cannot command a terminal or look like messages."""
import csv
import json
import os
import re
import signal
import subprocess
import unicodedata
import unittest

from support import PROGRAM, SCENES, ProgramTest, lichtmc, triangle_room

CUBE = SCENES / "cube_paper.gltf"
FAST = ("--photons", "50k", "--tile", "0.25", "--no-report", "--quiet")

NAMES = ("line\nfeed", "carriage\rreturn", "Warning: none\nWarning: two", "\x1b[2J\x1b]0;title\x07", "quote \"inside\"", "comma, semi; tab\t",
         "c1 \x9b2J", "del\x7f", "separator\u2028\u2029", "left \u202eright\u2066", " blank ends ", "zero\x00byte", "W\u00e4nde \u5e8a")


class Stdout(ProgramTest):
    def setUp(self):
        super().setUp()
        self.one, self.two = self.folder / "one", self.folder / "two"
        for seed, out in (("1", self.one), ("2", self.two)):
            self.assertEqual(lichtmc("run", CUBE, "-o", out, "--seed", seed, *FAST).returncode, 0)
        self.commands = (("check", CUBE), ("check", CUBE, "--json"), ("compare", self.one, self.two), ("compare", self.one, self.two, "--json"),
                         ("--version",), ("--help",), ("run", "--help"))

    def test_a_full_or_closed_stdout_is_a_failure_with_a_message(self):
        for command in self.commands:
            with self.subTest(command=command):
                words = [PROGRAM, *map(str, command)]
                with open("/dev/full", "w") as full:
                    done = subprocess.run(words, stdout=full, stderr=subprocess.PIPE, text=True, check=False)
                self.assertEqual(done.returncode, 1, done.stderr)
                self.assertIn("lichtmc: Cannot write to stdout (No space left on device)", done.stderr)
                done = subprocess.run(words, stderr=subprocess.PIPE, text=True, check=False, preexec_fn=lambda: os.close(1))
                self.assertEqual(done.returncode, 1, done.stderr)
                self.assertIn("lichtmc: Cannot write to stdout (Bad file descriptor)", done.stderr)

    def test_a_reader_that_has_ended_ends_the_program_quietly(self):
        for command in self.commands:
            with self.subTest(command=command):
                reading, writing = os.pipe()
                os.close(reading)
                done = subprocess.run([PROGRAM, *map(str, command)], stdout=writing, stderr=subprocess.PIPE, text=True, check=False)
                os.close(writing)
                self.assertEqual((done.returncode, done.stderr), (-signal.SIGPIPE, ""))

    def test_a_run_whose_messages_nobody_reads_writes_its_results(self):
        reading, writing = os.pipe()
        os.close(reading)
        out = self.folder / "unread"
        done = subprocess.run([PROGRAM, "run", CUBE, "-o", out, *FAST[:-1]], stdout=writing, stderr=writing, check=False)
        os.close(writing)
        self.assertEqual(done.returncode, 0)
        self.assertEqual((out / "tiles.csv").read_bytes(), (self.one / "tiles.csv").read_bytes())
        # With closed streams too, and no file takes their place.
        closed = self.folder / "closed"
        done = subprocess.run([PROGRAM, "run", CUBE, "-o", closed, *FAST[:-1]], check=False, preexec_fn=lambda: os.closerange(0, 3))
        self.assertEqual(done.returncode, 0)
        self.assertEqual((closed / "tiles.csv").read_bytes(), (self.one / "tiles.csv").read_bytes())
        self.assertEqual(lichtmc("resume", closed, "--quiet").returncode, 0)


def dangerous(text):
    """Characters that a terminal obeys, except line ends and tabs."""
    bidi = "\u061c\u200e\u200f\u202a\u202b\u202c\u202d\u202e\u2066\u2067\u2068\u2069"
    return [c for c in text if (unicodedata.category(c) in ("Cc", "Zl", "Zp") and c not in "\n\t") or c in bidi]


class Names(ProgramTest):
    def room(self):
        document = triangle_room()
        for k, name in enumerate(NAMES):
            document["materials"].append({"name": "material " + name, "extras": {"reflectance": 0.5, "Reflectance": 2}})
            document["meshes"].append({"name": "mesh " + name, "primitives": [{"attributes": {"POSITION": 0}, "material": k + 1}]})
            document["nodes"].append({"name": name, "mesh": k + 1, "translation": [0, -0.1 * (k + 1), 0]})
            document["nodes"].append({"name": "lamp " + name, "translation": [0.2, -0.1 * k - 0.05, 0.2], "extras": {"lambert_exponent": 1, "power": 10, "unit": "lm"}})
            document["scenes"][0]["nodes"] += [len(document["nodes"]) - 2, len(document["nodes"]) - 1]
        document["scenes"][0]["name"] = "scene " + NAMES[0]
        document["extensionsUsed"].append("EXT_" + NAMES[3])
        return self.write_gltf(document, "room \x1b[31m\nred.gltf")

    def printed(self, *arguments, status=0):
        done = lichtmc(*arguments)
        self.assertEqual(done.returncode, status, done.stderr)
        self.assertEqual(dangerous(done.stdout), [], arguments)
        self.assertEqual(dangerous(done.stderr), [], arguments)
        for line in (done.stdout + done.stderr).splitlines():
            self.assertNotRegex(line, "^(Warning: two|red.gltf|feed)")  # second lines of names
        return done.stdout

    def test_names_are_printed_visibly_and_survive_in_the_files(self):
        room = self.room()
        self.printed("check", room)
        inspection = json.loads(self.printed("check", room, "--json"))
        self.assertLessEqual(set(NAMES), {surface["name"] for surface in inspection["surfaces"]})
        outs = [self.folder / "o\x1b[1mne", self.folder / "two"]
        for seed, out in enumerate(outs):
            self.printed("run", room, "-o", out, "--seed", seed, "--photons", "50k", "--tile", "0.5")
            with open(out / "tiles.csv", newline="", encoding="utf-8") as file:
                self.assertLessEqual(set(NAMES), {row["surface"] for row in csv.DictReader(file)})
            summary = json.loads((out / "summary.json").read_text(encoding="utf-8"))
            self.assertLessEqual(set(NAMES), {surface["name"] for surface in summary["surfaces"]})
            self.assertEqual(dangerous("".join(path.name for path in (out / "tiles").iterdir())), [])
            page = re.sub("(?s)<script.*?</script>", "", (out / "report.html").read_text(encoding="utf-8"))
            self.assertEqual([c for c in dangerous(page) if c != "\r"], [])
        self.printed("compare", *outs)
        json.loads(self.printed("compare", *outs, "--json"))
        self.printed("paths", room, "-o", self.folder / "paths", "--photons", "3")
        # Messages of errors: an unknown material lists those of the room.
        for words in (("run", room, "--reflectance", "none=0.5"), ("run", self.folder / "no\nroom\x1b.glb"), ("run", room, "--none\x1b[1m"), ("w\x1balk",)):
            self.printed(*words, status=2)

    def test_names_of_receivers_survive_a_table_of_a_run(self):
        names = [name for name in NAMES if name.strip(" ") == name] + [" blank ends "]
        table = self.folder / "points.csv"
        with open(table, "w", newline="", encoding="utf-8") as file:
            writer = csv.writer(file, quoting=csv.QUOTE_ALL)
            writer.writerow(["name", "X (m)", "z", "y", "nx", "ny", "nz", "level"])
            writer.writerows([name, 0.1 * (k + 1) / len(names), 0.5, 0.25, 0, 1, 0, "E1"] for k, name in enumerate(names))
        options = ("--only", "receivers", "--photons", "20k", "--no-report")
        done = lichtmc("run", CUBE, "-o", self.folder / "one", "--receivers", table, *options)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(dangerous(done.stderr), [])
        self.assertEqual(done.stderr.count("Note: "), 1)
        self.assertIn("'level'", done.stderr)
        first = self.folder / "one" / "receivers.csv"
        with open(first, newline="", encoding="utf-8") as file:
            self.assertEqual([row["name"] for row in csv.DictReader(file)], names)
        # The table of the results is a table of receivers, also from stdin.
        with open(first, encoding="utf-8", newline="") as file:
            done = lichtmc("run", CUBE, "-o", self.folder / "two", "--receivers", "-", *options, stdin=file)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual((self.folder / "two" / "receivers.csv").read_bytes(), first.read_bytes())
        self.printed("compare", self.folder / "one", self.folder / "two")

    def test_tables_that_are_no_tables(self):
        os.mkfifo(self.folder / "pipe")
        for source in ("/dev/zero", self.folder / "pipe", self.folder, self.folder / "none.csv"):
            self.refused("run", CUBE, "-o", self.folder / "out", "--receivers", source, says=["Cannot read", str(source), "--receivers -"])


if __name__ == "__main__":
    unittest.main()
