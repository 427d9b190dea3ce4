"""veritrack tune of the quadrature tracker: design values for the best certified value."""

import json
import re
import unittest

from support import DESIGN, CliTestCase

POOR = (DESIGN.replace("q1 = 0.0023", "q1 = 0.1   # too much").replace("q2 = 0.0023", "q2 = 0.3")
        .replace("noise = 0.001", "noise = 0.02"))


class Tune(CliTestCase):
    def tune(self, text, *options, status=0):
        self.write(text)
        result = self.run_here("tune", "design.toml", "--out", "tuned.toml", *options)
        self.assertEqual(result.returncode, status, result.stdout + result.stderr)
        return result.stdout

    def test_the_bound_of_the_long_run_becomes_smaller_and_is_certified(self):
        told = self.tune(POOR)
        before, after = map(float, re.search(r"long run goes from ([\d.e-]+) rad/sample to ([\d.e-]+) rad/sample", told).groups())
        self.assertLess(after, 0.5 * before)
        self.run_here("certify", "tuned.toml", "--out", "out")
        claims = json.loads((self.folder / "out/certificate.json").read_text())["claims"]
        evidence = next(claim["evidence"] for claim in claims if claim["id"] == "ekf/guarantee")
        self.assertLessEqual(float.fromhex(evidence["ultimate_frequency_error"]["hi"]), after)

    def test_the_file_keeps_its_words(self):
        self.tune(POOR, "--objective", "noise")
        tuned = (self.folder / "tuned.toml").read_text()
        self.assertIn("# too much", tuned)
        changed = [(old, new) for old, new in zip(POOR.splitlines(), tuned.splitlines(), strict=True) if old != new]
        self.assertEqual([old.split()[0] for old, _ in changed], ["q1", "q2"])

    def test_what_is_required_comes_first(self):
        told = self.tune(POOR + "\n[require]\nlargest_noise_at_least = 0.07\n")
        self.assertIn("PROVED: at a constant frequency, the tracker tolerates noise up to 0.07", told)

    def test_what_no_values_meet_says_what_is_tolerated(self):
        told = self.tune(POOR + "\n[require]\nlargest_noise_at_least = 0.9\n", status=1)
        self.assertIn("Not all that is required was certified with any q1 and q2 that were tried.", told)
        self.assertRegex(told, r"noise up to 0\.\d+ of the amplitude")


if __name__ == "__main__":
    unittest.main()
