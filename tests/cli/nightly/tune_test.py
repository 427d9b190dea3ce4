"""veritrack tune of the extended Kalman filters: design values for the best certified value."""

import csv
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
        self.run_here("certify", "--no-verify", "tuned.toml", "--out", "out")
        claims = json.loads((self.folder / "out/certificate.json").read_text())["claims"]
        evidence = next(claim["evidence"] for claim in claims if claim["id"] == "ekf/guarantee")
        self.assertLessEqual(float.fromhex(evidence["ultimate_frequency_error"]["hi"]), after)

    def test_the_file_keeps_its_words(self):
        self.tune(POOR, "--objective", "noise")
        tuned = (self.folder / "tuned.toml").read_text()
        self.assertIn("# too much", tuned)
        changed = [(old, new) for old, new in zip(POOR.splitlines(), tuned.splitlines(), strict=True) if old != new]
        self.assertEqual([old.split()[0] for old, _ in changed], ["q1", "q2", "r"])

    def test_a_few_designs_give_a_file_a_certificate_and_a_figure(self):
        self.write(POOR)
        result = self.run_here("tune", "design.toml", "--designs", "6")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(result.stderr, "")
        self.assertIn("goes from", result.stdout)
        folder = self.folder / "certificates-out/design-tuned"
        for name in ("certificate.md", "certificate.json", "tuning.md", "tuning.csv", "figures/trade-off.svg"):
            self.assertTrue((folder / name).is_file(), name)
        tuned = (self.folder / "design-tuned.toml").read_text()
        self.assertIn("# too much", tuned)
        with open(folder / "tuning.csv", newline="") as file:
            rows = list(csv.DictReader(file))
        chosen = next(row for row in rows if row["role"] == "chosen")
        for key in ("q1", "q2", "r"):
            self.assertRegex(tuned, rf"(?m)^{key} = {chosen[key]}\b")
        self.assertIn("How the values of design-tuned.toml were chosen", (folder / "tuning.md").read_text())

    def test_what_cannot_be_met_says_what_would_have_to_change(self):
        self.write(DESIGN.replace("noise = 0.001", "noise = 0.02") + "\n[require]\nfrequency_error_below = 0.009\n")
        result = self.run_here("tune", "design.toml", "--designs", "2", "--no-certificate")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertRegex(result.stdout, r"Required: 0.009 rad/sample for ever; certified: 0\.\d+ rad/sample.")
        self.assertRegex(result.stdout, r"would be certified with noise of at most 0\.0\d+ signal units \(in place of 0.02\)")
        self.assertEqual(self.files(), [])
        self.assertTrue((self.folder / "design-tuned.toml").is_file())

    def test_what_is_required_comes_first(self):
        told = self.tune(POOR + "\n[require]\nlargest_noise_at_least = 0.07\n")
        self.assertIn("PROVED: at a constant frequency, the tracker tolerates noise up to 0.07", told)

    def test_what_no_values_meet_says_what_is_tolerated(self):
        told = self.tune(POOR + "\n[require]\nlargest_noise_at_least = 0.9\n", status=1)
        self.assertRegex(told, r"Required: noise of 0.9 signal units; certified: 0\.\d+ of the amplitude.")

    def test_one_channel(self):
        text = """name = "a design"
tracker = "single-channel-ekf"
[design]
q = 0.005     # both
r = 0.01
process_noise = "identity"
[assume]
frequency = [0.8, 1.6]
noise = 0.0001
slew = 0.000005
initial_frequency_error = 0.0001
initial_phase_error = 0.0001
initial_amplitude_error = 0.0001
[require]
frequency_error_below = 0.002
"""
        told = self.tune(text, "--designs", "10")
        self.assertIn("PROVED: the frequency error stays below 0.002 rad/sample for ever", told)
        before, after = map(float, re.search(r"long run goes from ([\d.e-]+) rad/sample to ([\d.e-]+) rad/sample", told).groups())
        self.assertLess(after, before)
        tuned = (self.folder / "tuned.toml").read_text()
        self.assertRegex(tuned, r"process_noise = \{ q1 = \S+, q2 = \S+ \}")
        self.assertNotIn("# both", tuned)

    def test_gaussian_noise(self):
        told = self.tune(DESIGN.replace("noise = 0.001", "noise = { snr_db = 30 }\nsamples = 1e6") +
                         "\n[require]\nprobability_of_losing_lock_below = 1e-6\n", "--designs", "5")
        self.assertRegex(told, r"root mean square of the frequency error in lock goes from about \S+ rad/sample to about")
        self.assertRegex(told, r"Certified: a root mean square of the frequency error in lock of at most 0\.\d+ rad/sample")
        self.assertIn("PROVED: the probability of losing lock, a frequency error of 3.14 rad/sample or more, is below 1e-6", told)

    def test_gaussian_noise_with_a_leak(self):
        text = (DESIGN.replace("q1 = 0.0023", "q1 = 0.0013").replace("q2 = 0.0023", "q2 = 0.0013").replace("r = 0.05", "r = 0.01")
                .replace("epsilon = 0.0", "epsilon = 0.01").replace("frequency = [0.05, 3.0]", "frequency = [0.2, 0.9]")
                .replace("noise = 0.001", "noise = { snr_db = 22 }\nsamples = 1e6"))
        required = "\n[require]\nprobability_of_losing_lock_below = 1e-6\n"
        told = self.tune(text + required, "--designs", "5")
        before, after = map(float, re.search(r"in lock goes from about (\S+) rad/sample to about (\S+) rad/sample", told).groups())
        self.assertLessEqual(after, before)
        certified = float(re.search(r"Certified: a root mean square of .* of at most (\S+) rad/sample", told).group(1))
        self.assertLess(certified, 1.5 * after)
        self.assertIn("epsilon = 0.01", (self.folder / "tuned.toml").read_text())
        told = self.tune(text + required, "--designs", "3", "--objective", "lowest-snr", "--no-certificate")
        self.assertRegex(told, r"can be certified (goes from|is) about \S+ dB")
        self.assertIn("With a leak a certificate is about the assumed ratio only", told)


if __name__ == "__main__":
    unittest.main()
