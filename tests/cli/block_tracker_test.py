"""The tracker for blocks of samples: its map, and a recording on which its lock is true, false, or on nothing."""
import csv
import math
import random
import unittest

from support import CliTestCase

DESIGN = """name = "blocks"
tracker = "dft-block-ekf"
[design]
q1 = 5e-5
q2 = 1e-3
q3 = 2.5e-3
r = 0.003
block_length = 64
centre = 10
[assume]
offset = [0.25, 0.35]
noise = 0.0005
initial_amplitude_error = 0.001
initial_phase_error = 0.01
initial_offset_error = 0.002
"""


class BlockTracker(CliTestCase):
    def track(self, amplitude, *arguments):
        generator = random.Random(5)
        samples = [amplitude * math.cos(2 * math.pi * 10.3 / 64 * k + 1) + generator.gauss(0, 0.1) for k in range(64 * 60)]
        self.write("y\n" + "".join(f"{sample:.6f}\n" for sample in samples), "tone.csv")
        self.write(DESIGN)
        return self.run_here("track", "design.toml", "tone.csv", "--out", "run", *arguments)

    def test_a_recording_in_lock(self):
        result = self.track(1, "--strict")
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        self.assertIn("track.md: Kept lock.", result.stdout)
        self.assertTrue({"run/blocks.csv", "run/blocks.svg", "run/track.csv", "run/track.md"} <= set(self.files()))
        with open(self.folder / "run/blocks.csv", newline="", encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual(len(rows), 60)
        self.assertEqual({row["state"] for row in rows[19:]}, {"lock"})
        self.assertLess(float(rows[-1]["unexplained share"]), 0.1)
        self.assertAlmostEqual(float(rows[-1]["frequency [rad/sample]"]), 2 * math.pi * 10.3 / 64, delta=0.01)

    def test_a_false_lock_is_told(self):
        result = self.track(1, "--strict", "--start-frequency", f"{2 * math.pi * 9.35 / 64:.6f}")
        self.assertEqual(result.returncode, 1, result.stdout)
        self.assertRegex(result.stdout, r"track\.md: The lock is FALSE in \d+ of \d+ blocks, first in block \d+: ")
        self.assertRegex(result.stdout, r"explains 9\d(\.\d)? % of the power")

    def test_no_tone_is_no_false_lock(self):
        result = self.track(0, "--scale", "1")
        self.assertIn("No tone was seen", result.stdout)

    def test_a_design_without_blocks_has_no_recordings(self):
        self.write(DESIGN.replace("centre = 10\n", ""))
        self.write("y\n1\n", "tone.csv")
        result = self.run_here("track", "design.toml", "tone.csv")
        self.assertEqual(result.returncode, 2)
        self.assertIn("allowed: block_length = ... and centre = ... in [design]", result.stderr)

    def test_a_map_shows_true_and_false_locks(self):
        self.write(DESIGN)
        result = self.run_here("map", "design.toml", "--cells", "15", "--out", "map")
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        self.assertRegex(result.stdout, r"end on the tone, .* too low, .* too high; proved: 2 false locks\n$")
        text = (self.folder / "map/map.md").read_text(encoding="utf-8")
        self.assertIn("**REFUTED**: In exact arithmetic, the block tracker", text)
        self.assertEqual(text.count("**PROVED**"), 3)
        self.assertIn("*Sampled*", text)
        with open(self.folder / "map/starts.csv", newline="", encoding="utf-8") as file:
            ends = [row["ends"] for row in csv.DictReader(file)]
        self.assertEqual(len(ends), 15 * 11)
        self.assertTrue({"lock", "below", "above"} <= set(ends))


if __name__ == "__main__":
    unittest.main()
