"""The types of the package."""

import subprocess
import sys

from conftest import ROOT


def test_types(tmp_path):
    done = subprocess.run([sys.executable, "-m", "mypy", "--cache-dir", tmp_path, "--config-file",
                           ROOT / "pyproject.toml", "--ignore-missing-imports", ROOT / "python" / "veritrack"],
                          capture_output=True, text=True, check=False, cwd=ROOT)
    assert done.returncode == 0, done.stdout
