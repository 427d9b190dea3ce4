"""veritrack check: the same verdicts, a line per requirement."""

import json
import os
import unittest
import urllib.parse
import xml.etree.ElementTree

import jsonschema
from support import DESIGN, ROOT, CliTestCase, takes_long

# The assumed start exceeds the first bound; settling within one sample is not certified.
HARD = DESIGN + "\n[require]\nfrequency_error_below = 0.001\nsettled_below = 0.002\nsettles_within = 1\n"
HARD_LINES = [HARD.splitlines().index(line) + 1 for line in (HARD.splitlines()[-3], HARD.splitlines()[-1])]


SCHEMA = json.loads((ROOT / "reports/check/check.schema.json").read_text())
REQUIRED = DESIGN + "\n[require]\nfrequency_error_below = 0.05\n"


def validated(path):
    """The JSON of a report, as its schema says."""
    report = json.loads(path.read_text())
    jsonschema.Draft202012Validator.check_schema(SCHEMA)
    jsonschema.Draft202012Validator(SCHEMA).validate(report)
    return report


REPORTS = ("--json", "report.json", "--junit", "report.xml", "--sarif", "report.sarif")


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
        self.assertEqual(len(result.stdout.splitlines()), 5)
        self.assertTrue(result.stdout.endswith("\n3 designs: 1 refuted, 2 with nothing required\n"), result.stdout)

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
        self.assertEqual([entry["level"] for entry in results], ["error", "error"])
        regions = [entry["locations"][0]["physicalLocation"]["region"]["startLine"] for entry in results]
        self.assertEqual(regions, HARD_LINES)
        rules = {rule["id"] for rule in report["runs"][0]["tool"]["driver"]["rules"]}
        self.assertEqual(rules, {entry["ruleId"] for entry in results})

    def test_strict_wants_a_requirement(self):
        self.write(DESIGN)
        result = self.run_here("check", "design.toml", "--strict")
        self.assertEqual((result.returncode, result.stdout), (1, "design.toml: nothing required\n"), result.stderr)

    def test_what_strict_refuses_is_in_every_report(self):
        self.write(DESIGN)
        self.write(REQUIRED, "required.toml")
        for cached in (False, True):
            result = self.run_here("check", "design.toml", "required.toml", "--strict", *REPORTS,
                                   env={**os.environ, "GITHUB_ACTIONS": "true"})
            self.assertEqual(result.returncode, 1, (cached, result.stderr))
            self.assertIn("::error file=design.toml,title=nothing-required::", result.stdout)
            suites = xml.etree.ElementTree.parse(self.folder / "report.xml").getroot()
            self.assertEqual([(suite.get("tests"), suite.get("failures"), suite.get("errors")) for suite in suites],
                             [("1", "1", "0"), ("1", "0", "0")])
            self.assertEqual(suites[0][0].find("failure").get("type"), "nothing-required")
            (found,) = json.loads((self.folder / "report.sarif").read_text())["runs"][0]["results"]
            self.assertEqual((found["ruleId"], found["level"]), ("nothing-required", "error"))
            report = validated(self.folder / "report.json")
            self.assertEqual((report["exit_status"], report["summary"]), (1, "2 designs: 1 proved, 1 with nothing required"))
            self.assertEqual(report["designs"][0]["verdict"], "nothing-required")
            self.assertEqual(report["designs"][0]["error"]["kind"], "nothing-required")
        # What is kept is not what --strict makes of it.
        self.assertEqual(self.run_here("check", "design.toml").returncode, 0)

    def test_a_report_that_cannot_be_written_is_in_the_others(self):
        self.write(REQUIRED)
        (self.folder / "folder").mkdir()
        for where, done in (("folder", False), ("/dev/full", True)):
            with self.subTest(where=where):
                result = self.run_here("check", "design.toml", "--sarif", where, *REPORTS[:4])
                self.assertEqual(result.returncode, 2)
                self.assertTrue(result.stderr.startswith(f"{where}: cannot be written: "), result.stderr)
                report = validated(self.folder / "report.json")
                self.assertEqual(report["exit_status"], 2)
                self.assertEqual([design.get("error", {}).get("kind") for design in report["designs"]],
                                 [None] * done + ["cannot-write"])
                suites = xml.etree.ElementTree.parse(self.folder / "report.xml").getroot()
                self.assertEqual([suite.get("errors") for suite in suites], ["0"] * done + ["1"])

    def test_one_bad_file_does_not_hide_the_others(self):
        self.write(HARD)
        self.write(DESIGN.replace("q1 =", "q3 ="), "bad.toml")
        result = self.run_here("check", "nowhere.toml", "bad.toml", "design.toml", "--junit", "report.xml",
                               "--sarif", "report.sarif")
        self.assertEqual(result.returncode, 2)
        self.assertEqual([line.split(":")[0] for line in result.stdout.splitlines()], ["design.toml"] * 2 + ["3 designs"])
        self.assertTrue(result.stdout.endswith("\n3 designs: 1 refuted, 2 bad\n"), result.stdout)
        self.assertEqual([line.split(":")[0] for line in result.stderr.splitlines()], ["nowhere.toml", "bad.toml"])
        suites = xml.etree.ElementTree.parse(self.folder / "report.xml").getroot()
        self.assertEqual([suite.get("errors") for suite in suites], ["1", "1", "0"])
        self.assertEqual([suite.get("tests") for suite in suites], ["1", "1", "2"])
        self.assertIn("q3", suites[1][0].find("error").get("message"))
        results = json.loads((self.folder / "report.sarif").read_text())["runs"][0]["results"]
        self.assertEqual([entry["ruleId"] for entry in results][:2], ["bad-input"] * 2)
        self.assertEqual([entry["level"] for entry in results], ["error"] * 4)
        places = [entry["locations"][0]["physicalLocation"] for entry in results]
        self.assertNotIn("region", places[0])
        self.assertEqual(places[1]["region"]["startLine"], 5)

    def test_paths_in_sarif_are_percent_encoded_relative_references(self):
        self.write(HARD, "a folder: 50 %.toml")
        self.run_here("check", "a folder: 50 %.toml", "--sarif", "report.sarif")
        result = json.loads((self.folder / "report.sarif").read_text())["runs"][0]["results"][0]
        place = result["locations"][0]["physicalLocation"]["artifactLocation"]
        self.assertEqual(place["uri"], "a%20folder%3A%2050%20%25.toml")
        self.assertEqual(urllib.parse.unquote(place["uri"]), "a folder: 50 %.toml")

    def test_json_has_all_that_was_found(self):
        self.write(HARD)
        self.write(DESIGN, "fine.toml")
        result = self.run_here("check", "design.toml", "fine.toml", "nowhere.toml", "--json", "report.json")
        self.assertEqual(result.returncode, 2)
        report = validated(self.folder / "report.json")
        self.assertEqual((report["exit_status"], report["summary"]),
                         (2, "3 designs: 1 refuted, 1 with nothing required, 1 bad"))
        self.assertEqual(report["schema"], "veritrack/check/1")
        self.assertEqual([design["path"] for design in report["designs"]], ["design.toml", "fine.toml", "nowhere.toml"])
        hard, fine, nowhere = report["designs"]
        self.assertEqual([each["verdict"] for each in hard["requirements"]], ["refuted", "undecided"])
        self.assertEqual([each["line"] for each in hard["requirements"]], HARD_LINES)
        self.assertEqual((hard["verdict"], fine["verdict"]), ("refuted", "nothing-required"))
        self.assertEqual(nowhere["error"]["kind"], "bad-input")
        self.assertNotIn("verdict", nowhere)

    def test_a_folder_is_its_design_files_in_order(self):
        for name in ("b", "a", "c"):
            (self.folder / name).mkdir()
            self.write(DESIGN, f"{name}/design.toml")
        self.write("not a design", "a/readme.txt")
        result = self.run_here("check", ".")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(result.stdout.splitlines(), [f"./{name}/design.toml: nothing required" for name in "abc"]
                         + ["3 designs: 3 with nothing required"])

    def test_a_folder_without_designs_is_bad_input(self):
        (self.folder / "empty").mkdir()
        self.write(REQUIRED)
        result = self.run_here("check", "empty", "design.toml", *REPORTS)
        self.assertEqual(result.returncode, 2)
        self.assertIn("empty: has no design file; allowed: a folder with files *.toml", result.stderr)
        # The other design is checked, and the reports say what is wrong.
        report = validated(self.folder / "report.json")
        self.assertEqual(report["summary"], "2 designs: 1 proved, 1 bad")
        self.assertEqual(report["designs"][0]["error"]["kind"], "bad-input")
        suites = xml.etree.ElementTree.parse(self.folder / "report.xml").getroot()
        self.assertEqual([suite.get("errors") for suite in suites], ["1", "0"])

    @takes_long
    def test_the_number_of_jobs_changes_nothing(self):
        for number in range(3):
            self.write(HARD.replace("0.001\n", f"0.00{number + 1}\n"), f"{number}.toml")
        outputs = []
        for jobs in ("1", "3"):
            result = self.run_here("check", ".", "--jobs", jobs, "--no-cache", "--json", "out.json")
            outputs.append((result.returncode, result.stdout, result.stderr, (self.folder / "out.json").read_text()))
        self.assertEqual(outputs[0], outputs[1])
        self.assertIn("2.toml", outputs[0][1])

    def test_a_limit_stops_any_tracker(self):
        self.write(HARD.replace("noise = 0.001", "noise = { snr_db = 17 }\nsamples = 1e6").split("[require]")[0]
                   + "[require]\nprobability_of_losing_lock_below = 1e-6\n")
        result = self.run_here("check", "design.toml", "--timeout", "0.3", *REPORTS)
        self.assertEqual((result.returncode, result.stderr), (1, ""))
        self.assertEqual(result.stdout, "design.toml: undecided: stopped after 0.3 s (--timeout)\n")
        suite = xml.etree.ElementTree.parse(self.folder / "report.xml").getroot()[0]
        self.assertEqual(suite[0].find("error").get("type"), "time-limit")
        report = validated(self.folder / "report.json")
        self.assertEqual((report["exit_status"], report["summary"]), (1, "1 design: 1 undecided"))


