"""veritrack tune: what it refuses. What it finds takes minutes: nightly/tune_test.py."""

import unittest

from support import DESIGN, CliTestCase


class Tune(CliTestCase):
    def test_another_objective_is_refused(self):
        self.write(DESIGN)
        result = self.run_here("tune", "design.toml", "--objective", "beauty")
        self.assertEqual(result.returncode, 2)
        self.assertIn("allowed: long-run, for-ever, radius, noise, slew", result.stderr)

    def test_gaussian_noise_says_what_is_needed(self):
        self.write(DESIGN.replace("noise = 0.001", "noise = { snr_db = 20 }\nsamples = 1e6"))
        result = self.run_here("tune", "design.toml")
        self.assertEqual(result.returncode, 1)
        self.assertIn("Tuning needs noise with a bound", result.stdout)


if __name__ == "__main__":
    unittest.main()
