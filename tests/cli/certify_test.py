"""veritrack certify on a design of each kind, or on all of them with VERITRACK_TEST_EFFORT above 1: the documents, whole."""

import copy
import fractions
import hashlib
import json
import math
import os
import re
import subprocess
import unittest
import xml.etree.ElementTree

from documents import objections, read_documents
from support import DESIGN, PROGRAM, ROOT, CliTestCase

DESIGNS = sorted((ROOT / "designs").glob("*.toml"))
QUANTITIES = """R_x epsilon_r rho_1 rho_2 rho_3 rho_4 rho_5 delta_1 delta_2 a_1 a_2 b_1 b_2 p q s gamma beta
    one_minus_alpha epsilon_z delta_p delta_k delta_k2 zeta_z eta zeta lhs_2_43 lhs_2_44 initial_error_bound""".split()


def readings(document):
    """The published theorem, as it was evaluated."""
    ids = ("theorem-2.9/printed", "theorem-2.9/errata")
    found = [derivation for derivation in document["derivations"] if derivation["id"] in ids]
    assert len(found) == 2
    return found


class Certify(CliTestCase):
    def certify(self, design, out="out"):
        """The run, certificate.json and report.json, which fit their schemas."""
        result = self.run_here("certify", design, "--out", out)
        self.assertIn(result.returncode, (0, 1), result.stderr)
        return result, *read_documents(self.folder / out)

    def test_there_are_designs(self):
        self.assertGreaterEqual(len(DESIGNS), 4)

    def test_every_design_gives_a_valid_certificate(self):
        chosen = DESIGNS
        if float(os.environ.get("VERITRACK_TEST_EFFORT") or 1) <= 1:
            listed = subprocess.run([ROOT / "scripts/one-of-each-kind"], capture_output=True, text=True, check=True).stdout
            # Gaussian noise takes minutes; make verify does it.
            chosen = [ROOT / name for name in listed.split() if "snr_db" not in (ROOT / name).read_text()]
            chosen.append(ROOT / "tests/certificates/lock.toml")
            self.assertGreaterEqual(len(chosen), 4)
        for design in chosen:
            with self.subTest(design=design.name):
                result, certificate, report = self.certify(design, design.stem)
                required = [claim["verdict"] for claim in report["claims"] if claim["required"]]
                self.assertEqual(result.returncode, 0 if all(v == "proved" for v in required) else 1)
                self.assertEqual(certificate["verdict"] == "nothing-required", not required)
                self.assertEqual(certificate["verdict"], report["verdict"])
                # Of the claims that are told, those that are decided are claimed, in the same order.
                self.assertEqual([(c["id"], c["verdict"], c["required"]) for c in certificate["claims"]],
                                 [(c["id"], c["verdict"], c["required"]) for c in report["claims"]
                                  if c["verdict"] != "undecided"])
                self.assertEqual(certificate["design_sha256"], hashlib.sha256(design.read_bytes()).hexdigest())

    def test_the_certificates_of_the_checkers_tests_fit_the_schema(self):
        paths = sorted((ROOT / "tests/certificates/accepted").glob("*.json"))
        self.assertGreaterEqual(len(paths), 10)
        for path in paths:
            with self.subTest(path=path.name):
                self.assertEqual([], objections("certificate", json.loads(path.read_text())))

    def test_the_schema_allows_nothing_more(self):
        certificate = json.loads((ROOT / "tests/certificates/accepted/one-set.json").read_text())
        self.assertEqual([], objections("certificate", certificate))
        changes = {"a word": lambda c: c.update(reason="by contraction"),
                   "a statement": lambda c: c["claims"][0].update(statement="PROVED: all is well"),
                   "nothing decided": lambda c: c["claims"][0].update(verdict="undecided"),
                   "a value of nothing": lambda c: c["derivations"][0]["quantities"].update(radius={}),
                   "infinity": lambda c: c["certified_sets"][0].update(radius="inf"),
                   "a line": lambda c: c["design"]["design"]["q1"].update(line=3),
                   "half a requirement": lambda c: c["design"]["require"].update(
                       settles_within={"text": "1", "lo": "0x1p+0", "hi": "0x1p+0"})}
        for name, change in changes.items():
            with self.subTest(change=name):
                changed = copy.deepcopy(certificate)
                change(changed)
                self.assertNotEqual([], objections("certificate", changed))

    def test_every_quantity_of_the_theorem_is_there(self):
        _, certificate, _ = self.certify(ROOT / "designs/la-scala-1994-figure-3.5.toml")
        for derivation in readings(certificate):
            for name in QUANTITIES:
                quantity = derivation["quantities"][name]
                low, high = float.fromhex(quantity["lo"]), float.fromhex(quantity["hi"])
                self.assertLessEqual(low, high, name)
                self.assertLessEqual(high - low, 1e-12 * max(abs(low), abs(high)), name)

    def test_design_values_are_as_written_in_the_tightest_doubles(self):
        _, certificate, _ = self.certify(self.write(DESIGN))
        for name, value in certificate["design"]["design"].items():
            self.assertIn(f"\n{name} = {value['text']}\n", DESIGN)
            low, high = float.fromhex(value["lo"]), float.fromhex(value["hi"])
            exact = fractions.Fraction(value["text"])
            self.assertTrue(fractions.Fraction(low) <= exact <= fractions.Fraction(high), name)
            self.assertIn(high, (low, math.nextafter(low, math.inf)), name)
        self.assertEqual(certificate["design"]["theorem_2_9"]["sigma"]["text"], "1e-3")

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
        result, _, _ = self.certify(self.write(DESIGN))
        last = result.stdout.splitlines()[-1]
        self.assertEqual(last, "out/certificate.md: Nothing is required of this design")
        self.assertEqual(result.stderr, "")

    def test_default_folder_is_named_after_the_design(self):
        self.write(DESIGN, "my-design.toml")
        result = self.run_here("certify", "my-design.toml")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertTrue((self.folder / "certificates-out/my-design/certificate.md").is_file())

    def test_a_requirement_that_is_not_proved_stands_in_the_first_line(self):
        design = self.write(DESIGN + "\n[require]\nfrequency_error_below = 0.0051\n"
                            "settles_within = 200\nsettled_below = 0.0011\n")
        result, certificate, _ = self.certify(design)
        first = (self.folder / "out/certificate.md").read_text().splitlines()[0]
        self.assertTrue(first.startswith("# NOT PROVED."), first)
        self.assertEqual(result.returncode, 1)
        self.assertEqual(certificate["verdict"], "undecided")

    def test_a_requirement_that_is_proved_comes_with_its_evidence(self):
        design = self.write(DESIGN + "\n[require]\nfrequency_error_below = 0.05\n")
        result, certificate, _ = self.certify(design)
        first = (self.folder / "out/certificate.md").read_text().splitlines()[0]
        self.assertTrue(first.startswith("# PROVED: the frequency error stays below 0.05"), first)
        self.assertEqual(result.returncode, 0)
        self.assertEqual(certificate["verdict"], "proved")
        claim = next(claim for claim in certificate["claims"] if claim["required"])
        self.assertLess(float.fromhex(claim["evidence"]["frequency_error_bound"]["hi"]), 0.05)
        self.assertIn("start-error", [entry["purpose"] for entry in certificate["certified_sets"]])

    def guarantee(self, report):
        """The claim, which must be the paragraph below the first line of the document."""
        claim = next(claim for claim in report["claims"] if claim["id"] == "ekf/guarantee")
        lines = (self.folder / "out/certificate.md").read_text().splitlines()
        self.assertEqual(lines[2], f"**{claim['verdict'].upper()}**: {claim['statement']}")
        self.assertTrue(lines[4].endswith(claim["reason"]), lines[4])
        return claim

    def test_the_guarantee_is_one_sentence_on_top(self):
        design = self.write(DESIGN + "\n[require]\nfrequency_error_below = 0.05\n")
        _, _, report = self.certify(design)
        claim = self.guarantee(report)
        self.assertEqual(claim["verdict"], "proved")
        self.assertRegex(claim["statement"], re.compile(
            r"^In double precision \(IEEE 754, .*\), for a tone of constant amplitude 1\.0 whose frequency is at most pi "
            r"rad/sample and is constant, with measurement noise of at most 0\.001 \(the length of the error in both channels; 0\.000707 in each is "
            r"enough\), started within 0\.005 rad/sample of the true frequency, 0\.005 rad of the phase and 0\.005 of the "
            r"amplitude and with P\(0\|0\) from 0\.\d+ M to 1\.\d+ M, M = \[[-0-9., ]+; [-0-9., ]+; [-0-9., ]+\] in the "
            r"frame of the estimated phase, the frequency error stays below 0\.05 rad/sample for ever: the frequency "
            r"error never exceeds "))

    def test_starts_beyond_the_certified_set_are_captured(self):
        result, certificate, report = self.certify(ROOT / "designs/far-start.toml")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(result.stderr, "")
        verdicts = {derivation["id"]: derivation["verdict"] for derivation in report["derivations"]}
        self.assertEqual((verdicts["contraction"], verdicts["capture"]), ("undecided", "proved"))
        claimed = {derivation["id"]: derivation.get("verdict") for derivation in certificate["derivations"]}
        self.assertEqual((claimed["contraction"], claimed["capture"]), (None, "proved"))
        self.assertEqual(self.guarantee(report)["verdict"], "proved")
        text = (self.folder / "out/certificate.md").read_text()
        for figure in ("tube", "capture"):
            self.assertIn(f"(figures/{figure}.svg)", text)

    def test_what_fails_only_under_noise_is_said_to_hold_without(self):
        design = self.write(DESIGN.replace("noise = 0.001", "noise = 0.01")
                            .replace("initial_phase_error = 0.005", "initial_phase_error = 0.8")
                            .replace("initial_frequency_error = 0.005", "initial_frequency_error = 0.5"))
        result, certificate, report = self.certify(design)
        self.assertEqual(result.returncode, 0, result.stderr)  # nothing is required
        self.assertNotIn("ekf/capture", [claim["id"] for claim in certificate["claims"]])
        verdicts = {claim["id"]: claim["verdict"] for claim in report["claims"]}
        self.assertEqual((verdicts["ekf/capture"], verdicts["ekf/capture-noise-free"]), ("undecided", "proved"))
        claim = self.guarantee(report)
        self.assertEqual(claim["verdict"], "undecided")
        self.assertRegex(claim["reason"], r"[0-9]+ of [0-9]+ cells of assumed starts could not be followed")
        self.assertRegex(claim["reason"],
                         r" What is proved: In double precision \(.*\), for a tone of .*, with measurement noise of at most "
                         r"\S+ of the amplitude \(.*\), started within .* and with P\(0\|0\) ")
        self.assertEqual(verdicts.get("ekf/capture-at-reduced-noise"), "proved")
        capture = next(one for one in report["derivations"] if one["id"] == "capture")
        self.assertTrue(all("frequency error in [" in note for note in capture["notes"]), capture["notes"])
        self.assertGreater(len(capture["notes"]), 0)

    def test_failures_say_what_would_repair_them(self):
        for change, words in {("q1 = 0.0023", "q1 = 0"): ("uncontrollable", "any q1 > 0 remedies this"),
                              ("noise = 0.001", "noise = 0.2"): ("largest certified noise", "was assumed"),
                              ("initial_frequency_error = 0.005", "initial_frequency_error = 6"):
                                  ("witness", "1 turns per sample away", "Smaller start errors")}.items():
            with self.subTest(change=change[1]):
                _, _, report = self.certify(self.write(DESIGN.replace(*change)))
                claim = self.guarantee(report)
                self.assertNotEqual(claim["verdict"], "proved")
                for word in words:
                    self.assertIn(word, claim["reason"])

    def test_a_start_outside_the_required_bound_refutes_it(self):
        design = self.write(DESIGN + "\n[require]\nfrequency_error_below = 0.005\n")
        result, _, report = self.certify(design)
        claim = next(claim for claim in report["claims"] if claim["required"])
        self.assertEqual(claim["verdict"], "refuted")
        self.assertIn("Witness", claim["reason"])
        self.assertEqual(result.returncode, 1)

    def test_q1_zero_is_not_an_error(self):
        design = self.write(DESIGN.replace("q1 = 0.0023", "q1 = 0"))
        _, _, report = self.certify(design)
        for derivation in readings(report):
            self.assertIn("q", derivation["not_applicable"])
            self.assertIn("p", derivation["quantities"])
            verdicts = {condition["id"]: condition["verdict"] for condition in derivation["conditions"]}
            self.assertEqual(verdicts["2.24"], "refuted")  # a_2 = 0, and (2.24) requires it to be positive
            self.assertEqual(verdicts["2.43"], "undecided")

    def test_q1_above_q2_is_noted(self):
        design = self.write(DESIGN.replace("q1 = 0.0023", "q1 = 0.1"))
        _, _, report = self.certify(design)
        for derivation in readings(report):
            self.assertTrue(any("q_1" in note or "q1" in note for note in derivation["notes"]), derivation["notes"])
            self.assertEqual(derivation["verdict"], "refuted")


if __name__ == "__main__":
    unittest.main()
