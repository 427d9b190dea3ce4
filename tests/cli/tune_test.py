"""veritrack tune: what it writes and what it refuses. What it finds takes minutes: nightly/tune_test.py."""

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

    def test_the_file_keeps_its_words(self):
        self.write(POOR)
        result = self.run_here("tune", "design.toml", "--designs", "6", "--no-certificate", "--out", "tuned.toml")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(result.stderr, "")
        self.assertIn("goes from", result.stdout)
        tuned = (self.folder / "tuned.toml").read_text()
        self.assertIn("# too much", tuned)
        changed = [old.split()[0] for old, new in zip(POOR.splitlines(), tuned.splitlines(), strict=True) if old != new]
        self.assertEqual(changed, ["q1", "q2", "r"])
        self.assertEqual(self.files(), [])

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
