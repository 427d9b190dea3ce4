"""scripts/random-loops: what it counts, and that it fails; with programs that only say what they are told to."""

import json
import re
import subprocess
import sys
import tomllib
import unittest

from support import ROOT, CliTestCase

SCRIPT = ROOT / "scripts" / "random-loops"
KINDS = 13
SET = {"name": "starts"}
CLAIM = {"id": "model/guarantee", "verdict": "proved"}


class RandomLoops(CliTestCase):
    def program(self, name, text):
        (self.folder / name).write_text(f"#!{sys.executable}\nimport pathlib, sys\n{text}\n")
        (self.folder / name).chmod(0o755)

    def campaign(self, *options, certificate=None, certify=0, verify=1, told="VERIFIED: all 9 parts"):
        text = json.dumps({"claims": [CLAIM], "tubes": [SET]} if certificate is None else certificate)
        self.program("veritrack", f"""
if "--help" in sys.argv:
    sys.exit()
out = pathlib.Path(sys.argv[sys.argv.index("--out") + 1])
out.mkdir()
(out / "certificate.json").write_text({text!r})
sys.exit({certify})""")
        self.program("veritrack-verify", f"print({told!r})\nsys.exit({verify})")
        return subprocess.run([sys.executable, "-B", SCRIPT, self.folder, "--jobs", "2", "--keep", self.folder / "kept", *options],
                              capture_output=True, text=True, check=False, cwd=self.folder)

    def counts(self, result):
        return re.search(r"^all +(.*)$", result.stdout, re.MULTILINE)[1].split()

    def test_all_kinds_are_drawn_counted_and_fine(self):
        result = self.campaign("--count", str(2 * KINDS))
        self.assertEqual(result.returncode, 0, result.stderr)
        # loops, PROVED, UNDECIDED, VERIFIED, refused, malformed, without a set
        self.assertEqual(self.counts(result), [str(2 * KINDS), str(2 * KINDS), "0", str(2 * KINDS), "0", "0", "0"])
        designs = sorted((self.folder / "kept").glob("*/design.toml"))
        self.assertEqual(len(designs), 2 * KINDS)
        texts = [design.read_text() for design in designs]
        self.assertEqual(len(set(texts)), 2 * KINDS)
        for text in texts:
            low, high = (lambda band: band["hz"] if isinstance(band, dict) else band)(tomllib.loads(text)["assume"]["frequency"])
            self.assertLess(low, high)
            self.assertTrue(0.0 < low or "cross" in text, text)  # the samples of two channels turn either way

    def test_a_loop_of_a_seed_is_always_the_same(self):
        def text(*options):
            self.campaign("--only", "5", *options)
            kept = self.folder / "kept"
            design = next(kept.glob("*/design.toml"))
            found = design.read_text()
            kept.rename(self.folder / f"kept-{len(list(self.folder.iterdir()))}")
            return found
        self.assertEqual(text(), text())
        self.assertNotEqual(text(), text("--seed", "1"))

    def test_what_is_refused_fails(self):
        result = self.campaign("--count", "1", verify=3, told="NOT VERIFIED tubes starts\n             - a step may leave the tube")
        self.assertEqual(result.returncode, 1)
        self.assertIn("refused: tubes starts; - a step may leave the tube", result.stderr)
        self.assertEqual(self.counts(result), ["1", "1", "0", "0", "1", "0", "0"])

    def test_programs_that_fail_fail(self):
        for index, broken in enumerate(({"certify": 2}, {"certify": -11}, {"verify": 2}, {"verify": -6})):
            with self.subTest(broken=broken):
                result = self.campaign("--only", str(index), **broken)
                self.assertEqual(result.returncode, 1)
                self.assertIn("malformed", result.stderr)

    def test_proofs_of_nothing_fail(self):
        without = self.campaign("--count", "1", certificate={"claims": [CLAIM], "tubes": []})
        self.assertEqual(without.returncode, 1)
        self.assertIn("PROVED without a set", without.stderr)
        undecided = self.campaign("--only", "1", certificate={"claims": [], "tubes": []})
        self.assertEqual(undecided.returncode, 1)
        self.assertIn("only 0 of 1 loops", undecided.stderr)
        self.assertEqual(self.campaign("--only", "2", "--least-proved", "0", certificate={"claims": [], "tubes": []}).returncode, 0)
        self.assertEqual(self.campaign("--count", "0").returncode, 1)


if __name__ == "__main__":
    unittest.main()
