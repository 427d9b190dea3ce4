"""The package as pip installs it, and its types."""

import os
import pathlib
import subprocess
import sys

from conftest import ROOT, TEXT

_USE = """
import pathlib, sys, veritrack
assert pathlib.Path(veritrack.__file__).is_relative_to(sys.prefix), veritrack.__file__
design = veritrack.Design.from_file(sys.argv[1])
print(design.name, veritrack.QuadratureEkf.from_design(design, frequency=0.5).run([1j]).frequency.shape)
"""


def test_a_wheel_is_built_installed_and_used(tmp_path):
    (tmp_path / "mine.toml").write_text(TEXT)
    clean = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
    build = pathlib.Path(os.environ["VERITRACK"]).parent

    def run(*command):
        return subprocess.run(command, check=True, capture_output=True, text=True, cwd=tmp_path,
                              env={**clean, "VERITRACK_BUILD_FOLDER": str(build)}).stdout

    run(sys.executable, "-m", "pip", "wheel", "--quiet", "--no-build-isolation", "--no-deps", "--no-index",
        "--wheel-dir", tmp_path, ROOT)
    wheel, = tmp_path.glob("veritrack-*.whl")
    assert "none-any" not in wheel.name  # it is for this platform
    run(sys.executable, "-m", "venv", "--system-site-packages", "--without-pip", tmp_path / "env")
    python = tmp_path / "env" / "bin" / "python3"
    run(sys.executable, "-m", "pip", "--python", python, "install", "--quiet", "--no-deps", "--no-index", wheel)
    assert run(python, "-c", _USE, tmp_path / "mine.toml") == "a design (1,)\n"
    assert (tmp_path / "env" / "bin" / "veritrack-sweep").exists()
