"""veritrack map: the proved region of attraction, as a picture and as cells."""

import csv
import os
import pty
import subprocess
import unittest
import xml.etree.ElementTree

from support import DESIGN, PROGRAM, CliTestCase

WITHOUT_AMPLITUDE_ERROR = DESIGN.replace("initial_amplitude_error = 0.005", "initial_amplitude_error = 0.0")


class Map(CliTestCase):
    def cells(self, folder):
        with open(self.folder / folder / "region.csv", newline="") as file:
            return list(csv.DictReader(file))

    def test_starts_well_inside_the_basin_are_captured(self):
        self.write(WITHOUT_AMPLITUDE_ERROR)
        result = self.run_here("map", "design.toml", "--frequency", "0.3", "--phase", "0.5")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(result.stdout.split(":")[0], "maps-out/design/map.md")
        self.assertIn("100 % of the simulated basin", result.stdout)
        self.assertEqual(result.stderr, "")
        root = xml.etree.ElementTree.parse(self.folder / "maps-out/design/region.svg").getroot()
        self.assertTrue(root.tag.endswith("svg"))
        cells = self.cells("maps-out/design")
        self.assertEqual({cell["verdict"] for cell in cells}, {"proved"})
        area = sum((float(cell["frequency_error_high"]) - float(cell["frequency_error_low"])) *
                   (float(cell["phase_error_high"]) - float(cell["phase_error_low"])) for cell in cells)
        self.assertAlmostEqual(area, 0.6 * 1.0)

    def on_a_terminal(self, *arguments):
        """What the program prints on standard error when that is a terminal."""
        reader, terminal = pty.openpty()
        with os.fdopen(reader, "rb", buffering=0) as shown:
            subprocess.run([PROGRAM, *arguments], cwd=self.folder, stdout=subprocess.DEVNULL, stderr=terminal,
                           timeout=300, check=True)
            os.write(terminal, b"|")  # an end to read up to
            os.close(terminal)
            text = b""
            while not text.endswith(b"|"):
                text += shown.read(4096)
        return text[:-1]

    def test_progress_is_shown_on_a_terminal_unless_quiet(self):
        self.write(WITHOUT_AMPLITUDE_ERROR)
        command = ("map", "design.toml", "--frequency", "0.3", "--phase", "0.5")
        self.assertIn(b"propagations", self.on_a_terminal(*command))
        self.assertEqual(self.on_a_terminal(*command, "--quiet"), b"")
        self.assertEqual(self.on_a_terminal("--quiet", *command), b"")

    def test_same_input_same_bytes(self):
        self.write(WITHOUT_AMPLITUDE_ERROR)
        for folder in ("one", "two"):
            self.run_here("map", "design.toml", "--frequency", "0.3", "--phase", "0.5", "--out", folder)
        for name in ("region.svg", "region.csv"):
            self.assertEqual((self.folder / "one" / name).read_bytes(), (self.folder / "two" / name).read_bytes())

    def test_what_cannot_be_mapped_says_why(self):
        for what, text in {"leak": DESIGN.replace("epsilon = 0.0", "epsilon = 0.01"),
                           "uncontrollable": DESIGN.replace("q1 = 0.0023", "q1 = 0")}.items():
            with self.subTest(what=what):
                self.write(text)
                result = self.run_here("map", "design.toml")
                self.assertEqual(result.returncode, 1, result.stderr)
                self.assertIn("undecided", result.stdout)
                self.assertEqual(self.files(), [])

    def test_bad_ranges(self):
        self.write(DESIGN)
        for option, value in (("--frequency", "-1"), ("--frequency", "nan"), ("--phase", "0"), ("--phase", "4")):
            self.assertEqual(self.run_here("map", "design.toml", option, value).returncode, 2, (option, value))


if __name__ == "__main__":
    unittest.main()
