"""veritrack show --language c --precision: the printed C has the bits of the formulas, operation by operation."""
import ctypes
import ctypes.util
import json
import math
import os
import pathlib
import random
import re
import struct
import subprocess
import tempfile
import tomllib
import unittest

from support import ROOT, run

MODELS = [ROOT / "designs" / "models" / f"{name}.toml" for name in
          ("type-2-pll", "kalmanf", "odrive-pll", "motor-pll-with-limits", "pei-tseng-notch", "aranovskiy", "sogi-fll")]
LIBRARY = ctypes.CDLL(ctypes.util.find_library("m"))


def function_of(name, arguments):
    function = getattr(LIBRARY, name)
    function.restype = ctypes.c_float
    function.argtypes = [ctypes.c_float] * arguments
    return lambda *operands: Single(function(*(Single(x).value for x in operands)))


class Single:
    """A number in single precision: sums and products of doubles, rounded, are correctly rounded."""

    def __init__(self, value):
        value = value.value if isinstance(value, Single) else value
        self.value = struct.unpack("f", struct.pack("f", value))[0]

    def __add__(self, other):
        return Single(self.value + Single(other).value)

    def __sub__(self, other):
        return Single(self.value - Single(other).value)

    def __mul__(self, other):
        return Single(self.value * Single(other).value)

    def __truediv__(self, other):
        return Single(self.value / Single(other).value)

    def __neg__(self):
        return Single(-self.value)

    def __pow__(self, exponent):
        power = self
        for _ in range(int(exponent.value) - 1):
            power = power * self
        return power


def clamp(x, low, high):
    return Single(min(max(x.value, low.value), high.value))


FUNCTIONS = {name: function_of(name + "f", 1) for name in ("sin", "cos", "sqrt", "acos", "asin", "atan")} | {
    "atan2": function_of("atan2f", 2), "clamp": clamp, "Single": Single, "pi": Single(math.pi)}


def in_python(formula):
    """The formula of a design in single precision."""
    formula = re.sub(r"(?<![\w.])(\d+\.?\d*(?:[eE][-+]?\d+)?|\.\d+)", r"Single(\1)", str(formula))
    return formula.replace("^", "**").replace("'", "_next")


class Formulas:
    """The step of a design, by its text."""

    def __init__(self, keys):
        self.model = keys["model"]
        self.names = dict(FUNCTIONS)
        for name, formula in self.model["parameters"].items():
            self.names[name] = eval(in_python(formula), self.names)  # pylint: disable=eval-used
        lines = [line.split("#")[0].strip() for line in self.model["step"].splitlines()]
        self.lines = [in_python(line) for line in lines if line]
        self.samples = self.model["samples"] if isinstance(self.model["samples"], list) else [self.model["samples"]]

    def step(self, state, sample):
        names = self.names | dict(zip(self.model["states"], state)) | dict(zip(self.samples, sample))
        waiting = list(self.lines)
        while waiting:  # in the order in which they can be computed
            try:
                exec(waiting[0], names)  # pylint: disable=exec-used
                waiting.pop(0)
            except NameError:
                waiting.append(waiting.pop(0))
        following = []
        for name in self.model["states"]:
            value = names[f"{name}_next"]
            if name in self.model.get("angles", []):
                turns = value * Single(1 / (2 * math.pi))
                value = value - Single(2 * math.pi) * Single(round(turns.value))  # to even, as rint does
            following.append(value)
        return following

    def frequency(self, state):
        names = self.names | dict(zip(self.model["states"], state))
        return eval(in_python(self.model["frequency"]), names)  # pylint: disable=eval-used


def compiled(design, keys, folder):
    result = run("show", design, "--language", "c", "--precision", "single")
    assert result.returncode == 0, result.stderr
    source = pathlib.Path(folder) / "tracker.c"
    source.write_text(result.stdout)
    library = pathlib.Path(folder) / "tracker.so"
    subprocess.run(["cc", "-O2", "-Wall", "-Werror", "-ffp-contract=off", "-fno-builtin", "-shared", "-fPIC", source,
                    "-o", library, "-lm"], check=True)
    loaded = ctypes.CDLL(str(library))
    loaded.tracker_frequency.restype = ctypes.c_float
    channels = 2 if isinstance(keys["model"]["samples"], list) else 1
    loaded.tracker_step.argtypes = [ctypes.c_void_p] + [ctypes.c_float] * channels
    return loaded


