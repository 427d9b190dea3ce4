"""veritrack show: a recursion as formulas, and as code in C and Python that computes the same doubles."""
import ctypes
import math
import pathlib
import random
import subprocess
import tempfile
import tomllib
import unittest

from support import ROOT, run

DESIGNS = ROOT / "designs"
MODELS = sorted((DESIGNS / "models").glob("*.toml"))


def show(design, language):
    result = run("show", design, "--language", language)
    assert result.returncode == 0, result.stderr
    return result.stdout


class InC:
    """The step of a design, compiled."""

    def __init__(self, design, folder):
        source = pathlib.Path(folder) / "tracker.c"
        library = pathlib.Path(folder) / "tracker.so"
        source.write_text(show(design, "c"))
        subprocess.run(["cc", "-O2", "-Wall", "-Werror", "-ffp-contract=off", "-shared", "-fPIC", source, "-o", library,
                        "-lm"], check=True)
        self.library = ctypes.CDLL(str(library))
        self.library.tracker_frequency.restype = ctypes.c_double

    def step(self, state, sample):
        array = ctypes.c_double * len(state)
        following = array()
        self.library.tracker_step(array(*state), (ctypes.c_double * len(sample))(*sample), following)
        return tuple(following)

    def frequency(self, state):
        return self.library.tracker_frequency((ctypes.c_double * len(state))(*state))

    def start(self, count, amplitude, omega):
        state = (ctypes.c_double * count)()
        self.library.tracker_start(ctypes.c_double(amplitude), ctypes.c_double(omega), state)
        return tuple(state)


class Show(unittest.TestCase):
    def test_c_and_python_compute_the_same_doubles_along_a_noisy_run(self):
        self.assertTrue(MODELS)
        for design in MODELS:
            with self.subTest(design=design.name), tempfile.TemporaryDirectory() as folder:
                python = {}
                exec(show(design, "python"), python)  # pylint: disable=exec-used
                in_c = InC(design, folder)
                keys = tomllib.loads(design.read_text())
                frequency = keys["assume"]["frequency"]
                omega = 0.4 if not isinstance(frequency, dict) else \
                    2 * math.pi * sum(frequency["hz"]) / 2 / keys["assume"]["sample_rate"]
                state = python["tracker_start"](1.0, omega)
                self.assertEqual(in_c.start(len(state), 1.0, omega), tuple(state))
                channels = len(keys["model"]["samples"]) if isinstance(keys["model"]["samples"], list) else 1
                noise = random.Random(1)
                for k in range(300):
                    sample = [math.cos(omega * k), math.sin(omega * k)][:channels]
                    sample = [value + noise.gauss(0, 1e-3) for value in sample]
                    following = python["tracker_step"](state, sample)
                    self.assertEqual(in_c.step(state, sample), tuple(following))
                    self.assertEqual(in_c.frequency(following), python["tracker_frequency"](following))
                    state = following
                # It tracks: what was written down is the tracker that was meant.
                self.assertLess(abs(python["tracker_frequency"](state) - omega), 0.05)

    def test_formulas_can_be_read_again(self):
        for design in MODELS:
            with self.subTest(design=design.name):
                text = show(design, "formulas")
                self.assertIn("# step", text)
                self.assertIn("frequency = ", text)

    def test_other_trackers_and_languages_are_refused(self):
        other = next(DESIGNS.glob("*.toml"))
        result = run("show", other)
        self.assertEqual(result.returncode, 2)
        self.assertIn("allowed: model", result.stderr)
        self.assertEqual(run("show", MODELS[0], "--language", "fortran").returncode, 2)

    def test_a_formula_that_is_wrong_is_told_with_its_place(self):
        text = (DESIGNS / "models" / "sogi-fll.toml").read_text()
        with tempfile.TemporaryDirectory() as folder:
            design = pathlib.Path(folder) / "wrong.toml"
            design.write_text(text.replace("beta + w*T*alpha'", "beta + w*T*alhpa'"))
            line = 1 + text[:text.index("beta + w*T*alpha'")].count("\n")
            result = run("check", design)
            self.assertEqual(result.returncode, 2)
            self.assertIn(f"wrong.toml:{line}:21: unknown name alhpa'; nearest known name: alpha'", result.stderr)


if __name__ == "__main__":
    unittest.main()
