"""lichtmc run --impulse-response: options, refusals, properties of the room, and the files of the results."""
import json
import unittest

from support import ProgramTest, lichtmc, triangle_room

FEW = ("--photons", "2000", "--no-report", "--quiet")
BINS = ("--impulse-response", "1ns")


class Options(ProgramTest):
    def setUp(self):
        super().setUp()
        self.room = self.folder / "room.glb"
        done = lichtmc("cuboid", "--size", 5, 3, 5, "--reflectance", 0.5, "--light", "point:2.5,2.5,2.5:1W", "-o", self.room)
        self.assertEqual(done.returncode, 0, done.stderr)

    def refuse(self, *options, says, receivers=("--grid", "1")):
        self.refused("run", self.room, "-o", self.folder / "out", *FEW, *receivers, *options, says=says)
        self.assertFalse((self.folder / "out").exists())

    def test_options_that_need_the_width_of_a_bin(self):
        for options in (("--time-span", "100ns"), ("--orders", "2"), ("--per-emitter",), ("--frequencies", "0:1MHz:1MHz"),
                        ("--squared-weights",), ("--delay", "*=5ns")):
            with self.subTest(options=options):
                self.refuse(*options, says=[f"{options[0]} is given without --impulse-response", f"leave out {options[0]}"])

    def test_widths_and_time_spans(self):
        for width in ("1", "ns", "1 ns", "1e-9", "0.1km", "1min", "1e400ns", "-"):
            with self.subTest(width=width):
                self.refuse("--impulse-response=" + width, says=["--impulse-response", "0.2ns or 0.1m"])
        for width in ("0ns", "-1ns", "0m"):
            with self.subTest(width=width):
                self.refuse("--impulse-response=" + width, says=["width of a bin", "above 0"])
        self.refuse(*BINS, "--time-span", "0.9ns", says=["time span", "at least the width of a bin", "--time-span"])
        self.refuse(*BINS, "--time-span", "0.2998", says=["--time-span", "0.2ns or 0.1m"])
        self.refuse(*BINS, "--time-span", "1s", says=["up to 2^24 bins"])

    def test_orders_and_frequencies(self):
        for orders in ("65", "-1", "1.5", "all"):
            with self.subTest(orders=orders):
                self.refuse(*BINS, "--orders=" + orders, says=["--orders", "0 to 64"])
        for frequencies in ("1MHz", "0:1MHz", "0:1MHz:1MHz:1MHz", "0:1THz:1GHz", "0:x:1MHz", "::", "0:1MHz:0"):
            with self.subTest(frequencies=frequencies):
                self.refuse(*BINS, "--frequencies=" + frequencies, says=["--frequencies", "0:400MHz:1MHz"])
        self.refuse(*BINS, "--frequencies=-1MHz:1MHz:1MHz", says=["first 0 or more"])
        self.refuse(*BINS, "--frequencies=2MHz:1MHz:1kHz", says=["last not below it"])
        self.refuse(*BINS, "--frequencies=0:1GHz:1kHz", says=["more than 100000", "greater step"])

    def test_receivers_are_needed(self):
        self.refuse(*BINS, receivers=(), says=["no receiver", "impulse responses", "--receivers or --grid"])
        self.refuse(*BINS, "--only", "tiles", says=["only tiles are measured", "Leave out --only tiles"])

    def test_delays(self):
        self.refuse(*BINS, "--delay", "lamp=5ns", says=["no emitter 'lamp'", "'point:2.5,2.5,2.5:1W'"])
        self.refuse(*BINS, "--delay", "5ns", says=["EMITTER=T", "lamp=5ns"])
        for delay in ("5", "5m", "x"):
            with self.subTest(delay=delay):
                self.refuse(*BINS, "--delay", "point*=" + delay, says=["--delay", "a time with its unit"])
        self.refuse(*BINS, "--delay", "point*=-1ns", says=["0 or more", "from the earliest"])


class Rooms(ProgramTest):
    def check(self, document):
        room = self.write_gltf(document)
        facts = lichtmc("check", room)
        self.assertEqual(facts.returncode, 0, facts.stderr)
        found = lichtmc("check", room, "--json")
        return facts.stdout, json.loads(found.stdout)

    def test_check_shows_delays_and_optics(self):
        document = triangle_room()
        document["nodes"][1]["extras"] = {"delay_ns": 7.3}
        document["nodes"].append({"name": "eye", "translation": [0.2, 0.5, 0.2], "rotation": [0.5**0.5, 0, 0, 0.5**0.5],
                                  "extras": {"receiver": {"area": 1e-4, "fov": 30, "concentrator_index": 1.5, "filter_gain": 0.5}}})
        document["scenes"][0]["nodes"].append(2)
        text, facts = self.check(document)
        self.assertIn("lm, delay 7.3 ns\n", text)
        self.assertIn("  eye: 0.0001 m^2, 30 degrees, concentrator of index 1.5, filter gain 0.5; optical gain 4.5\n", text)
        self.assertEqual(facts["emitters"][0]["delay_ns"], 7.3)
        self.assertEqual(facts["receivers"][0]["concentrator_index"], 1.5)
        self.assertEqual(facts["receivers"][0]["filter_gain"], 0.5)

    def test_plain_rooms_show_neither(self):
        document = triangle_room()
        document["nodes"].append({"name": "eye", "translation": [0.2, 0.5, 0.2], "extras": {"receiver": {}}})
        document["scenes"][0]["nodes"].append(2)
        text, facts = self.check(document)
        self.assertNotIn("delay", text)
        self.assertNotIn("Receivers (", text)
        self.assertEqual(facts["emitters"][0]["delay_ns"], 0.0)
        self.assertIsNone(facts["receivers"][0]["concentrator_index"])
        self.assertEqual(facts["receivers"][0]["filter_gain"], 1.0)

    def test_misplaced_properties_are_warned_about(self):
        document = triangle_room()
        document["nodes"][0]["extras"] = {"delay_ns": 5}
        text, _ = self.check(document)
        self.assertIn("'delay_ns' of node 'floor': nothing of this node emits light", text)
        document = triangle_room()
        document["nodes"][1]["extras"] = {"delay": 5}
        text, _ = self.check(document)
        self.assertIn("the name is 'delay_ns'", text)

    def test_values_out_of_range_are_refused(self):
        for value in (-1, "5", None):
            document = triangle_room()
            document["nodes"][1]["extras"] = {"delay_ns": value}
            self.refused("run", self.write_gltf(document), "-o", self.folder / "out", says=["'delay_ns' of node 'lamp'"])


if __name__ == "__main__":
    unittest.main()
