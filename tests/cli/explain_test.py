"""veritrack explain: what claims and keys mean."""
import fcntl
import json
import os
import pty
import re
import struct
import subprocess
import termios
import unittest

from support import PROGRAM, ROOT, run

# Claims whose ids stand in the sources as they are; those of published results are made of parts.
LITERAL = re.compile(r'"((?:ekf|kkl|model|single-channel|proposition-[12])/[a-z0-9-]+)"')
# Ids of derivations, which are no claims.
DERIVATIONS = {"single-channel/transfer-function"}


def claims_of_accepted_certificates():
    for path in sorted((ROOT / "tests/certificates/accepted").glob("*.json")):
        for claim in json.loads(path.read_text())["claims"]:
            yield claim["id"]


def claims_in_the_sources():
    for folder in ("analysis", "certificates"):
        for path in sorted((ROOT / folder).rglob("*.cpp")):
            if path.name in ("paper_places.cpp", "paper_findings.cpp", "paper_sentences.cpp"):
                continue  # beginnings of ids; and claims of the ledger, which are none of a design
            yield from (found for found in LITERAL.findall(path.read_text()) if found not in DERIVATIONS)


class Explain(unittest.TestCase):
    def test_every_claim_has_an_explanation(self):
        ids = sorted({*claims_of_accepted_certificates(), *claims_in_the_sources()})
        self.assertGreater(len(ids), 80)
        result = run("explain", *ids)
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        self.assertEqual([line for line in result.stdout.splitlines() if line in ids], ids)

    def test_the_files_that_are_named_exist(self):
        text = "".join(path.read_text() for path in (ROOT / "certificates").glob("*/*explanations.toml"))
        named = set(re.findall(r"docs/[\w./-]+\.md", text))
        self.assertGreater(len(named), 5)
        for name in named:
            self.assertTrue((ROOT / name).exists(), name)

    def test_a_key_says_its_meaning_its_unit_and_what_is_allowed(self):
        text = run("explain", "q1").stdout
        self.assertTrue(text.startswith("design.q1 (quadrature-ekf)\n  Meaning: The process noise variance"), text)
        self.assertIn("\n  Unit: signal units squared\n  Allowed: a number, 0 or more\n", text)

    def test_a_finding_in_print_is_told(self):
        text = run("explain", "theorem-2.9/b_1/printed").stdout
        self.assertIn("In print: false as stated (thesis, section 3.5", text)

    def test_without_a_word_all_are_listed_and_each_of_them_is_explained(self):
        names = [line.split(" (")[0] for line in run("explain").stdout.splitlines()[2:]]
        self.assertIn("design.q1", names)
        self.assertIn("ekf/guarantee", names)
        self.assertEqual(run("explain", *names).returncode, 0)

    def test_an_unknown_word_is_an_error_that_names_the_nearest(self):
        result = run("explain", "q1", "slwe")
        self.assertEqual(result.returncode, 2)
        self.assertIn('"slwe" is no key and no claim; nearest: slew', result.stderr)
        result = run("explain", "SNR")
        self.assertIn("it is mentioned in assume.noise, dft-block/lowest-snr, model/lowest-snr, ekf/lowest-snr;", result.stderr)

    def test_lines_are_as_wide_as_the_terminal(self):
        def longest(text):
            return max(map(len, text.splitlines()))

        self.assertLessEqual(longest(run("explain", "ekf/guarantee").stdout), 80)
        ours, theirs = pty.openpty()
        fcntl.ioctl(theirs, termios.TIOCSWINSZ, struct.pack("HHHH", 24, 50, 0, 0))
        with subprocess.Popen([PROGRAM, "explain", "ekf/guarantee"], stdout=theirs) as program:
            os.close(theirs)
            text = b""
            try:
                while piece := os.read(ours, 4096):
                    text += piece
            except OSError:  # how Linux says that the other side has closed
                pass
            self.assertEqual(program.wait(), 0)
        os.close(ours)
        self.assertLessEqual(longest(text.decode()), 50)
        self.assertGreater(longest(text.decode()), 40)


if __name__ == "__main__":
    unittest.main()
