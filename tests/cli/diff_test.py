"""veritrack diff: what became better or worse."""

import json
import re
import shutil
import unittest

from support import DESIGN, ROOT, CliTestCase

ACCEPTED = ROOT / "tests/certificates/accepted"
REQUIRED = "\n[require]\nfrequency_error_below = 0.05\n"


class Diff(CliTestCase):
    def setUp(self):
        super().setUp()
        shutil.copy(ACCEPTED / "contraction.json", self.folder / "old.json")

    def changed(self, change):
        """contraction.json with a change, compared with the old one."""
        certificate = json.loads((self.folder / "old.json").read_text())
        change(certificate)
        (self.folder / "new.json").write_text(json.dumps(certificate))
        result = self.run_here("diff", "old.json", "new.json")
        self.assertEqual(result.stderr, "")
        return result

    def value_of(self, certificate, name, end):
        for claim in certificate["claims"]:
            if name in claim["evidence"]:
                yield claim["evidence"][name], end

    def test_the_same_is_the_same(self):
        result = self.run_here("diff", "old.json", "old.json")
        self.assertEqual((result.returncode, result.stdout), (0, "0 better, 0 worse\n"), result.stderr)

    def test_a_larger_bound_is_worse_and_a_smaller_one_better(self):
        for factor, status, word in ((1.5, 1, "worse"), (0.5, 0, "better")):
            def change(certificate, factor=factor):
                for value, end in self.value_of(certificate, "frequency_error_bound", "hi"):
                    value[end] = (float.fromhex(value[end]) * factor).hex()
            result = self.changed(change)
            self.assertEqual(result.returncode, status)
            self.assertTrue(result.stdout.startswith(f"{word:<9}frequency error, for ever: "), result.stdout)

    def test_less_tolerated_noise_is_worse(self):
        def change(certificate):
            for value, end in self.value_of(certificate, "largest_noise", "lo"):
                value[end] = (float.fromhex(value[end]) * 0.9).hex()
        result = self.changed(change)
        self.assertEqual(result.returncode, 1)
        self.assertIn("worse    tolerated noise, of the amplitude: ", result.stdout)

    def test_less_than_a_thousandth_is_nothing(self):
        def change(certificate):
            for value, end in self.value_of(certificate, "frequency_error_bound", "hi"):
                value[end] = (float.fromhex(value[end]) * 1.0005).hex()
        self.assertEqual(self.changed(change).stdout, "0 better, 0 worse\n")
        self.assertEqual(self.run_here("diff", "old.json", "new.json", "--tolerance", "1e-4").returncode, 1)

    def test_what_is_no_longer_proved_is_worse(self):
        def change(certificate):
            certificate["claims"] = [c for c in certificate["claims"] if c["id"] != "ekf/settling-time"]
            certificate["verdict"] = "undecided"
        result = self.changed(change)
        self.assertEqual(result.returncode, 1)
        self.assertIn("worse    what is required: proved -> undecided\n", result.stdout)
        self.assertIn("worse    ekf/settling-time: proved -> not said\n", result.stdout)

    def test_another_design_is_told(self):
        result = self.changed(lambda c: c["design"]["design"]["q1"].update(text="0.003", lo="0x1p-9", hi="0x1p-8"))
        self.assertEqual(result.returncode, 0)
        self.assertEqual(result.stdout, "changed  design.q1: 0.0023 -> 0.003\n0 better, 0 worse\n")

    def test_designs_are_certified_first(self):
        self.write(DESIGN + REQUIRED, "old.toml")
        self.write(DESIGN.replace("noise = 0.001", "noise = 0.02") + REQUIRED, "new.toml")
        result = self.run_here("diff", "old.toml", "new.toml")
        self.assertEqual(result.returncode, 1, result.stderr)
        self.assertIn("better   assume.noise: 0.001 -> 0.02 (covers more)\n", result.stdout)
        self.assertIn("worse    frequency error, in the long run: ", result.stdout)

    def test_a_bound_that_is_worse_is_accepted_by_its_name(self):
        def change(certificate):
            for value, end in self.value_of(certificate, "frequency_error_bound", "hi"):
                value[end] = (float.fromhex(value[end]) * 1.5).hex()
        self.assertIn("(frequency_error_bound)\n", self.changed(change).stdout)
        result = self.run_here("diff", "old.json", "new.json", "--accept", "frequency_error_bound")
        self.assertEqual(result.returncode, 0, result.stdout)
        self.assertTrue(result.stdout.startswith("accepted frequency error, for ever: "), result.stdout)
        self.assertTrue(result.stdout.endswith("\n0 better, 0 worse, 1 accepted\n"), result.stdout)

    def test_what_is_not_worse_cannot_be_accepted(self):
        for key in ("assume.noise", "assume.nosie", "design.q1", ""):
            result = self.run_here("diff", "old.json", "old.json", "--accept", key)
            self.assertEqual((result.returncode, result.stdout), (2, ""), key)
            self.assertIn("is the key of nothing that is worse", result.stderr)

    def test_what_is_no_certificate_is_bad_input(self):
        self.write("{}", "empty.json")
        for old in ("empty.json", "nowhere.json", "."):
            result = self.run_here("diff", old, "old.json")
            self.assertEqual(result.returncode, 2, old)
            self.assertIn("allowed: a design file (*.toml), a certificate.json or its folder", result.stderr)


