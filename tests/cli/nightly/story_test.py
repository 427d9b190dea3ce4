"""What docs/story-motor-tone.md prints, and the figures of docs/example: what the program does today.

With VERITRACK_UPDATE_GOLDEN=1 the figures are drawn anew; the text of the story is corrected by hand."""

import os
import pathlib
import re
import shutil
import subprocess
import sys
import unittest

from support import PROGRAM, ROOT, CliTestCase

STORY = (ROOT / "docs/story-motor-tone.md").read_text()
UPDATES = os.environ.get("VERITRACK_UPDATE_GOLDEN") == "1"


def blocks():
    """The fenced blocks, those inside lists, too: language and text."""
    found = re.findall(r"^( *)```(\w*)\n(.*?)^ *```$", STORY, re.MULTILINE | re.DOTALL)
    return [(language, "".join(line.removeprefix(indent) + "\n" for line in text.splitlines()))
            for indent, language, text in found]


class Story(CliTestCase):
    def setUp(self):
        super().setUp()
        (self.folder / "bin").mkdir()
        for program in (pathlib.Path(PROGRAM), pathlib.Path(PROGRAM).with_name("veritrack-verify")):
            (self.folder / "bin" / program.name).symlink_to(program)
        (self.folder / "bin/python3").symlink_to(sys.executable)

    def shell(self, command):
        environment = {**os.environ, "PATH": f"{self.folder / 'bin'}:{os.environ['PATH']}"}
        return subprocess.run(["bash", "-c", command], cwd=self.folder, env=environment, capture_output=True, text=True,
                              check=False)

    def same_figure(self, name, drawn):
        committed = ROOT / "docs/example" / name
        if UPDATES:
            shutil.copyfile(drawn, committed)
        self.assertEqual(committed.read_bytes(), drawn.read_bytes(), name)

    def test_the_story(self):
        told = 0
        for language, text in blocks():
            if language == "toml":
                (self.folder / "motor.toml").write_text(text)
            elif language == "sh":
                self.assertEqual(self.shell(text).returncode, 0, text)
            else:
                command, expected = re.fullmatch(r"\$ (.*?)\n(.*)", text, re.DOTALL).groups()
                told += 1
                with self.subTest(command=command):
                    result = self.shell(command)
                    self.assertEqual(result.stdout + result.stderr, expected)
        self.assertGreaterEqual(told, 8)
        self.same_figure("trade-off.svg", self.folder / "certificates-out/motor-tuned/figures/trade-off.svg")

    def test_the_figure_of_the_readme(self):
        self.run_here("certify", "--no-verify", ROOT / "designs/motor-tone-8-khz.toml", "--out", "out")
        self.same_figure("tube.svg", self.folder / "out/figures/tube.svg")

    def test_the_map_of_a_model(self):
        self.run_here("map", ROOT / "designs/models/type-2-pll.toml", "--out", "map")
        self.same_figure("model-map.svg", self.folder / "map/region.svg")


if __name__ == "__main__":
    unittest.main()
