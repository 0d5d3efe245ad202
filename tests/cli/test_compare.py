"""lichtmc compare: output and exit status."""
import json
import unittest

from support import SCENES, ProgramTest, lichtmc

CUBE = SCENES / "cube_paper.gltf"


class Compare(ProgramTest):
    def result(self, name, *options):
        out = self.folder / name
        done = lichtmc("run", CUBE, "-o", out, "--photons", "200k", "--tile", "0.25", "--quiet", "--no-report", *options)
        self.assertEqual(done.returncode, 0, done.stderr)
        return out

    def test_agreement_and_disagreement(self):
        one = self.result("one", "--seed", "1")
        for name, options in (("two", ()), ("walked", ("--tiles", "backward")), ("integrated", ("--direct", "analytic"))):
            other = self.result(name, "--seed", "2", *options)
            done = lichtmc("compare", one, other)
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
            self.assertIn("96 compared", done.stdout)
            self.assertIn("They agree", done.stdout)
        dark = self.result("dark", "--reflectance", "wall=0.5")
        done = lichtmc("compare", one, dark)
        self.assertEqual(done.returncode, 1)
        self.assertIn("They disagree", done.stdout)
        self.assertIn("column", done.stdout)
        done = lichtmc("compare", one, dark, "--json", "--worst", "2")
        self.assertEqual(done.returncode, 1)
        comparison = json.loads(done.stdout)[0]
        self.assertFalse(comparison["agree"])
        self.assertEqual(len(comparison["worst"]), 2)
        self.assertLess(comparison["relative_difference"], -0.05)

    def test_results_that_cannot_be_compared(self):
        one = self.result("one")
        done = lichtmc("compare", one, self.folder / "missing")
        self.assertEqual(done.returncode, 2)
        self.assertIn("summary.json", done.stderr)
        self.assertEqual(lichtmc("compare", one).returncode, 2)

    def test_invalid_combinations_of_options(self):
        for options, word in ((("--tiles", "backward", "--direct", "sampled"), "--direct"),
                              (("--tiles", "sideways"), "sideways"), (("--direct", "guessed"), "guessed")):
            done = lichtmc("run", CUBE, "-o", self.folder / "x", "--no-report", *options)
            self.assertEqual(done.returncode, 2)
            self.assertIn(word, done.stderr)


if __name__ == "__main__":
    unittest.main()
