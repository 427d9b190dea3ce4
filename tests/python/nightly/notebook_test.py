"""The notebook of docs/, executed as a user would."""

import json
import os
import subprocess
import sys

from conftest import ROOT

# Debian's kernel, whichever other interpreters have one.
_KERNEL = {"argv": [sys.executable, "-m", "ipykernel_launcher", "-f", "{connection_file}"],
           "display_name": "Python 3", "language": "python"}


def test_the_notebook_runs_from_top_to_bottom(tmp_path):
    kernel = tmp_path / "data" / "kernels" / "python3"
    kernel.mkdir(parents=True)
    (kernel / "kernel.json").write_text(json.dumps(_KERNEL))
    subprocess.run([sys.executable, "-m", "nbconvert", "--to", "notebook", "--execute", ROOT / "docs" / "python.ipynb",
                    "--output-dir", tmp_path, "--output", "executed", "--ExecutePreprocessor.timeout=600"],
                   check=True, env={**os.environ, "JUPYTER_PATH": str(tmp_path / "data"), "HOME": str(tmp_path),
                                    "JUPYTER_DATA_DIR": str(tmp_path / "data")})
    cells = json.loads((tmp_path / "executed.ipynb").read_text())["cells"]
    outputs = [output for cell in cells if cell["cell_type"] == "code" for output in cell["outputs"]]
    assert not [output for output in outputs if output["output_type"] == "error"]
    assert sum("image/png" in output.get("data", {}) for output in outputs) == 2
    text = json.dumps(outputs)
    assert "<VERIFIED>" in text and "PROVED" in text and "objections=()" in text
