"""The folder of a certificate for a recursion that a user has written down."""

import re
import unittest

from documents import read_documents
from support import ROOT, CliTestCase

DESIGN = ROOT / "designs" / "models" / "aranovskiy.toml"


class ModelDocuments(CliTestCase):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.text = DESIGN.read_text().replace("[0.09, 0.11]", "[0.1, 0.101]")  # seconds; make verify takes the whole band

    def certify(self, text):
        self.write(text)
        result = self.run_here("certify", "--no-verify", "design.toml", "--out", "out")
        self.assertIn(result.returncode, (0, 1), result.stderr)
        return result, (self.folder / "out" / "certificate.md").read_text()

    def test_a_certified_model_has_all_its_files(self):
        require = "\n[require]\nfrequency_error_below = 0.05\nripple_below = 0.001\n"
        result, document = self.certify(self.text + require)
        self.assertEqual(result.returncode, 0, result.stdout)
        self.assertEqual(self.files(), ["out/certificate.json", "out/certificate.md", "out/figures/bias.svg",
                                        "out/figures/reach.svg", "out/figures/tolerance.svg",
                                        "out/figures/tube.svg", "out/report.json"])
        self.assertTrue(document.startswith("# PROVED: the frequency error stays below 0.05 rad/sample for ever; "
                                            "PROVED: the frequency error varies by at most 0.001 rad/sample\n"))
        sections = re.findall(r"^## (.*)$", document, re.MULTILINE)
        self.assertEqual(sections, ["What was required", "The design and what is assumed",
                                    "The errors of this loop over the phase", "The certified sets",
                                    "Bias and ripple", "The recursion",
                                    "What this certificate covers, and what it does not",
                                    "What the checker verifies", "How to reproduce it"])
        for figure in re.findall(r"\]\((figures/[^)]*)\)", document):
            self.assertIn("</svg>", (self.folder / "out" / figure).read_text())
        self.assertEqual(document.count("](figures/"), 4)
        certificate, report = read_documents(self.folder / "out")
        linear = report["linear_worst_case"]
        self.assertIs(linear["proved"], False)
        self.assertLess(linear["undisturbed"], linear["disturbed"])
        self.assertGreater(linear["bound_over_it"], 1.0)
        self.assertIn(f"The certified bound in the long run is {linear['bound_over_it']:.2f} times as large.", document)
        self.assertEqual([tubes["name"] for tubes in certificate["tubes"]][:2], ["starts", "assumed"])
        # Simulations come close to what is proved, and never reach it.
        shares = re.search(r": ([0-9.]+) of the certified bound\. After the first sample it reached at most ([0-9.]+)",
                           document)
        self.assertLessEqual(float(shares[1]), 1.0)
        self.assertLessEqual(float(shares[2]), 1.0)
        self.assertNotIn("ALARM", document)

    def test_a_start_that_is_known_is_followed_into_the_set(self):
        text = self.text.replace("[0.1, 0.101]", "[0.1, 0.1005]").replace("noise = 0.01", "noise = 0.005")
        known = "start_exactly = { x = 0, sigma = -0.01, theta = -0.01 }\n"
        result, document = self.certify(text + known + "\n[require]\ncaptured_within = 100\n")
        self.assertEqual(result.returncode, 0, result.stdout)
        self.assertTrue(document.startswith('# PROVED: the tracker is in the set "assumed" of the certificate after at '
                                            'most 100 samples, and there the frequency error stays at or below '))
        certificate, _ = read_documents(self.folder / "out")
        capture = next(claim for claim in certificate["claims"] if claim["id"] == "model/capture")
        self.assertLess(int(capture["samples"]), 100)
        self.assertIn(". started exactly in {x: 0, sigma: -0.01, theta: -0.01} at any phase of the signal\n", document)
        self.assertIn('): the tracker is in the set "assumed" of the certificate after at most '
                      f'{capture["samples"]} samples', document)
        self.assertIn("`x = 0`, `sigma = -0.01`, `theta = -0.01`", document)
        # Where nothing moves it towards the signal, it does not come there.
        result, document = self.certify(text + known.replace("-0.01", "1"))
        self.assertIn("That the tracker comes from its start, `start_exactly`, into the set is not proved: ", document)
        certificate, _ = read_documents(self.folder / "out")
        self.assertNotIn("model/capture", [claim["id"] for claim in certificate["claims"]])

    def test_gaussian_noise_has_a_section_and_a_probability(self):
        result, document = self.certify((ROOT / "tests" / "certificates" / "model-gaussian.toml").read_text())
        self.assertEqual(result.returncode, 0, result.stdout)
        self.assertRegex(document, r"\A# PROVED: the probability of losing lock, its frequency error exceeding [0-9.]+ "
                                   r"rad/sample, is below 1e-4 within any 1e4 successive samples, however late\n")
        self.assertIn("## Gaussian noise: the probability of losing lock\n", document)
        self.assertNotRegex(document, r"stays at or below [^;.]* for ever")
        certificate, _ = read_documents(self.folder / "out")
        self.assertEqual([tubes["name"] for tubes in certificate["tubes"] if "gaussian" in tubes],
                         ["gaussian", "lowest-snr"])
        lowest = next(claim for claim in certificate["claims"] if claim["id"] == "model/lowest-snr")
        self.assertLess(float(lowest["snr_db"]), 24.0)
        rows = re.findall(r"^\| (1e\+0\d) \| ([0-9.e-]+) \|$", document, re.MULTILINE)
        self.assertEqual([row[0] for row in rows], ["1e+03", "1e+04", "1e+06", "1e+08", "1e+09"][:len(rows)])
        probabilities = [float(row[1]) for row in rows]
        self.assertEqual(probabilities, sorted(probabilities))

    def test_the_same_bytes_twice(self):
        _, first = self.certify(self.text)
        figures = [path.read_bytes() for path in sorted((self.folder / "out" / "figures").iterdir())]
        _, second = self.certify(self.text)
        self.assertEqual(first, second)
        self.assertEqual(figures, [path.read_bytes() for path in sorted((self.folder / "out" / "figures").iterdir())])

    def test_what_cannot_be_proved_says_why(self):
        result, document = self.certify(self.text.replace("noise = 0.01", "noise = 3") +
                                        "\n[require]\nfrequency_error_below = 0.05\n")
        self.assertEqual(result.returncode, 1)
        self.assertIn("The set for the assumed noise was not proved by tubes for the whole band.", document)
        self.assertIn("| the assumed noise | 3 | none | not proved |", document)


if __name__ == "__main__":
    unittest.main()
