"""veritrack certify on a design of each kind, or on all of them with VERITRACK_TEST_EFFORT above 1: the documents, whole."""

import json
import os
import re
import subprocess
import unittest
import xml.etree.ElementTree

import jsonschema
from support import DESIGN, PROGRAM, ROOT, CliTestCase

SCHEMA = json.loads((ROOT / "certificates/document/certificate.schema.json").read_text())
DESIGNS = sorted((ROOT / "designs").glob("*.toml"))
QUANTITIES = """R_x epsilon_r rho_1 rho_2 rho_3 rho_4 rho_5 delta_1 delta_2 a_1 a_2 b_1 b_2 p q s gamma beta
    one_minus_alpha epsilon_z delta_p delta_k delta_k2 zeta_z eta zeta lhs_2_43 lhs_2_44 initial_error_bound""".split()


def readings(certificate):
    """The published theorem, as it was evaluated."""
    ids = ("theorem-2.9/printed", "theorem-2.9/errata")
    found = [derivation for derivation in certificate["derivations"] if derivation["id"] in ids]
    assert len(found) == 2
    return found


class Certify(CliTestCase):
    def certify(self, design, out="out"):
        result = self.run_here("certify", design, "--out", out)
        self.assertIn(result.returncode, (0, 1), result.stderr)
        return result, json.loads((self.folder / out / "certificate.json").read_text())

    def test_there_are_designs(self):
        self.assertGreaterEqual(len(DESIGNS), 4)

    def test_every_design_gives_a_valid_certificate(self):
        validator = jsonschema.Draft202012Validator(SCHEMA)
        chosen = DESIGNS
        if float(os.environ.get("VERITRACK_TEST_EFFORT") or 1) <= 1:
            listed = subprocess.run([ROOT / "scripts/one-of-each-kind"], capture_output=True, text=True, check=True).stdout
            chosen = [ROOT / name for name in listed.split()]
            self.assertGreaterEqual(len(chosen), 4)
        for design in chosen:
            with self.subTest(design=design.name):
                result, certificate = self.certify(design, design.stem)
                self.assertEqual([], [error.message for error in validator.iter_errors(certificate)])
                required = [claim["verdict"] for claim in certificate["claims"] if claim["required"]]
                self.assertEqual(result.returncode, 0 if all(v == "proved" for v in required) else 1)
                self.assertEqual(certificate["verdict"] == "nothing-required", not required)

    def test_every_quantity_of_the_theorem_is_there(self):
        _, certificate = self.certify(ROOT / "designs/la-scala-1994-figure-3.5.toml")
        for derivation in readings(certificate):
            for name in QUANTITIES:
                quantity = derivation["quantities"][name]
                low, high = float.fromhex(quantity["lo"]), float.fromhex(quantity["hi"])
                self.assertLessEqual(low, high, name)
                self.assertLessEqual(high - low, 1e-12 * max(abs(low), abs(high)), name)

    def test_design_values_carry_their_lines(self):
        design = self.write(DESIGN)
        _, certificate = self.certify(design)
        lines = DESIGN.splitlines()
        for name, value in certificate["design"]["design"].items():
            self.assertEqual(lines[value["line"] - 1], f"{name} = {value['text']}")
        self.assertTrue(certificate["design"]["theorem_2_9"]["sigma"]["default"])

    def test_same_input_same_bytes_and_no_paths(self):
        design = self.write(DESIGN)
        self.certify(design, "folder-one")
        self.certify(design, "folder-two")
        names = sorted(p.relative_to(self.folder / "folder-one") for p in (self.folder / "folder-one").rglob("*") if p.is_file())
        self.assertIn("certificate.md", map(str, names))
        for name in names:
            first = (self.folder / "folder-one" / name).read_bytes()
            self.assertEqual(first, (self.folder / "folder-two" / name).read_bytes(), name)
            for forbidden in (str(self.folder), str(ROOT), str(PROGRAM), "folder-one"):
                self.assertNotIn(forbidden.encode(), first, name)

    def test_figures_are_well_formed_and_referred_to(self):
        self.certify(self.write(DESIGN))
        text = (self.folder / "out/certificate.md").read_text()
        references = re.findall(r"\]\((figures/[^)]+)\)", text)
        self.assertEqual(references, [f"figures/{name}.svg" for name in ("frequency", "error", "tube")])
        for reference in references:
            root = xml.etree.ElementTree.parse(self.folder / "out" / reference).getroot()
            self.assertTrue(root.tag.endswith("svg"))

    def test_the_last_line_names_the_certificate_and_its_verdict(self):
        result, _ = self.certify(self.write(DESIGN))
        last = result.stdout.splitlines()[-1]
        self.assertTrue(last.startswith("out/certificate.md: Nothing is required"), last)
        self.assertIn("PROVED: the frequency error", last)
        self.assertEqual(result.stderr, "")

    def test_default_folder_is_named_after_the_design(self):
        self.write(DESIGN, "my-design.toml")
        result = self.run_here("certify", "my-design.toml")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertTrue((self.folder / "certificates-out/my-design/certificate.md").is_file())

    def test_a_requirement_that_is_not_proved_stands_in_the_first_line(self):
        design = self.write(DESIGN + "\n[require]\nfrequency_error_below = 0.0051\nsettles_within = 200\n")
        result, certificate = self.certify(design)
        first = (self.folder / "out/certificate.md").read_text().splitlines()[0]
        self.assertTrue(first.startswith("# NOT PROVED."), first)
        self.assertEqual(result.returncode, 1)
        self.assertEqual(certificate["verdict"], "undecided")

    def test_a_requirement_that_is_proved_comes_with_its_evidence(self):
        design = self.write(DESIGN + "\n[require]\nfrequency_error_below = 0.05\n")
        result, certificate = self.certify(design)
        first = (self.folder / "out/certificate.md").read_text().splitlines()[0]
        self.assertTrue(first.startswith("# PROVED: the frequency error stays below 0.05"), first)
        self.assertEqual(result.returncode, 0)
        self.assertEqual(certificate["verdict"], "proved")
        claim = next(claim for claim in certificate["claims"] if claim["required"])
        self.assertLess(float.fromhex(claim["evidence"]["frequency_error_bound"]["hi"]), 0.05)
        self.assertIn("start-error", [entry["purpose"] for entry in certificate["certified_sets"]])

    def guarantee(self, certificate):
        """The claim, which must be the paragraph below the first line of the document."""
        claim = next(claim for claim in certificate["claims"] if claim["id"] == "ekf/guarantee")
        lines = (self.folder / "out/certificate.md").read_text().splitlines()
        self.assertEqual(lines[2], f"**{claim['verdict'].upper()}**: {claim['statement']}")
        self.assertTrue(lines[4].endswith(claim["reason"]), lines[4])
        return claim

    def test_the_guarantee_is_one_sentence_on_top(self):
        design = self.write(DESIGN + "\n[require]\nfrequency_error_below = 0.05\n")
        _, certificate = self.certify(design)
        claim = self.guarantee(certificate)
        self.assertEqual(claim["verdict"], "proved")
        self.assertTrue(claim["statement"].startswith(
            "With measurement noise of at most 0.001 and at a constant frequency, started within 0.005 rad/sample of "
            "the true frequency, 0.005 rad of the phase and 0.005 of the amplitude (1.0), the frequency error stays "
            "below 0.05 rad/sample for ever"), claim["statement"])

    def test_starts_beyond_the_certified_set_are_captured(self):
        result, certificate = self.certify(ROOT / "designs/far-start.toml")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(result.stderr, "")
        self.assertEqual([error.message for error in jsonschema.Draft202012Validator(SCHEMA).iter_errors(certificate)], [])
        verdicts = {derivation["id"]: derivation["verdict"] for derivation in certificate["derivations"]}
        self.assertEqual((verdicts["contraction"], verdicts["capture"]), ("undecided", "proved"))
        self.assertEqual(self.guarantee(certificate)["verdict"], "proved")
        text = (self.folder / "out/certificate.md").read_text()
        for figure in ("tube", "capture"):
            self.assertIn(f"(figures/{figure}.svg)", text)

    def test_what_fails_only_under_noise_is_said_to_hold_without(self):
        design = self.write(DESIGN.replace("noise = 0.001", "noise = 0.01")
                            .replace("initial_phase_error = 0.005", "initial_phase_error = 0.8")
                            .replace("initial_frequency_error = 0.005", "initial_frequency_error = 0.5"))
        result, certificate = self.certify(design)
        self.assertEqual(result.returncode, 0, result.stderr)  # nothing is required
        verdicts = {claim["id"]: claim["verdict"] for claim in certificate["claims"]}
        self.assertEqual((verdicts["ekf/capture"], verdicts["ekf/capture-noise-free"]), ("undecided", "proved"))
        claim = self.guarantee(certificate)
        self.assertEqual(claim["verdict"], "undecided")
        self.assertRegex(claim["reason"], r"[0-9]+ of [0-9]+ cells of assumed starts could not be followed")
        self.assertIn(" What is PROVED: From every assumed start, ", claim["reason"])
        self.assertEqual(verdicts.get("ekf/capture-at-reduced-noise"), "proved")
        capture = next(one for one in certificate["derivations"] if one["id"] == "capture")
        self.assertTrue(all("frequency error in [" in note for note in capture["notes"]), capture["notes"])
        self.assertGreater(len(capture["notes"]), 0)

    def test_failures_say_what_would_repair_them(self):
        for change, words in {("q1 = 0.0023", "q1 = 0"): ("uncontrollable", "any q1 > 0 remedies this"),
                              ("noise = 0.001", "noise = 0.2"): ("largest certified noise", "was assumed"),
                              ("initial_frequency_error = 0.005", "initial_frequency_error = 6"):
                                  ("witness", "1 turns per sample away", "Smaller start errors")}.items():
            with self.subTest(change=change[1]):
                _, certificate = self.certify(self.write(DESIGN.replace(*change)))
                claim = self.guarantee(certificate)
                self.assertNotEqual(claim["verdict"], "proved")
                for word in words:
                    self.assertIn(word, claim["reason"])

    def test_a_start_outside_the_required_bound_refutes_it(self):
        design = self.write(DESIGN + "\n[require]\nfrequency_error_below = 0.005\n")
        result, certificate = self.certify(design)
        claim = next(claim for claim in certificate["claims"] if claim["required"])
        self.assertEqual(claim["verdict"], "refuted")
        self.assertIn("Witness", claim["reason"])
        self.assertEqual(result.returncode, 1)

    def test_q1_zero_is_not_an_error(self):
        design = self.write(DESIGN.replace("q1 = 0.0023", "q1 = 0"))
        _, certificate = self.certify(design)
        for derivation in readings(certificate):
            self.assertIn("q", derivation["not_applicable"])
            self.assertIn("p", derivation["quantities"])
            verdicts = {condition["id"]: condition["verdict"] for condition in derivation["conditions"]}
            self.assertEqual(verdicts["2.24"], "refuted")  # a_2 = 0, and (2.24) requires it to be positive
            self.assertEqual(verdicts["2.43"], "undecided")

    def test_q1_above_q2_is_noted(self):
        design = self.write(DESIGN.replace("q1 = 0.0023", "q1 = 0.1"))
        _, certificate = self.certify(design)
        for derivation in readings(certificate):
            self.assertTrue(any("q_1" in note or "q1" in note for note in derivation["notes"]), derivation["notes"])
            self.assertEqual(derivation["verdict"], "refuted")


if __name__ == "__main__":
    unittest.main()
