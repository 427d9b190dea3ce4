"""veritrack tune: what it writes and what it refuses. What it finds takes minutes: nightly/tune_test.py."""

import signal
import subprocess
import unittest

from support import DESIGN, PROGRAM, ROOT, CliTestCase

GAUSSIAN = DESIGN.replace("noise = 0.001", "noise = { snr_db = 30 }\nsamples = 1e6")
ONE_CHANNEL = """name = "a design"
tracker = "single-channel-ekf"
[design]
process_noise = { q1 = 0.01, q2 = 0.01 }
r = 0.01
[assume]
frequency = [0.4, 0.6]
noise = 0.01
initial_frequency_error = 0.001
initial_phase_error = 0.001
initial_amplitude_error = 0.001
"""
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

    def test_what_has_no_certificate_is_said_at_once(self):
        self.write(GAUSSIAN.replace("epsilon = 0.0", "epsilon = 0.01").replace("samples = 1e6", "samples = 1e6\nfrequency_walk = 1e-4"))
        result = self.run_here("tune", "design.toml")
        self.assertEqual(result.returncode, 1)
        self.assertIn("With a leak and a frequency that walks nothing is certified", result.stdout)
        self.assertIn("--free-leak", result.stdout)
        self.write(ONE_CHANNEL.replace("r = 0.01", "r = 0.01\nepsilon = 0.001"))
        result = self.run_here("tune", "design.toml")
        self.assertEqual(result.returncode, 1)
        self.assertIn("no bound is certified for this tracker, only its bias", result.stdout)
        self.write(ONE_CHANNEL.replace("noise = 0.01", "noise = { snr_db = 17 }"))
        result = self.run_here("tune", "design.toml")
        self.assertEqual(result.returncode, 2)
        self.assertRegex(result.stderr, r"^design.toml:8:9: assume.noise is Gaussian, with which nothing is certified")
        self.assertIn("--objective simulated-rms", result.stderr)
        self.write(ONE_CHANNEL.replace("noise = 0.01", "noise = 0.01\nsamples = 1e6"))
        result = self.run_here("tune", "design.toml")
        self.assertIn("unknown key assume.samples; it goes with the tracker quadrature-ekf or model", result.stderr)

    def test_parameters_of_a_model_are_named_on_the_command_line(self):
        design = (ROOT / "designs" / "models" / "odrive-pll.toml").read_text()
        self.write(design)
        for over, message in ((["--over", "kp=1"], "--over: allowed: NAME=LOW:HIGH with two numbers, the lower one first"),
                              (["--over", "gain=1:2"], "there is no parameter gain; allowed: "),
                              ([], "veritrack tune needs to know which parameters may change")):
            result = self.run_here("tune", "design.toml", *over)
            self.assertEqual(result.returncode, 2)
            self.assertIn(message, result.stderr)
        result = self.run_here("tune", "design.toml", "--over", "bandwidth=200:4000", "--designs", "20", "--no-certificate")
        self.assertEqual(result.returncode, 0, result.stderr)
        shown = (ROOT / "docs" / "choosing.md").read_text()
        self.assertIn(f"--over bandwidth=200:4000 --designs 20\n{result.stdout.splitlines()[0]}\n", shown)
        self.write(DESIGN)
        result = self.run_here("tune", "design.toml", "--over", "q1=1:2")
        self.assertEqual(result.returncode, 2)
        self.assertIn("--over is for parameters that a design file names", result.stderr)

    def test_simulations_are_compared_as_they_are_where_nothing_is_required(self):
        self.write(ONE_CHANNEL.replace("r = 0.01", "r = 0.01\nepsilon = 0.001"))
        result = self.run_here("tune", "design.toml", "--objective", "simulated-rms", "--designs", "20", "--no-certificate")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("the simulated root mean square of the frequency error goes from", result.stdout)
        self.assertNotIn("certified set", result.stdout)

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
