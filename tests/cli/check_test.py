"""veritrack check: the same verdicts, a line per requirement."""

import json
import unittest
import xml.etree.ElementTree

from support import DESIGN, CliTestCase

# The assumed start exceeds the first bound; settling within one sample is not certified.
HARD = DESIGN + "\n[require]\nfrequency_error_below = 0.001\nsettled_below = 0.002\nsettles_within = 1\n"
HARD_LINES = [HARD.splitlines().index(line) + 1 for line in (HARD.splitlines()[-3], HARD.splitlines()[-1])]


class Check(CliTestCase):
    def test_nothing_required(self):
        self.write(DESIGN)
        result = self.run_here("check", "design.toml")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(result.stdout, "design.toml: nothing required\n")
        self.assertEqual(self.files(), [])

    def test_a_line_per_requirement(self):
        self.write(HARD)
        result = self.run_here("check", "design.toml")
        self.assertEqual(result.returncode, 1, result.stderr)
        lines = result.stdout.splitlines()
        self.assertEqual(len(lines), 2)
        self.assertTrue(lines[0].startswith(f"design.toml:{HARD_LINES[0]}: refuted: "), lines[0])
        self.assertTrue(lines[1].startswith(f"design.toml:{HARD_LINES[1]}: undecided: "), lines[1])

    def test_a_requirement_that_is_proved(self):
        self.write(DESIGN + "\n[require]\nfrequency_error_below = 0.05\nsettles_within = 200\nsettled_below = 0.01\n")
        result = self.run_here("check", "design.toml", "--sarif", "report.sarif")
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
        self.assertEqual([line.split(": ")[1] for line in result.stdout.splitlines()], ["proved", "proved"])
        self.assertEqual(json.loads((self.folder / "report.sarif").read_text())["runs"][0]["results"], [])

    def test_several_designs_share_one_status(self):
        self.write(DESIGN, "fine.toml")
        self.write(HARD, "hard.toml")
        result = self.run_here("check", "fine.toml", "hard.toml", "fine.toml")
        self.assertEqual(result.returncode, 1, result.stderr)
        self.assertEqual(len(result.stdout.splitlines()), 4)

    def test_junit(self):
        self.write(HARD, "hard <&>.toml")
        self.write(DESIGN, "fine.toml")
        result = self.run_here("check", "hard <&>.toml", "fine.toml", "--junit", "report.xml")
        self.assertEqual(result.returncode, 1, result.stderr)
        suites = xml.etree.ElementTree.parse(self.folder / "report.xml").getroot()
        self.assertEqual(suites.tag, "testsuites")
        self.assertEqual([suite.get("name") for suite in suites], ["hard <&>.toml", "fine.toml"])
        self.assertEqual([(suite.get("tests"), suite.get("failures")) for suite in suites], [("2", "2"), ("0", "0")])
        failures = [case.find("failure").get("type") for case in suites[0]]
        self.assertEqual(failures, ["refuted", "undecided"])

    def test_sarif(self):
        self.write(HARD)
        result = self.run_here("check", "design.toml", "--sarif", "report.sarif")
        self.assertEqual(result.returncode, 1, result.stderr)
        report = json.loads((self.folder / "report.sarif").read_text())
        self.assertEqual(report["version"], "2.1.0")
        results = report["runs"][0]["results"]
        self.assertEqual([entry["level"] for entry in results], ["error", "warning"])
        regions = [entry["locations"][0]["physicalLocation"]["region"]["startLine"] for entry in results]
        self.assertEqual(regions, HARD_LINES)
        rules = {rule["id"] for rule in report["runs"][0]["tool"]["driver"]["rules"]}
        self.assertEqual(rules, {entry["ruleId"] for entry in results})

    def test_strict_wants_a_requirement(self):
        self.write(DESIGN)
        result = self.run_here("check", "design.toml", "--strict")
        self.assertEqual((result.returncode, result.stdout), (1, "design.toml: nothing required\n"), result.stderr)

    def test_one_bad_file_does_not_hide_the_others(self):
        self.write(HARD)
        self.write(DESIGN.replace("q1 =", "q3 ="), "bad.toml")
        result = self.run_here("check", "nowhere.toml", "bad.toml", "design.toml", "--junit", "report.xml",
                               "--sarif", "report.sarif")
        self.assertEqual(result.returncode, 2)
        self.assertEqual([line.split(":")[0] for line in result.stdout.splitlines()], ["design.toml"] * 2)
        self.assertEqual([line.split(":")[0] for line in result.stderr.splitlines()], ["nowhere.toml", "bad.toml"])
        suites = xml.etree.ElementTree.parse(self.folder / "report.xml").getroot()
        self.assertEqual([suite.get("errors") for suite in suites], ["1", "1", "0"])
        self.assertEqual([suite.get("tests") for suite in suites], ["1", "1", "2"])
        self.assertIn("q3", suites[1][0].find("error").get("message"))
        results = json.loads((self.folder / "report.sarif").read_text())["runs"][0]["results"]
        self.assertEqual([entry["ruleId"] for entry in results][:2], ["bad-input"] * 2)
        self.assertEqual([entry["level"] for entry in results], ["error", "error", "error", "warning"])
        places = [entry["locations"][0]["physicalLocation"] for entry in results]
        self.assertNotIn("region", places[0])
        self.assertEqual(places[1]["region"]["startLine"], 5)


if __name__ == "__main__":
    unittest.main()
