"""veritrack tune: what it writes and what it refuses. What it finds takes minutes: nightly/tune_test.py."""

import csv
import signal
import subprocess
import unittest

from support import DESIGN, PROGRAM, CliTestCase

GAUSSIAN = DESIGN.replace("noise = 0.001", "noise = { snr_db = 30 }\nsamples = 1e6")
POOR = (DESIGN.replace("q1 = 0.0023", "q1 = 0.1   # too much").replace("q2 = 0.0023", "q2 = 0.3")
        .replace("noise = 0.001", "noise = 0.02"))


class Tune(CliTestCase):
    def test_an_objective_that_is_unknown_or_does_not_fit_is_refused(self):
        self.write(DESIGN)
        result = self.run_here("tune", "design.toml", "--objective", "beauty")
        self.assertEqual(result.returncode, 2)
        self.assertIn("allowed: long-run, for-ever, radius, noise, slew, rms, lowest-snr, simulated-rms", result.stderr)
        result = self.run_here("tune", "design.toml", "--objective", "rms")
        self.assertEqual(result.returncode, 2)
        self.assertRegex(result.stderr, r"design.toml:\d+:\d+: .*the objective rms does not fit noise with a bound")
        self.write(GAUSSIAN)
        result = self.run_here("tune", "design.toml", "--objective", "slew")
        self.assertEqual(result.returncode, 2)
        self.assertIn("allowed: rms, lowest-snr, simulated-rms", result.stderr)

    def test_a_few_designs_give_a_file_a_certificate_and_a_figure(self):
        self.write(POOR)
        result = self.run_here("tune", "design.toml", "--designs", "3")
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
        self.write(DESIGN.replace("noise = 0.001", "noise = 0.02") + "\n[require]\nfrequency_error_below = 0.02\n")
        result = self.run_here("tune", "design.toml", "--designs", "2", "--no-certificate")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertRegex(result.stdout, r"Required: 0.02 rad/sample for ever; certified: 0\.\d+ rad/sample.")
        self.assertRegex(result.stdout, r"would be certified with noise of at most 0\.0\d+ signal units \(in place of 0.02\)")
        self.assertEqual(self.files(), [])
        self.assertTrue((self.folder / "design-tuned.toml").is_file())

    def test_a_leak_is_free_or_is_not(self):
        self.write(GAUSSIAN.replace("epsilon = 0.0", "epsilon = 0.01"))
        result = self.run_here("tune", "design.toml")
        self.assertEqual(result.returncode, 1)
        self.assertIn("--free-leak lets it become 0", result.stdout)

    def test_a_time_limit_and_ctrl_c_give_the_best_so_far(self):
        self.write(POOR)
        result = self.run_here("tune", "design.toml", "--timeout", "0.001", "--no-certificate")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("The time limit ended the search after 1 designs", result.stdout)
        process = subprocess.Popen([PROGRAM, "tune", "design.toml", "--designs", "10000", "--no-certificate"],
                                   cwd=self.folder, stdout=subprocess.PIPE, text=True)
        with self.assertRaises(subprocess.TimeoutExpired):
            process.wait(timeout=2)
        process.send_signal(signal.SIGINT)
        told, _ = process.communicate(timeout=120)
        self.assertEqual(process.returncode, 0)
        self.assertIn("The time limit ended the search", told)


if __name__ == "__main__":
    unittest.main()
