"""lichtmc run --impulse-response: options, refusals, properties of the room, and the files of the results."""
import csv
import json
import math
import os
import subprocess
import unittest

from support import PROGRAM, ProgramTest, lichtmc, triangle_room

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
        for options in (("--time-span", "100ns"), ("--orders", "2"), ("--frequencies", "0:1MHz:1MHz"),
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


    def test_memory(self):
        self.refuse(*BINS[:1], "1ps", "--time-span", "10us", "--orders", "9", receivers=("--grid", "1", "--grid-spacing", "0.1"),
                    says=["2500 receivers", "11 orders", "10000000 bins", "GB of memory", "--impulse-response a greater width", "--orders"])
        done = lichtmc("run", self.room, "-o", self.folder / "out", "--grid", "1", "--only", "receivers", *BINS, "--no-report", "--photons", "1000")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertRegex(done.stderr, r"Note: the impulse responses need about \d+ MB of memory")


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


LAMPS = ("point:1,2.5,1:1W", "lambert:4,3,4:0,-1,0:1:3W")
FILES = ("channels.csv", "channels.h5", "channels.mat", "impulse_response.csv")
NANOSECOND = 1e-9


def table(path):
    with open(path, newline="") as file:
        return list(csv.DictReader(file))


class Results(ProgramTest):
    def setUp(self):
        super().setUp()
        self.room = self.folder / "room.glb"
        lights = [word for lamp in LAMPS for word in ("--light", lamp)]
        done = lichtmc("cuboid", "--size", 5, 3, 5, "--reflectance", 0.6, *lights, "-o", self.room)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.points = self.folder / "points.csv"
        self.points.write_text("name,x,y,z,nx,ny,nz,area,fov,concentrator_index\neye,2,0.8,3,0,1,0,1e-4,60,1.5\nwall,0,1,2,1,0,0,2e-4,85,\n")
        self.common = ("--receivers", self.points, "--only", "receivers", "--impulse-response", "1ns", "--time-span", "50ns", "--no-report")

    def run_room(self, *options, out="out", photons=("--photons", "20480")):
        folder = self.folder / out
        done = lichtmc("run", self.room, "-o", folder, *self.common, *photons, *options)
        self.assertEqual(done.returncode, 0, done.stderr)
        return folder

    def responses(self, folder):
        """h by emitter, receiver and order: a list of bins."""
        found = {}
        for row in table(folder / "impulse_response.csv"):
            found.setdefault((row["emitter"], row["receiver"], row["order"]), []).append(float(row["h"]))
        return found

    def same(self, one, other):
        for name in ("impulse_response.csv", "channels.csv", "receivers.csv"):
            self.assertEqual((one / name).read_bytes(), (other / name).read_bytes(), name)

    def test_files_and_gains(self):
        out = self.run_room("--orders", "2", "--squared-weights")
        self.assertEqual(sorted(p.name for p in out.iterdir()), sorted((*FILES, "emitters.csv", "receivers.csv", "state.h5", "summary.json")))
        rows = table(out / "impulse_response.csv")
        self.assertEqual(list(rows[0]), ["emitter", "receiver", "order", "time_s", "h", "standard_error"])
        found = self.responses(out)
        self.assertEqual(sorted(found), sorted(("all", eye, order) for eye in ("eye", "wall") for order in ("0", "1", "2", "3+", "all")))
        times = [float(row["time_s"]) for row in rows[:50]]
        for k, time in enumerate(times):
            self.assertAlmostEqual(time / NANOSECOND, k + 0.5, places=9)
        channels = table(out / "channels.csv")
        receivers = table(out / "receivers.csv")
        summary = json.loads((out / "summary.json").read_text())
        self.assertEqual(len(summary["channels"]), 2)
        for channel, receiver in zip(channels, receivers):
            self.assertEqual((channel["emitter"], channel["receiver"]), ("all", receiver["name"]))
            gain = float(channel["gain"])
            self.assertTrue(math.isclose(gain, float(receiver["gain"]), rel_tol=1e-15))
            in_bins = sum(found["all", receiver["name"], "all"]) * NANOSECOND
            self.assertTrue(math.isclose(in_bins + float(channel["beyond_time_span"]), gain, rel_tol=1e-9))
            for bin, h in enumerate(found["all", receiver["name"], "all"]):
                parts = sum(found["all", receiver["name"], order][bin] for order in ("0", "1", "2", "3+"))
                self.assertTrue(math.isclose(parts, h, rel_tol=1e-9, abs_tol=1e-9 * gain / NANOSECOND))
            self.assertEqual(channel["first_arrival"], "exact")
            self.assertGreater(float(channel["squared_rms_delay_spread_s"]), 0)
            self.assertGreater(float(channel["rms_delay_spread_s_standard_error"]), 0)
        # E · A · n²/sin² 60°
        self.assertTrue(math.isclose(float(receivers[0]["gain"]), float(receivers[0]["irradiance"]) * 1e-4 * 2.25 / 0.75 / 4, rel_tol=1e-12))
        self.assertTrue(math.isclose(float(receivers[1]["gain"]), float(receivers[1]["irradiance"]) * 2e-4 / 4, rel_tol=1e-12))

    def test_a_run_without_the_option_has_no_such_files(self):
        out = self.run_room()
        self.assertTrue(all((out / name).exists() for name in FILES))
        done = lichtmc("run", self.room, "-o", out, "--receivers", self.points, "--only", "receivers", *FEW)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(sorted(p.name for p in out.iterdir()), ["emitters.csv", "receivers.csv", "state.h5", "summary.json"])
        self.assertFalse(json.loads((out / "summary.json").read_text()).get("channels"))

    def test_estimator(self):
        summary = json.loads((self.run_room() / "summary.json").read_text())
        self.assertEqual(summary["receiver_walk"]["estimator"], "weight")

    def test_a_length_is_a_time(self):
        self.common = tuple("0.299792458m" if word == "1ns" else word for word in self.common)
        metre = self.responses(self.run_room(out="metre"))
        self.common = tuple("1000ps" if word == "0.299792458m" else word for word in self.common)
        for key, bins in self.responses(self.run_room(out="picoseconds")).items():
            for one, other in zip(bins, metre[key]):
                self.assertTrue(math.isclose(one, other, rel_tol=1e-9))

    def test_emitters_add_up_and_delays_shift(self):
        together = self.responses(self.run_room())
        apart = self.responses(self.run_room("--per-emitter", out="apart"))
        late = self.responses(self.run_room("--per-emitter", "--delay", "lambert*=7ns", out="late"))
        self.assertEqual(sorted({emitter for emitter, _, _ in apart}), sorted(LAMPS))
        for eye in ("eye", "wall"):
            for order in ("0", "1+", "all"):
                one, three = (apart[lamp, eye, order] for lamp in LAMPS)
                highest = max(together["all", eye, order])
                for h, a, b in zip(together["all", eye, order], one, three):
                    self.assertTrue(math.isclose(h, (a + 3 * b) / 4, rel_tol=1e-9, abs_tol=1e-9 * highest))
                self.assertEqual(late[LAMPS[0], eye, order], one)
                for before, after in zip([0.0] * 7 + three, late[LAMPS[1], eye, order]):
                    self.assertTrue(math.isclose(before, after, rel_tol=1e-9))
        summary = json.loads((self.folder / "late" / "summary.json").read_text())
        self.assertTrue(any("delay set to 7 ns" in text for text in summary["mended"]))
        self.assertEqual([emitter["delay_ns"] for emitter in summary["emitters"]], [0, 7])

    def test_parts_make_the_whole(self):
        for walk in ("backward", "two-way"):
            with self.subTest(walk=walk):
                options = ("--orders", "1", "--per-emitter", "--frequencies", "0:20MHz:10MHz", "--squared-weights", "--receiver-walk", walk)
                whole = self.run_room(*options, out="whole" + walk, photons=("--histories", "0:40960"))
                parts = [self.run_room(*options, out=f"part{k}{walk}", photons=("--histories", f"{k * 20480}:{(k + 1) * 20480}")) for k in (0, 1)]
                done = lichtmc("merge", *reversed(parts), "-o", self.folder / ("merged" + walk))
                self.assertEqual(done.returncode, 0, done.stderr)
                self.same(whole, self.folder / ("merged" + walk))

    def test_parts_with_other_channels_do_not_belong_together(self):
        one = self.run_room("--orders", "1", out="one", photons=("--histories", "0:20480"))
        for options, says in ((("--orders", "2"), "--orders"), (("--orders", "1", "--per-emitter"), "--per-emitter"),
                              (("--orders", "1", "--frequencies", "0:1MHz:1MHz"), "--frequencies"),
                              (("--orders", "1", "--squared-weights"), "--squared-weights")):
            with self.subTest(options=options):
                other = self.run_room(*options, out="other", photons=("--histories", "20480:40960"))
                self.refused("merge", one, other, "-o", self.folder / "merged", says=[says])
        other = self.run_room("--orders", "1", "--delay", "point*=1ns", out="other", photons=("--histories", "20480:40960"))
        self.refused("merge", one, other, "-o", self.folder / "merged", says=["different rooms"])

    def test_resumed_and_on_several_threads_and_processes(self):
        options = ("--orders", "1", "--receiver-walk", "two-way")
        whole = self.run_room(*options, "--threads", "1", out="whole", photons=("--photons", "40960"))
        short = self.run_room(*options, "--threads", "2", out="short")
        done = lichtmc("resume", short, "--photons", "40960")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.same(whole, short)
        mpirun = os.environ.get("LICHTMC_MPIRUN")
        if mpirun:
            shared = self.folder / "shared"
            done = subprocess.run([mpirun, "--allow-run-as-root", "--oversubscribe", "-n", "2", PROGRAM, "run", self.room, "-o", shared, *self.common,
                                   "--photons", "40960", *options, "--threads", "1", "--quiet"], capture_output=True, text=True, check=False)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.same(whole, shared)

    def test_an_emitter_without_power_has_a_channel_without_figures(self):
        lights = ("--light", "point:2,2,2:0W")
        out = self.run_room("--per-emitter", *lights)
        rows = [row for row in table(out / "channels.csv") if row["emitter"] == lights[1]]
        self.assertEqual(len(rows), 2)
        for row in rows:
            self.assertIn(row["gain"], ("0", "nan"))
            self.assertEqual(row["rms_delay_spread_s"], "nan")


if __name__ == "__main__":
    unittest.main()