class Cache(CliTestCase):
    def setUp(self):
        super().setUp()
        self.cache = self.folder / "cache"
        self.cache.mkdir()
        self.write(HARD)

    def check(self, *options):
        return self.run_here("check", "design.toml", *options, env={**os.environ, "XDG_CACHE_HOME": str(self.cache)})

    def kept(self):
        return [path for path in self.cache.rglob("*") if path.is_file()]

    def test_what_was_checked_before_is_the_same(self):
        first = self.check()
        self.assertEqual(len(self.kept()), 1)
        again = self.check()
        self.assertEqual((first.returncode, first.stdout), (again.returncode, again.stdout))

    def test_it_is_used(self):
        self.check()
        path = self.kept()[0]
        path.write_text(path.read_text().replace("refuted", "proved").replace("undecided", "proved"))
        self.assertEqual(self.check().returncode, 0)
        self.assertEqual(self.check("--no-cache").returncode, 1)

    def test_another_design_is_checked(self):
        self.check()
        self.write(HARD + "# changed\n")
        self.check()
        self.assertEqual(len(self.kept()), 2)

    def test_what_was_not_stopped_is_kept_under_a_limit_as_well(self):
        limited = self.check("--timeout", "1000")
        self.assertEqual(len(self.kept()), 1)
        path = self.kept()[0]
        path.write_text(path.read_text().replace("refuted", "proved").replace("undecided", "proved"))
        self.assertEqual(limited.returncode, 1)
        self.assertEqual(self.check("--timeout", "1000").returncode, 0)
        self.assertEqual(self.check().returncode, 0)

    def test_what_a_limit_stopped_is_not_kept(self):
        self.write((ROOT / "designs/models/aranovskiy.toml").read_text() + "\n[require]\nfrequency_error_below = 0.05\n")
        result = self.check("--timeout", "0.001")
        self.assertIn("undecided: ", result.stdout)
        self.assertEqual(self.kept(), [])

    def test_what_was_cut_short_is_read_where_it_is_decided(self):
        self.check()
        path = self.kept()[0]
        text = path.read_text().replace('"cut_short":false', '"cut_short":true')
        path.write_text(text.replace("refuted", "proved"))
        self.assertEqual(self.check().returncode, 1)  # with an UNDECIDED in it: checked again
        path.write_text(text.replace("refuted", "proved").replace("undecided", "proved"))
        self.assertEqual(self.check().returncode, 0)

    def test_what_others_can_write_to_is_not_read(self):
        self.check()
        path = self.kept()[0]
        path.write_text(path.read_text().replace("refuted", "proved").replace("undecided", "proved"))
        path.chmod(0o666)
        self.assertEqual(self.check().returncode, 1)

    @takes_long
    def test_what_makes_no_sense_is_not_read(self):
        self.check()
        path = self.kept()[0]
        heading = path.read_text().splitlines()[0]
        for text in ("", "\n", heading, heading + "\n{}", heading + '\n{"seconds": 0, "requirements": 3}', "x" * 100):
            with self.subTest(text=text[-20:]):
                path.write_text(text)
                path.chmod(0o600)
                self.assertEqual(self.check().returncode, 1)

    def test_without_a_folder_to_write_to_it_is_checked(self):
        self.cache.rmdir()
        self.cache.write_text("a file")
        self.assertEqual(self.check().returncode, 1)


class Annotations(CliTestCase):
    def test_github_is_told_where(self):
        self.write(HARD)
        self.write(DESIGN.replace("q1 =", "q3 ="), "bad: 50 %.toml")
        result = self.run_here("check", "design.toml", "bad: 50 %.toml", env={**os.environ, "GITHUB_ACTIONS": "true"})
        told = [line for line in result.stdout.splitlines() if line.startswith("::error ")]
        self.assertEqual(len(told), 3, result.stdout)
        self.assertTrue(told[0].startswith(f"::error file=design.toml,line={HARD_LINES[0]},col="), told[0])
        self.assertIn(",title=refuted::", told[0])
        self.assertTrue(told[2].startswith("::error file=bad%3A 50 %25.toml,line=5,col=1,title=bad-input::"), told[2])
        self.assertEqual(result.returncode, 2)


if __name__ == "__main__":
    unittest.main()
