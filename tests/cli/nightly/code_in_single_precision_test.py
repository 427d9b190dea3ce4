"""The compiled functions of designs/code, 10^8 steps without noise: no error passes the bound that the certificate
has for the rounding, and the largest is not far below it."""

import json
import math
import pathlib
import re
import shutil
import subprocess
import tempfile
import unittest

from support import ROOT, run

STEPS = 100_000_000
SETTLED = 200_000
# The phase goes on by parts of a turn that double arithmetic keeps within 1e-15; the samples are rounded.
DRIVER = r"""
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
void setup(void);
float frequency(void);
void step(ARGUMENTS);
int main(int count, char** arguments) {
  const double w = atof(arguments[1]);
  const long steps = atol(arguments[2]), settled = atol(arguments[3]);
  double turns = 0.05, largest = 0.0;
  setup();
  for (long k = 0; k < steps; ++k) {
    turns += w / (2.0 * M_PI);
    turns -= floor(turns);
    const double phase = 2.0 * M_PI * turns;
    step(SAMPLES);
    const double error = fabs((double)frequency() - w);
    largest = k >= settled && !(error <= largest) ? error : largest;
  }
  printf("%.17g\n", largest);
  return count == 4 ? 0 : 1;
}
"""
ONE = DRIVER.replace("ARGUMENTS", "float").replace("SAMPLES", "(float)cos(phase)")
TWO = DRIVER.replace("ARGUMENTS", "float, float").replace("SAMPLES", "(float)cos(phase), (float)sin(phase)")


class SinglePrecision(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = pathlib.Path(scratch.name)
        for file in (ROOT / "designs" / "code").iterdir():
            shutil.copy(file, self.folder)

    def bound_of(self, design):
        """In the long run, with noise that is the rounding of the samples; in rad/sample."""
        path = self.folder / design
        path.write_text(re.sub(r"(?m)^noise = \S+", "noise = 6e-8", path.read_text()))
        result = run("certify", path, "--out", self.folder / "out")
        self.assertEqual(result.returncode, 0, result.stderr)
        certificate = json.loads((self.folder / "out" / "certificate.json").read_text())
        self.assertIn("rounding", certificate["gains"])
        claim = next(claim for claim in certificate["claims"] if claim["id"] == "model/guarantee")
        return float(claim["settled_frequency_error"])

    def largest_error(self, sources, driver, frequencies):
        program = self.folder / "driven"
        (self.folder / "driver.c").write_text(driver)
        subprocess.run(["gcc", "-O2", "-ffp-contract=off", *(self.folder / source for source in sources),
                        self.folder / "driver.c", "-lm", "-o", program], check=True)
        errors = []
        for frequency in frequencies:
            result = subprocess.run([program, repr(frequency), str(STEPS // len(frequencies)), str(SETTLED)],
                                    capture_output=True, text=True, check=True)
            errors.append(float(result.stdout))
        return max(errors)

    def attack(self, design, sources, driver, frequencies):
        bound = self.bound_of(design)
        error = self.largest_error(sources, driver, frequencies)
        print(f"{design}: errors up to {error:.3g} of {bound:.3g} rad/sample, {error / bound:.2f} of the bound")
        self.assertLessEqual(error, bound)
        self.assertGreater(error, 0.1 * bound)

    def test_a_phase_locked_loop_of_two_channels(self):
        self.attack("motor-pll.toml", ["pll.c", "harness.c"], TWO, [0.0101, 0.05, 0.1234, 0.3141, 0.4, 0.45, 0.49, 0.5])

    def test_a_frequency_locked_loop_of_one_channel(self):
        hertz = 2.0 * math.pi / 10000.0
        self.attack("sogi-fll.toml", ["sogi-fll.c"], ONE, [hertz * f for f in (49.0, 49.5, 50.0, 50.3, 51.0)])


if __name__ == "__main__":
    unittest.main()
