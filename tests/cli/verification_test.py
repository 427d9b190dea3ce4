"""certify and check ask the checker beside the program, and say what it said."""

import functools
import json
import os
import re
import shlex
import shutil
import subprocess
import unittest
import xml.etree.ElementTree

from support import DESIGN, PROGRAM, CliTestCase, run, scratch_folder

CHECKER = os.environ["VERITRACK_VERIFY"]
REQUIRED = DESIGN + "\n[require]\nfrequency_error_below = 0.05\nsettles_within = 1\nsettled_below = 0.001\n"
REFUSAL = {"verified": False, "parts": [{"name": "design", "objections": []},
                                        {"name": "the set *x*", "objections": ["the radius", "the\trate"]}]}
VERIFIED = re.compile(r"VERIFIED by veritrack-verify in [0-9]+\.[0-9] s")


@functools.cache
def unverified():
    """The folder for REQUIRED that nobody has verified."""
    folder = scratch_folder()
    (folder / "design.toml").write_text(REQUIRED)
    assert run("certify", "--no-verify", "design.toml", "--out", "out", cwd=folder).returncode == 1
    text = (folder / "out/certificate.md").read_text()
    assert "\n*Not verified* when this document was written. To verify it:\n" in text
    return folder / "out"


class Verification(CliTestCase):
    def with_checker(self, script=None):
        """A copy of the program beside a checker that answers so after the right version; beside none without it."""
        program = self.folder / "bin/veritrack"
        program.parent.mkdir()
        shutil.copy(PROGRAM, program)
        if script is not None:
            version = subprocess.run([CHECKER, "--version"], capture_output=True, text=True, check=True).stdout
            checker = program.with_name("veritrack-verify")
            checker.write_text(f"#!/bin/sh\nif [ \"$1\" = --version ]; then echo {shlex.quote(version)}; exit; fi\n{script}\n")
            checker.chmod(0o755)

        return lambda *arguments: subprocess.run([program, *arguments], cwd=self.folder, capture_output=True, text=True,
                                                 check=False)

    def document(self, folder="out"):
        return (self.folder / folder / "certificate.md").read_text()

    def test_a_certificate_is_verified_with_all_its_documents(self):
        self.write(REQUIRED)
        result = self.run_here("certify", "--quiet", "design.toml", "--out", "out", "--html")
        self.assertEqual((result.returncode, result.stderr), (1, ""))
        lines = result.stdout.splitlines()
        self.assertEqual(len(lines), 2)
        self.assertTrue(lines[0].startswith("out/certificate.md: NOT PROVED. "), lines[0])
        self.assertRegex(lines[1], VERIFIED)
        self.assertTrue("<em>Verified</em> by " in (self.folder / "out/certificate.html").read_text())
        # To repeat it, with the design beside the documents.
        text = self.document()
        self.write(REQUIRED, "out/design.toml")
        command = re.search(r"^\*Verified\* by `veritrack-verify` .* To repeat it:\n\n```\n(.*)\n```$", text, re.MULTILINE)[1]
        words = shlex.split(command)
        self.assertEqual(words[0], "veritrack-verify")
        again = subprocess.run([CHECKER, *words[1:]], cwd=self.folder / "out", capture_output=True, text=True, check=False)
        self.assertEqual(again.returncode, 1, again.stdout)  # not everything that is required is proved
        for part in ("the design file", "the document certificate.md", "the document published-theorems.md"):
            self.assertRegex(again.stdout, rf"(?m)^verified +{part}$")
        # Nothing else depends on it, and no time is in it.
        said = re.compile(r"^\*(Verified|Not verified)\* .*$", re.MULTILINE)
        self.assertEqual(said.sub("", text), said.sub("", (unverified() / "certificate.md").read_text()))
        for name in ("certificate.json", "report.json", "published-theorems.md"):
            self.assertEqual((self.folder / "out" / name).read_bytes(), (unverified() / name).read_bytes())

    def test_without_a_checker(self):
        self.write(REQUIRED)
        copy = self.with_checker()
        result = copy("certify", "design.toml", "--out", "out")
        self.assertEqual(result.returncode, 1, "as it is without asking")
        self.assertEqual(len(result.stdout.splitlines()), 1)
        self.assertEqual(result.stderr.splitlines()[0],
                         "design.toml: will not be verified: veritrack-verify is not beside veritrack; "
                         "`ninja -C build/release veritrack-verify` builds it")
        self.assertEqual(self.document(), (unverified() / "certificate.md").read_text())
        asked = copy("check", "--verify", "design.toml", "--junit", "junit.xml", "--sarif", "checked.sarif", "--json", "checked.json")
        self.assertEqual(asked.returncode, 2)
        self.assertIn("veritrack-verify is not beside veritrack", asked.stderr)
        for report in ("junit.xml", "checked.sarif", "checked.json"):
            self.assertIn("veritrack-verify is not beside veritrack", (self.folder / report).read_text())

    def test_a_checker_of_another_release(self):
        self.write(REQUIRED)
        copy = self.with_checker("exit 0")
        checker = self.folder / "bin/veritrack-verify"
        checker.write_text(checker.read_text().replace("veritrack-verify 0", "veritrack-verify 10"))
        result = copy("certify", "design.toml", "--out", "out")
        self.assertRegex(result.stderr, r"will not be verified: the veritrack-verify beside veritrack is not that of release")
        self.assertEqual(self.document(), (unverified() / "certificate.md").read_text())

    def test_an_interruption_leaves_out_what_is_not_done(self):
        self.write(REQUIRED)
        result = self.with_checker("kill -INT $PPID; kill -INT $$")("certify", "--quiet", "design.toml", "--out", "out")
        self.assertEqual((result.returncode, len(result.stdout.splitlines())), (1, 1), result.stdout)
        self.assertEqual(result.stderr, "design.toml: not verified: interrupted\n")
        self.assertEqual(self.document(), (unverified() / "certificate.md").read_text())

    def test_what_the_checker_refuses(self):
        self.write(DESIGN)
        copy = self.with_checker(f"printf %s {shlex.quote(json.dumps(REFUSAL))}; exit 3")
        result = copy("certify", "design.toml", "--out", "out", "--html")
        self.assertEqual((result.returncode, result.stderr), (1, ""))
        self.assertEqual(result.stdout, "out/certificate.md: NOT VERIFIED. Nothing is required of this design\n"
                         "NOT VERIFIED: veritrack-verify refuses 1 of 2 parts: the set *x* (the radius; the\\x09rate)\n")
        text = self.document()
        self.assertTrue(text.startswith("# NOT VERIFIED. Nothing is required of this design\n"))
        self.assertRegex(text, r"\n\*NOT VERIFIED\*: `veritrack-verify` \S+ refuses 1 of 2 parts: the set \\\*x\\\*\. ")
        self.assertTrue("<title>NOT VERIFIED. " in (self.folder / "out/certificate.html").read_text())
        self.assertNotIn("*Verified*", text)

    def test_an_answer_that_is_none(self):
        self.write(DESIGN)
        fine = {"verified": True, "parts": [{"name": "design", "objections": []}]}
        copy = self.with_checker("")
        checker = self.folder / "bin/veritrack-verify"
        start = checker.read_text()
        for script, why in {
                "kill -9 $$": "it was ended by signal 9",
                "echo no memory >&2; exit 2": "exit status 2: no memory",
                "exit 0": "its answer cannot be read",
                "echo '{\"verified\": true}'": "its answer cannot be read",
                "echo '[[['": "its answer cannot be read",
                f"echo '{json.dumps(fine)}'; exit 3": "its answer contradicts itself",
                f"echo '{json.dumps({**fine, 'parts': []})}'": "its answer contradicts itself",
                f"echo '{json.dumps({**fine, 'verified': False})}'": "its answer contradicts itself",
                f"echo '{json.dumps(fine)}'; exit 139": "exit status 139: "}.items():
            with self.subTest(script=script):
                checker.write_text(start + script + "\n")
                result = copy("check", "--verify", "design.toml")
                self.assertEqual((result.returncode, result.stdout), (2, ""))
                self.assertEqual(result.stderr, f"design.toml: veritrack-verify gave no answer: {why}\n")
        result = copy("certify", "design.toml", "--out", "out")
        self.assertEqual((result.returncode, result.stderr), (1, ""))
        self.assertEqual(result.stdout.splitlines()[1], f"NOT VERIFIED: veritrack-verify gave no answer: {why}")
        self.assertTrue(self.document().startswith("# NOT VERIFIED. "))
        # The fake is taken at its word otherwise, so that the above is about the answers.
        checker.write_text(start + f"echo '{json.dumps(fine)}'\n")
        self.assertEqual(copy("check", "--verify", "design.toml").stdout, "design.toml: nothing required, verified\n")

    def test_check_says_what_is_verified(self):
        self.write(REQUIRED)
        self.write(DESIGN, "nothing.toml")
        arguments = ("check", "--verify", "design.toml", "nothing.toml", "--json", "report.json", "--junit", "report.xml")
        first = self.run_here(*arguments)
        self.assertEqual(first.returncode, 1, first.stderr)
        self.assertEqual([line.split(": ")[1] for line in first.stdout.splitlines()],
                         ["proved, verified", "undecided", "nothing required, verified", "1 undecided, 1 with nothing required"])
        designs = json.loads((self.folder / "report.json").read_text())["designs"]
        self.assertEqual([design["verified"] for design in designs], [True, True])
        again = self.run_here(*arguments)
        self.assertEqual(again.stdout, first.stdout, "what is remembered")
        unasked = self.run_here("check", "design.toml", "--json", "report.json")
        self.assertEqual([line.split(": ")[1] for line in unasked.stdout.splitlines()], ["proved", "undecided"])
        self.assertNotIn("verified", (self.folder / "report.json").read_text())

    def test_check_decides_nothing_that_is_refused(self):
        self.write(REQUIRED)
        self.write(DESIGN, "nothing.toml")
        copy = self.with_checker(f"printf %s {shlex.quote(json.dumps(REFUSAL))}; exit 3")
        self.run_here("check", "design.toml", "nothing.toml")  # what is remembered was not verified
        why = "veritrack-verify refuses 1 of 2 parts: the set *x* (the radius; the\\x09rate)"
        result = copy("check", "--verify", "design.toml", "nothing.toml", "--json", "report.json", "--junit", "report.xml",
                     "--sarif", "report.sarif")
        self.assertEqual(result.returncode, 1, result.stderr)
        lines = result.stdout.splitlines()
        self.assertEqual(len(lines), 4)
        for line in lines[:2]:
            self.assertRegex(line, rf"^design.toml:[0-9]+: undecided: .* \(not verified: {re.escape(why)}\)$")
        self.assertEqual(lines[2:], ["nothing.toml: not verified: " + why, "2 designs: 2 undecided"])
        designs = json.loads((self.folder / "report.json").read_text())["designs"]
        self.assertEqual([design["verified"] for design in designs], [False, False])
        self.assertEqual((designs[0]["verdict"], designs[1]["error"]["kind"]), ("undecided", "not-verified"))
        suites = xml.etree.ElementTree.parse(self.folder / "report.xml").getroot()
        self.assertEqual([(suite.get("failures"), suite.get("errors")) for suite in suites], [("2", "0"), ("0", "1")])
        rules = [each["ruleId"] for each in json.loads((self.folder / "report.sarif").read_text())["runs"][0]["results"]]
        self.assertEqual(rules[2], "not-verified")


if __name__ == "__main__":
    unittest.main()