TEXTS = ROOT / "tests/certificates"
HERTZ = DESIGN.replace("amplitude = 1.0\n", "amplitude = 1.0\nsample_rate = 8000\n", 1)


class LoosenedContracts(CliTestCase):
    """Each is PROVED before and after, and `check` has nothing to say of it."""

    def loosen(self, before, after, key, told):
        """Two files of the folder. `told`: the line for `key`, which is accepted in the end, with what became worse
        beside it."""
        result = self.run_here("diff", before, after)
        self.assertEqual((result.returncode, result.stderr), (1, ""), result.stdout)
        self.assertTrue(result.stdout.startswith(f"worse    {told}\n"), result.stdout)
        self.assertIn("\n0 better, ", result.stdout)
        if "easier   " in result.stdout:
            self.assertIn(f"better for an easier question, which do not count: {key} covers less\n", result.stdout)
        beside = re.findall(r"^worse .*\((\w+)\)$", result.stdout.replace(told, ""), re.MULTILINE)
        accepted = self.run_here("diff", before, after, "--accept", key, *(f"--accept={name}" for name in set(beside)))
        self.assertEqual((accepted.returncode, accepted.stderr), (0, ""), accepted.stdout)
        self.assertTrue(accepted.stdout.startswith(f"accepted {told}\n"), accepted.stdout)
        self.assertTrue(accepted.stdout.endswith(f"\n0 better, 0 worse, {1 + len(beside)} accepted\n"), accepted.stdout)
        # The other way round it asks for more.
        self.assertTrue(self.run_here("diff", after, before).stdout.startswith(f"better   {key}: "))

    def loosen_design(self, before, old, new, key, told):
        self.assertIn(old, before)
        self.write(before, "old.toml")
        self.write(before.replace(old, new), "new.toml")
        self.loosen("old.toml", "new.toml", key, told)

    def test_a_requirement_of_400_hz_for_40(self):
        self.loosen_design(HERTZ + "\n[require]\nfrequency_error_below = { hz = 40 }\n", "{ hz = 40 }", "{ hz = 400 }",
                    "require.frequency_error_below",
                    "require.frequency_error_below: 40 Hz -> 400 Hz (asks for less)")

    def test_less_noise(self):
        self.loosen_design(DESIGN + REQUIRED, "noise = 0.001", "noise = 0.0001", "assume.noise",
                    "assume.noise: 0.001 -> 0.0001 (covers less)")

    def test_a_narrower_band(self):
        self.loosen_design(DESIGN + REQUIRED, "[0.05, 3.0]", "[0.5, 2.5]", "assume.frequency",
                    "assume.frequency: [0.05, 3.0] -> [0.5, 2.5] (covers less)")

    def test_one_amplitude_for_a_range(self):
        self.loosen_design((TEXTS / "dft-block-covariance.toml").read_text(), "[0.99, 1.01]", "1", "assume.amplitude",
                    "assume.amplitude: [0.99, 1.01] -> 1 (covers less)")

    def test_fewer_samples(self):
        # Of certificates: to certify in Gaussian noise takes minutes.
        certificate = json.loads((ACCEPTED / "lock.json").read_text())
        self.assertEqual(certificate["design"]["assume"]["samples"]["text"], "1e3")
        (self.folder / "old").mkdir()
        (self.folder / "old/certificate.json").write_text(json.dumps(certificate))
        hundred = float(100).hex()
        certificate["design"]["assume"]["samples"] = {"text": "1e2", "lo": hundred, "hi": hundred}
        for claim in certificate["claims"]:
            if bound := claim["evidence"].get("probability_of_losing_lock"):
                bound["hi"] = (float.fromhex(bound["hi"]) / 10).hex()
        (self.folder / "new").mkdir()
        (self.folder / "new/certificate.json").write_text(json.dumps(certificate))
        self.loosen("old", "new", "assume.samples", "assume.samples: 1e3 -> 1e2 (covers less)")

    def test_smaller_start_errors(self):
        self.loosen_design(DESIGN + REQUIRED, "initial_phase_error = 0.005", "initial_phase_error = 0",
                           "assume.initial_phase_error", "assume.initial_phase_error: 0.005 -> 0 (covers less)")

    def test_a_requirement_that_is_gone(self):
        required = DESIGN + "\n[require]\nfrequency_error_below = 0.05\nsettles_within = 200\nsettled_below = 0.01\n"
        self.write(required, "old.toml")
        self.write(DESIGN + REQUIRED, "new.toml")
        result = self.run_here("diff", "old.toml", "new.toml")
        self.assertEqual(result.returncode, 1)
        self.assertIn("worse    require.settles_within: 200 -> not given (asks for less)\n", result.stdout)
        accepted = self.run_here("diff", "old.toml", "new.toml", "--accept", "require.settles_within",
                                 "--accept", "require.settled_below")
        self.assertEqual(accepted.returncode, 0, accepted.stdout)


if __name__ == "__main__":
    unittest.main()