class InOneFormat(unittest.TestCase):
    def test_printed_c_has_the_bits_of_the_formulas(self):
        for design in MODELS:
            with self.subTest(design=design.name), tempfile.TemporaryDirectory() as folder:
                keys = tomllib.loads(design.read_text())
                formulas = Formulas(keys)
                library = compiled(design, keys, folder)
                state = (ctypes.c_float * len(keys["model"]["states"]))()
                library.tracker_init(state)
                frequency = keys["assume"]["frequency"]
                omega = sum(frequency) / 2 if not isinstance(frequency, dict) else \
                    2 * math.pi * sum(frequency["hz"]) / 2 / keys["assume"]["sample_rate"]
                noise = random.Random(1)
                for k in range(1000):
                    sample = [math.cos(omega * k), math.sin(omega * k)][:len(formulas.samples)]
                    sample = [Single(value + noise.gauss(0, 1e-3)) for value in sample]
                    before = [Single(value) for value in state]
                    self.assertEqual(library.tracker_frequency(state), formulas.frequency(before).value)
                    library.tracker_step(state, *(value.value for value in sample))
                    self.assertEqual(list(state), [value.value for value in formulas.step(before, sample)])
                self.assertLess(abs(library.tracker_frequency(state) - omega), 0.05)

    def certified(self, text, parameters, folder):
        """Certificates of a design in single precision, and of the C that is printed for it."""
        (folder / "text.toml").write_text(text)
        shown = run("show", folder / "text.toml", "--language", "c", "--precision", "single")
        (folder / "tracker.c").write_text(shown.stdout)
        names = ", ".join(name.split()[-1] for name in parameters.split(","))
        (folder / "harness.c").write_text(f"""#include "tracker.c"
static tracker_t tracker;
void setup(void) {{ tracker_init(&tracker); }}
void step({parameters}) {{ tracker_step(&tracker, {names}); }}
float frequency(void) {{ return tracker_frequency(&tracker); }}
""")
        (folder / "code.toml").write_text("name = 'the printed C'\ntracker = 'model'\n\n[code]\nfiles = ['harness.c']\n\n" +
                                          text[text.index("[assume]"):])
        certificates = {}
        for design, begin in (("text", "In single precision (IEEE 754 binary32) of the formulas"),
                              ("code", "In IEEE 754 arithmetic of the listing")):
            result = run("certify", folder / f"{design}.toml", "--out", folder / design)
            self.assertEqual(result.returncode, 0, result.stderr)
            self.assertIn("VERIFIED", result.stdout + result.stderr)
            certificates[design] = json.loads((folder / design / "certificate.json").read_text())
            self.assertIn("rounding", certificates[design]["gains"])
            self.assertIn(begin, (folder / design / "certificate.md").read_text())
        return certificates

    def assert_same_limits(self, certificates):
        limits = {design: [float(claim[key]) for claim in certificate["claims"]
                           for key in ("noise", "reach") if key in claim]
                  for design, certificate in certificates.items()}
        self.assertEqual([len(each) for each in limits.values()], [2, 2])
        for text_limit, code_limit in zip(limits["text"], limits["code"]):
            self.assertAlmostEqual(text_limit / code_limit, 1.0, delta=0.005)

    def test_a_design_of_the_printed_c_is_certified_to_the_same_bounds(self):
        text = MODELS[0].read_text().replace("frequency = [0.2, 0.5]", "frequency = [0.3, 0.3001]")
        text = text.replace("[assume]", "arithmetic = 'binary32'\n\n[assume]")
        with tempfile.TemporaryDirectory() as folder:
            self.assert_same_limits(self.certified(text, "float y", pathlib.Path(folder)))

    def test_so_is_one_that_turns_its_samples_back(self):
        text = (ROOT / "designs" / "models" / "odrive-pll-in-single-precision.toml").read_text()
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            certificates = self.certified(text, "float alpha, float beta", folder)
            self.assert_same_limits(certificates)
            forged = certificates["code"]
            forged["design"]["model"]["step"] = forged["design"]["model"]["step"].replace(
                "stays_within(r5, -3.14, 3.14)", "stays_within(r5, -3.1415, 3.1415)")
            self.assertNotEqual(forged, json.loads((folder / "code" / "certificate.json").read_text()))
            (folder / "forged.json").write_text(json.dumps(forged))
            result = subprocess.run([os.environ["VERITRACK_VERIFY"], folder / "forged.json"], capture_output=True,
                                    text=True, check=False)
            self.assertIn(result.returncode, (2, 3))
            self.assertNotIn("malformed", result.stdout + result.stderr)

    def test_double_precision_and_what_is_refused(self):
        double = run("show", MODELS[0], "--language", "c", "--precision", "double")
        self.assertIn("double theta, w;", double.stdout)
        self.assertNotIn("float", double.stdout)
        for design, language in ((MODELS[0], "python"), (ROOT / "designs" / "models" / "quadrature-ekf.toml", "c")):
            result = run("show", design, "--language", language, "--precision", "single")
            self.assertEqual(result.returncode, 2)
            self.assertIn("--precision", result.stderr)


if __name__ == "__main__":
    unittest.main()
