"""veritrack map for a recursion of the user's own: proved cells, the documents, and what is refused."""

import csv
import json
import re
import unittest
import xml.etree.ElementTree

from support import DESIGN, CliTestCase

LOOP = """\
name = "a loop"
tracker = "model"

[model]
samples = 'y'
parameters = { wn = 0.08, zeta = 0.7071, ki = 'wn^2', kp = '2*zeta*wn' }
states = ['theta', 'w']
angles = ['theta']
step = '''
e      = -2*y*sin(theta + w)
w'     = w + ki*e
theta' = theta + w + kp*e
'''
frequency = 'w'
start = { theta = 0, w = 'omega' }

[assume]
amplitude = 1
frequency = [1.0, 1.2]
noise = 0.02
"""
FEW = ("--cells", "5", "--x-range", "0.5", "--y-range", "0.05")


class ModelMap(CliTestCase):
    def cells(self, folder):
        with open(self.folder / folder / "region.csv", newline="") as file:
            return list(csv.DictReader(file))

    def test_a_root_locus_is_written(self):
        self.write(LOOP)
        result = self.run_here("map", "design.toml", "--over", "zeta=0.1:3", "--out", "locus")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(result.stdout, "locus/root-locus.md: not proved: stable for zeta from 0.1 to 3\n")
        self.assertEqual(self.files(), [f"locus/{name}" for name in ("root-locus.csv", "root-locus.md", "root-locus.svg")])
        xml.etree.ElementTree.parse(self.folder / "locus" / "root-locus.svg")
        for options, words in ((("--over", "zeta"), "NAME=LOW:HIGH"), (("--over", "nothing=1:2"), "allowed: wn, zeta, ki, kp"),
                               (("--over", "zeta=0.1:3", "--cells", "3"), "--out, --html")):
            result = self.run_here("map", "design.toml", *options)
            self.assertEqual(result.returncode, 2)
            self.assertIn(words, result.stderr)

    def test_a_map_is_written(self):
        self.write(LOOP)
        result = self.run_here("map", "design.toml", *FEW)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(result.stderr, "")
        self.assertEqual(result.stdout.split(":")[0], "maps-out/design/map.md")
        self.assertEqual(self.files(), ["maps-out/design/.design"] +
                         [f"maps-out/design/{name}" for name in ("map.json", "map.md", "region.csv", "region.svg")])
        cells = self.cells("maps-out/design")
        self.assertEqual(len(cells), 25)
        proved = [cell for cell in cells if cell["verdict"] == "PROVED"]
        self.assertGreaterEqual(len(proved), 5)
        for cell in cells:
            self.assertIn(cell["verdict"], ("PROVED", "UNDECIDED"))
            self.assertEqual(cell["samples"] != "", cell["verdict"] == "PROVED")
        for cell in proved:  # a proved start locks in simulation, too
            self.assertEqual(cell["simulated_locks"], cell["simulated_phases"])
        middle = cells[12]
        self.assertEqual((middle["verdict"], float(middle["x_low"])), ("PROVED", -float(middle["x_high"])))
        # The answer first, with the number of cells and the hypotheses.
        document = (self.folder / "maps-out/design/map.md").read_text()
        self.assertRegex(document, rf"\A# [0-9.]+ % of the starts are PROVED to lock \({len(proved)} of 25 cells\)\n")
        self.assertIn("**PROVED**: In exact arithmetic, on a tone of amplitude 1 with the constant frequency 1.1 rad/sample",
                      document)
        self.assertIn("at any phase of the signal", document)
        self.assertIn(f"{max(int(cell['samples']) for cell in proved)} samples are enough", document)
        numbers = json.loads((self.folder / "maps-out/design/map.json").read_text())
        self.assertEqual(len(numbers["proved"]), len(proved))
        self.assertEqual((numbers["x"]["state"], numbers["y"]["state"]), ("theta", "w"))
        self.assertEqual(len(numbers["x"]["ends"]), 6)
        self.assertEqual(float.fromhex(numbers["x"]["ends"][-1]), 0.5)
        root = xml.etree.ElementTree.parse(self.folder / "maps-out/design/region.svg").getroot()
        self.assertTrue(root.tag.endswith("svg"))

    def test_same_input_same_bytes(self):
        self.write(LOOP)
        for folder in ("one", "two"):
            self.run_here("map", "design.toml", *FEW, "--out", folder)
        for name in ("map.md", "map.json", "region.svg", "region.csv"):
            self.assertEqual((self.folder / "one" / name).read_bytes(), (self.folder / "two" / name).read_bytes())

    def test_a_map_that_is_stopped_proves_only_what_is_finished(self):
        self.write(LOOP)
        result = self.run_here("map", "design.toml", *FEW, "--timeout", "0.001")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("stopped before the end", result.stdout)
        document = (self.folder / "maps-out/design/map.md").read_text()
        self.assertRegex(document, r"\n\*Stopped before the end\*: \d+ cells were not followed to an answer")
        self.assertEqual({cell["verdict"] for cell in self.cells("maps-out/design")}, {"UNDECIDED"})

    def test_noise_and_frequency_are_in_the_sentence(self):
        self.write(LOOP)
        result = self.run_here("map", "design.toml", "--cells", "3", "--x-range", "0.2", "--y-range", "0.01",
                               "--noise", "--at", "1.05")
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
        document = (self.folder / "maps-out/design/map.md").read_text()
        self.assertIn("the constant frequency 1.05 rad/sample, with noise of at most 0.02 at every sample", document)

    def test_what_does_not_fit_is_refused(self):
        self.write(LOOP)
        for options, message in {
                ("--at", "2"): r"design.toml:\d+:\d+: --at 2: not in the assumed band; allowed: 1 to 1.2",
                ("--at", "fast"): "--at fast: no number",
                ("--x", "thet"): r"--x thet: no such state; nearest: theta; allowed: theta, w",
                ("--x", "w", "--y", "w"): "both w",
                ("--x-range", "0"): "x-range",
                ("--x-range", "nan"): "x-range",
                ("--cells", "0"): "cells",
                ("--phase", "1"): r"--phase cannot be used with the tracker model; allowed: --over, --at, --x, ",
        }.items():
            with self.subTest(options=options):
                result = self.run_here("map", "design.toml", *options)
                self.assertEqual(result.returncode, 2, result.stdout)
                self.assertRegex(result.stderr, message)
                self.assertEqual(self.files(), [])
        self.write(LOOP.replace("amplitude = 1", "amplitude = { constant = [0.9, 1.1] }"), "range.toml")
        result = self.run_here("map", "range.toml")
        self.assertEqual(result.returncode, 2)
        self.assertRegex(result.stderr, r"range.toml:18:\d+: a constant amplitude in a range: a map is for the tubes of "
                                        "one part of the range; allowed: one amplitude")
        self.write(DESIGN, "other.toml")
        result = self.run_here("map", "other.toml", "--at", "1")
        self.assertEqual(result.returncode, 2)
        self.assertRegex(result.stderr, r"other.toml:2:\d+: --at cannot be used with the tracker quadrature-ekf; "
                                        "allowed: --frequency, --phase, --noise")

    def test_more_than_four_states(self):
        states = ["a", "b", "c", "d", "w"]
        lines = "\n".join(f"{state}' = 0.5*{state}" for state in states[:4])
        self.write(LOOP.split("[model]")[0] + f"""\
[model]
samples = 'y'
parameters = {{ }}
states = {states}
step = '''
{lines}
w' = w + 0.1*y*a
'''
frequency = 'w'
start = {{ a = 0, b = 0, c = 0, d = 0, w = 'omega' }}
""" + "[assume]" + LOOP.split("[assume]")[1])
        result = self.run_here("map", "design.toml")
        self.assertEqual(result.returncode, 2, result.stdout)
        self.assertRegex(result.stderr, r"design.toml:\d+:\d+: 5 states; a map follows starts of at least 2 and at "
                                        "most 4 states")

    def test_no_tube(self):
        self.write(LOOP.replace("noise = 0.02", "noise = 5"))
        result = self.run_here("map", "design.toml", "--noise", "--cells", "1")
        self.assertEqual(result.returncode, 1, result.stderr)
        self.assertTrue(re.search("undecided: no tube is proved", result.stdout), result.stdout)
        self.assertEqual(self.files(), [])


if __name__ == "__main__":
    unittest.main()
