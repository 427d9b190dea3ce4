"""veritrack show --language octave: the code that is printed, run by Octave where that is installed."""

import math
import pathlib
import shutil
import subprocess
import tempfile
import tomllib
import unittest

from support import ROOT, run

OCTAVE = shutil.which("octave-cli") or shutil.which("octave")
MODELS = sorted((ROOT / "designs" / "models").glob("*.toml"))
SAMPLES = 60


def show(design, language):
    result = run("show", design, "--language", language)
    assert result.returncode == 0, result.stderr
    return result.stdout


def octave_matrix(rows):
    return "[" + "; ".join(", ".join(repr(value) for value in row) for row in rows) + "]"


@unittest.skipUnless(OCTAVE, "Octave is not installed")
class OctaveCode(unittest.TestCase):
    def test_it_computes_what_the_python_code_computes(self):
        self.assertTrue(MODELS)
        for design in MODELS:
            with self.subTest(design=design.name), tempfile.TemporaryDirectory() as folder:
                keys = tomllib.loads(design.read_text())
                python = {}
                exec(show(design, "python"), python)  # pylint: disable=exec-used
                frequency = keys["assume"]["frequency"]
                omega = 0.4 if not isinstance(frequency, dict) else \
                    2 * math.pi * sum(frequency["hz"]) / 2 / keys["assume"]["sample_rate"]
                channels = len(keys["model"]["samples"]) if isinstance(keys["model"]["samples"], list) else 1
                samples = [[math.cos(omega * k), math.sin(omega * k)][:channels] for k in range(SAMPLES)]
                expected = []
                state = python["tracker_start"](1.0, omega)
                for sample in samples:
                    state = python["tracker_step"](state, sample)
                    expected.append([*state, python["tracker_frequency"](state)])
                script = pathlib.Path(folder) / "run_tracker.m"
                script.write_text(show(design, "octave") + f"""
samples = {octave_matrix(samples)};
state = tracker_start(1.0, {omega!r});
for k = 1:rows(samples)
  state = tracker_step(state, samples(k, :));
  printf("%.17g ", state, tracker_frequency(state));
  printf("\\n");
end
""")
                result = subprocess.run([OCTAVE, "--no-gui", "--no-init-file", str(script)], capture_output=True,
                                        text=True, timeout=300, check=False)
                self.assertEqual(result.returncode, 0, result.stderr)
                rows = [[float(value) for value in line.split()] for line in result.stdout.splitlines() if line.strip()]
                self.assertEqual(len(rows), SAMPLES)
                for row, wanted in zip(rows, expected, strict=True):
                    self.assertEqual(len(row), len(wanted))
                    for value, other in zip(row, wanted, strict=True):
                        self.assertLessEqual(abs(value - other), 1e-12 * (1 + abs(other)))


if __name__ == "__main__":
    unittest.main()
