"""Runs the program as a user would."""

import atexit
import os
import pathlib
import shutil
import subprocess
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
PROGRAM = os.environ["VERITRACK"]


# Half a minute of certificates in a test that rarely fails: not in .ci/run, which has less effort.
takes_long = unittest.skipIf(float(os.environ.get("VERITRACK_TEST_EFFORT", "1")) < 1, "takes long: with more effort")


def scratch_folder():
    """A folder that goes away when the tests end."""
    folder = pathlib.Path(tempfile.mkdtemp())
    atexit.register(shutil.rmtree, folder, ignore_errors=True)
    return folder


# Verdicts that a test finds are not those of an earlier run, nor kept for a later one.
os.environ["XDG_CACHE_HOME"] = str(scratch_folder())
os.environ.pop("GITHUB_ACTIONS", None)

DESIGN = """\
name    = "a design"
tracker = "quadrature-ekf"

[design]
q1 = 0.0023
q2 = 0.0023
r = 0.05
epsilon = 0.0

[assume]
amplitude = 1.0
frequency = [0.05, 3.0]
noise = 0.001
slew = 0.0
initial_frequency_error = 0.005
initial_phase_error = 0.005
initial_amplitude_error = 0.005

[simulate]
samples = 50
"""


def run(*arguments, **options):
    return subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True, timeout=900,
                          check=False, **options)


class CliTestCase(unittest.TestCase):
    """A test with its own folder, in which the program runs."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def write(self, text, name="design.toml"):
        path = self.folder / name
        if isinstance(text, bytes):
            path.write_bytes(text)
        else:
            path.write_text(text)
        return path

    def run_here(self, *arguments, **options):
        return run(*arguments, cwd=self.folder, **options)

    def files(self):
        """Everything in the folder except designs."""
        return sorted(str(path.relative_to(self.folder)) for path in self.folder.rglob("*")
                      if path.is_file() and path.suffix != ".toml")
