"""veritrack diff: what became better or worse."""

import json
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
            self.assertTrue(result.stdout.startswith(f"{word:<8}frequency error, for ever: "), result.stdout)

    def test_less_tolerated_noise_is_worse(self):
        def change(certificate):
            for value, end in self.value_of(certificate, "largest_noise", "lo"):
                value[end] = (float.fromhex(value[end]) * 0.9).hex()
        result = self.changed(change)
        self.assertEqual(result.returncode, 1)
        self.assertIn("worse   tolerated noise, of the amplitude: ", result.stdout)

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
        self.assertIn("worse   what is required: proved -> undecided\n", result.stdout)
        self.assertIn("worse   ekf/settling-time: proved -> not said\n", result.stdout)

    def test_another_design_is_told(self):
        result = self.changed(lambda c: c["design"]["design"]["q1"].update(text="0.003"))
        self.assertEqual(result.returncode, 0)
        self.assertTrue(result.stdout.startswith("changed design.design.q1: 0.0023 -> 0.003\n")
                        or result.stdout.startswith("changed design.q1: 0.0023 -> 0.003\n"), result.stdout)

    def test_designs_are_certified_first(self):
        self.write(DESIGN + REQUIRED, "old.toml")
        self.write(DESIGN.replace("noise = 0.001", "noise = 0.02") + REQUIRED, "new.toml")
        result = self.run_here("diff", "old.toml", "new.toml")
        self.assertEqual(result.returncode, 1, result.stderr)
        self.assertIn("changed assume.noise: 0.001 -> 0.02\n", result.stdout)
        self.assertIn("worse   frequency error, in the long run: ", result.stdout)

    def test_what_is_no_certificate_is_bad_input(self):
        self.write("{}", "empty.json")
        for old in ("empty.json", "nowhere.json", "."):
            result = self.run_here("diff", old, "old.json")
            self.assertEqual(result.returncode, 2, old)
            self.assertIn("allowed: a design file (*.toml), a certificate.json or its folder", result.stderr)


if __name__ == "__main__":
    unittest.main()
