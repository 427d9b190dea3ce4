"""The KKL observer as a user sees it: certificates of the paper's design and of variants."""

import unittest

from documents import read_documents
from support import CliTestCase

KKL = """\
name = "an observer"
tracker = "kkl-observer"

[design]
lambda = [1, 2, 3, 4]

[assume]
frequency = [3, 3]
amplitude = [2, 2]
disturbance = { amplitude = 0.2, frequency = 100.0 }
"""


def ends(quantity):
    return float.fromhex(quantity["lo"]), float.fromhex(quantity["hi"])


class KklObserver(CliTestCase):
    def certify(self, text):
        """The run, the derivations as report.json tells them, and all of report.json."""
        self.write(text)
        result = self.run_here("certify", "--no-verify", "design.toml", "--out", "out")
        self.assertIn(result.returncode, (0, 1), result.stderr)
        _, report = read_documents(self.folder / "out")
        return result, {derivation["id"]: derivation for derivation in report["derivations"]}, report

    def conditions(self, derivation):
        return {condition["id"]: condition["verdict"] for condition in derivation["conditions"]}

    def test_the_proved_ell_certifies(self):
        _, found, _ = self.certify(KKL)
        low, high = ends(found["kkl-ell"]["quantities"]["ell"])
        self.assertLess(low, 0.0014601866285)
        self.assertGreater(high, 0.0014601866285)
        self.assertLessEqual(high - low, 1e-9 * low)
        for solver in ("ell_ipopt", "ell_nlopt", "ell_nlopt_global"):
            quantity = found["kkl-ell"]["quantities"][solver]
            self.assertFalse(quantity["proved"])
            self.assertTrue(low <= ends(quantity)[0] <= high, solver)
        self.assertEqual(ends(found["kkl-ell"]["quantities"]["argmin_omega"]), (3.0, 3.0))
        robustness = found["kkl-robustness"]
        self.assertEqual(robustness["verdict"], "proved")
        for name in ("frequency_error", "amplitude_error"):
            bound = ends(robustness["quantities"][f"{name}_bound"])[1]
            seen = ends(robustness["quantities"][f"{name}_simulated"])[1]
            self.assertLessEqual(seen, bound)
            self.assertLess(bound, 1.5 * seen)
        self.assertIn("settling_time", robustness["quantities"])
        claims = self.conditions(found["kkl-paper"])
        for name in ("invariance", "determinant", "null-space", "injectivity", "mu-vanishes", "left-inverse",
                     "positive-definite", "continuity"):
            self.assertEqual(claims[name], "proved", name)
        for name in ("dimensions", "section-v-ell"):
            self.assertEqual(claims[name], "refuted", name)
        # What the scan does not show is neither proved nor refuted, and not in what the checker reads.
        self.assertEqual(claims["phase-formula"], "undecided")
        illegible, = (each for each in found["kkl-paper"]["conditions"] if each["id"] == "phase-formula")
        self.assertTrue(illegible["reason"].startswith("Illegible in the scan ("), illegible["reason"])

    def test_the_ell_of_the_paper_is_refuted_and_nothing_is_bounded(self):
        _, found, _ = self.certify(KKL.replace("4]\n\n", "4]\nell = 5\n\n", 1))
        claims = self.conditions(found["kkl-paper"])
        self.assertEqual(claims["mu-vanishes"], "refuted")
        self.assertEqual(claims["left-inverse"], "refuted")
        self.assertEqual(claims["positive-definite"], "proved")
        self.assertEqual(found["kkl-robustness"]["verdict"], "undecided")
        self.assertIn("frequency_error_bound", found["kkl-robustness"]["not_applicable"])

    def test_requirements(self):
        require = "\n[require]\nfrequency_error_below = 0.06\namplitude_error_below = 0.001\nsettles_within = 20\n"
        result, _, report = self.certify(KKL + require)
        verdicts = [claim["verdict"] for claim in report["claims"] if claim["required"]]
        self.assertEqual(verdicts, ["proved", "undecided", "proved"])
        self.assertEqual(result.returncode, 1)

    def test_a_sampling_interval_makes_it_about_the_program(self):
        require = "\n[require]\nfrequency_error_below = 0.1\n"
        continuous = KKL.replace("{ amplitude = 0.2, frequency = 100.0 }", "{ bound = 0.002 }") + require
        sampled = continuous.replace("4]\n", "4]\nsampling_interval = 1e-3\n", 1)
        words = {continuous: "filters within 1e-9 A/lambda", sampled: "samples every 1e-3 s and straight lines"}
        for text, said in words.items():
            with self.subTest(said=said):
                result, _, report = self.certify(text)
                self.assertEqual(result.returncode, 0)
                self.assertIn(said, report["claims"][0]["statement"])
                self.assertIn("in double precision", report["claims"][0]["statement"])
        undecided = KKL.replace("4]\n", "4]\nsampling_interval = 1e-3\n", 1) + require
        result, found, _ = self.certify(undecided)
        self.assertEqual(result.returncode, 1)
        self.assertIn("may have any samples", found["kkl-robustness"]["conditions"][0]["reason"])

    def test_six_filters_are_inverted_and_their_errors_bounded(self):
        require = "\n[require]\nfrequency_error_below = 0.1\n"
        result, found, report = self.certify(KKL.replace("3, 4]", "3, 4, 5, 6]") + require)
        self.assertEqual(result.returncode, 0)
        self.assertEqual(list(found), ["kkl-ell", "kkl-robustness", "kkl-paper"])
        self.assertEqual(found["kkl-ell"]["verdict"], "proved")
        claims = self.conditions(found["kkl-paper"])
        for name in ("injectivity", "mu-vanishes", "left-inverse", "positive-definite", "continuity"):
            self.assertEqual(claims[name], "proved", name)
        self.assertEqual(report["claims"][0]["verdict"], "proved")
        self.assertIn("in double precision", report["claims"][0]["statement"])
        quantities = found["kkl-robustness"]["quantities"]
        bound = float.fromhex(quantities["frequency_error_bound"]["hi"])
        simulated = float.fromhex(quantities["frequency_error_simulated"]["hi"])
        self.assertGreaterEqual(bound, simulated)
        self.assertLess(bound, 1.15 * simulated)

    def test_many_decades_end_in_verdicts(self):
        for frequency in ("[1e-3, 1e3]", "[1e-9, 1e9]", "[1e-150, 1e150]"):
            with self.subTest(frequency=frequency):
                _, found, _ = self.certify(KKL.replace("[3, 3]", frequency))
                self.assertNotEqual(self.conditions(found["kkl-paper"])["left-inverse"], "refuted")

    def test_tuning_proves_a_smaller_bound(self):
        text = KKL + "\n[require]\nsettles_within = 15\n"
        _, before, _ = self.certify(text)
        result = self.run_here("tune", "design.toml", "--out", "tuned.toml")
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
        _, after, _ = self.certify((self.folder / "tuned.toml").read_text())
        bounds = [ends(found["kkl-robustness"]["quantities"]["frequency_error_bound"])[1] for found in (before, after)]
        self.assertLess(bounds[1], 0.8 * bounds[0])

    def test_tuning_needs_a_disturbance(self):
        self.write("".join(line for line in KKL.splitlines(keepends=True) if not line.startswith("disturbance")))
        result = self.run_here("tune", "design.toml")
        self.assertEqual(result.returncode, 1)
        self.assertIn("disturbance", result.stdout)

    def test_a_map_is_refused_with_a_reason(self):
        self.write(KKL)
        result = self.run_here("map", "design.toml")
        self.assertEqual((result.returncode, result.stdout), (2, ""))
        self.assertRegex(result.stderr, r"^design\.toml:2:\d+: .*quadrature-ekf or model or dft-block-ekf\n$")


if __name__ == "__main__":
    unittest.main()
