"""veritrack certify and check with a time limit."""

import json
import unittest

from documents import read_documents
from support import DESIGN, ROOT, CliTestCase

MODEL = (ROOT / "designs" / "models" / "aranovskiy.toml").read_text() + "\n[require]\nfrequency_error_below = 0.05\n"


class Timeout(CliTestCase):
    def test_a_search_that_is_stopped_says_so_and_proves_nothing_that_it_did_not_reach(self):
        self.write(MODEL)
        result = self.run_here("certify", "--no-verify", "design.toml", "--out", "out", "--timeout", "0.001")
        self.assertEqual(result.returncode, 1, result.stderr)
        document = (self.folder / "out" / "certificate.md").read_text()
        self.assertTrue(document.startswith("# NOT PROVED. UNDECIDED: "), document[:200])
        self.assertIn("\n*Stopped by the time limit.* ", document)
        self.assertIn("stopped by the time limit, between 0.09 and 0.11 rad/sample", document)
        certificate, report = read_documents(self.folder / "out")
        self.assertEqual(certificate["tubes"], [])
        self.assertEqual(certificate["verdict"], "undecided")
        self.assertIs(report["stopped_by_time_limit"], True)

    def test_enough_time_changes_nothing(self):
        self.write(MODEL.replace("[0.09, 0.11]", "[0.1, 0.101]"))
        self.assertEqual(self.run_here("certify", "--no-verify", "design.toml", "--out", "out").returncode, 0)
        without = [(self.folder / "out" / name).read_bytes() for name in ("certificate.md", "certificate.json", "report.json")]
        result = self.run_here("certify", "--no-verify", "design.toml", "--out", "out", "--timeout", "100000")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(without, [(self.folder / "out" / name).read_bytes()
                                   for name in ("certificate.md", "certificate.json", "report.json")])

    def test_check_stops_each_design(self):
        self.write(MODEL, "one.toml")
        self.write(MODEL, "two.toml")
        result = self.run_here("check", "one.toml", "two.toml", "--timeout", "0.001", "--sarif", "report.sarif")
        self.assertEqual(result.returncode, 1, result.stderr)
        lines = result.stdout.splitlines()
        self.assertEqual(lines.pop(), "2 designs: 2 undecided")
        self.assertEqual(len(lines), 2)
        for line in lines:
            self.assertIn("undecided: ", line)
            self.assertIn("stopped by the time limit", line)
        self.assertEqual(len(json.loads((self.folder / "report.sarif").read_text())["runs"][0]["results"]), 2)

    def test_other_trackers_take_the_time_they_need(self):
        self.write(DESIGN)
        result = self.run_here("certify", "--no-verify", "design.toml", "--timeout", "0.001")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("--timeout has no effect on the tracker quadrature-ekf; it can stop: single-channel-ekf "
                      "or model", result.stderr)

    def test_a_limit_is_a_number_of_seconds(self):
        self.write(MODEL)
        for bad in ("0", "-1", "nan", "soon"):
            result = self.run_here("check", "design.toml", "--timeout", bad)
            self.assertEqual(result.returncode, 2, bad)


if __name__ == "__main__":
    unittest.main()
