"""Functions of our own, each with the constructs of other people's programs: a certificate of each is verified."""

import pathlib
import shutil
import tempfile
import unittest

from support import ROOT, run

FUNCTIONS = ROOT / "tests" / "lift" / "functions"
# Amplitude, band in rad/sample and noise.
CERTIFIED = {
    "motor_pll.c": (1, [0.02, 0.3], 0.01),
    "lock_counter.c": (1, [0.28, 0.32], 0.001),
    "fast_arc_tangent.c": (1, [0.1, 0.3], 0.01),
    "kalman_notch.c": (1, [0.599, 0.601], 0.001),
    "optional_result.cpp": (1, [0.2, 0.3], 0.01),
    "chosen_detector.cpp": (1, [0.28, 0.32], 0.001),
    "delay_line.cpp": (1, [0.3, 0.32], 0.001),
}
# Loops with a state that nothing draws to one value: the phase of an oscillator that runs free, and the difference of two
# integrals of the same input.
NEUTRAL = {
    "double_literals.c": (1, [0.1, 0.12], 0.001, "f.theta"),
    "template_loop.cpp": (0.4, [0.19, 0.21], 0.001, "integrals"),
}


class Functions(unittest.TestCase):
    def certified(self, name, amplitude, band, noise):
        """The document, which is verified."""
        with tempfile.TemporaryDirectory() as scratch:
            folder = pathlib.Path(scratch)
            shutil.copy(FUNCTIONS / name, folder)
            design = folder / "design.toml"
            design.write_text(f"name = '{name}'\ntracker = 'model'\n[code]\nfiles = ['{name}']\n"
                              f"[assume]\namplitude = {amplitude}\nfrequency = {band}\nnoise = {noise}\n")
            result = run("certify", design, "--out", folder / "out")
            self.assertEqual(result.returncode, 0, result.stderr)
            self.assertIn("\nVERIFIED by", "\n" + result.stdout + result.stderr)
            return (folder / "out" / "certificate.md").read_text()

    def test_each_is_certified(self):
        for name, (amplitude, band, noise) in CERTIFIED.items():
            with self.subTest(name):
                self.assertTrue("**PROVED**" in self.certified(name, amplitude, band, noise), "nothing is proved")

    def test_what_nothing_draws_back_is_named(self):
        for name, (amplitude, band, noise, state) in NEUTRAL.items():
            with self.subTest(name):
                text = self.certified(name, amplitude, band, noise)
                self.assertFalse("**PROVED**" in text)
                self.assertRegex(text, rf"each sample multiplies errors by 1, .* in the mode 1 of [a-z_.\\]*{state}")


if __name__ == "__main__":
    unittest.main()
