"""The notebook of docs/, executed as a user would; and its outputs, as they are read."""

import json
import subprocess
import sys

from conftest import ROOT


def assert_shows_what_it_does(path):
    cells = [cell for cell in json.loads(path.read_text())["cells"] if cell["cell_type"] == "code"]
    outputs = [output for cell in cells for output in cell["outputs"]]
    assert not [output for output in outputs if output["output_type"] == "error"]
    assert sum("image/png" in output.get("data", {}) for output in outputs) == 2
    text = json.dumps(outputs)
    assert "<VERIFIED>" in text and "PROVED" in text and "objections=()" in text
    return ["".join(cell["source"]) for cell in cells]


def test_the_notebook_runs_from_top_to_bottom_and_is_kept_with_its_outputs(tmp_path):
    subprocess.run([sys.executable, ROOT / "scripts" / "execute-notebook", tmp_path / "executed.ipynb"], check=True)
    executed = assert_shows_what_it_does(tmp_path / "executed.ipynb")
    assert executed == assert_shows_what_it_does(ROOT / "docs" / "python.ipynb")
