"""veritrack certify: the documents, whole. `make verify` looks at those of a design of each kind."""

import copy
import fractions
import functools
import json
import math
import re
import unittest
import xml.etree.ElementTree

from documents import check_agreement, objections, read_documents
from support import DESIGN, PROGRAM, ROOT, CliTestCase, run, scratch_folder

REQUIRED = DESIGN + "\n[require]\nfrequency_error_below = 0.05\n"
QUANTITIES = """R_x epsilon_r rho_1 rho_2 rho_3 rho_4 rho_5 delta_1 delta_2 a_1 a_2 b_1 b_2 p q s gamma beta
    one_minus_alpha epsilon_z delta_p delta_k delta_k2 zeta_z eta zeta lhs_2_43 lhs_2_44 initial_error_bound""".split()


class Run:
    """A design certified into the folder `out`: the documents fit their schemas, and each other."""

    def __init__(self, design, folder):
        self.result = run("certify", "--no-verify", design, "--out", "out", cwd=folder)
        self.out = folder / "out"
        assert self.result.returncode in (0, 1), self.result.stderr
        self.certificate, self.report = read_documents(self.out)
        check_agreement(self.certificate, self.report, self.result.returncode)
        self.text = (self.out / "certificate.md").read_text()

    def guarantee(self):
        """The claim, which the document must have below its first line: as a sentence, or in the list."""
        claim = next(claim for claim in self.report["claims"] if claim["id"] == "ekf/guarantee")
        lines = self.text.splitlines()
        verdict = claim["verdict"].upper()
        if verdict == "UNDECIDED":
            assert lines[2] == f"**{verdict}**: {claim['statement']}", lines[2]
            assert lines[4].endswith(claim["reason"]), lines[4]
            return claim
        assert lines[2].startswith("**Assume**"), lines[2]
        first = next(number for number, line in enumerate(lines) if line.startswith("- **"))
        said = re.fullmatch(rf"- \*\*{verdict}\*\* \(1 to (\d+)\): (.*)", lines[first])
        assumed = [line.split(". ", 1)[1] for line in lines[4:4 + int(said.group(1))]]
        assert ", ".join(assumed + [said.group(2)]) == claim["statement"], lines[first]
        assert lines[first + 1] == f"  Why: {claim['reason']}", lines[first + 1]
        return claim


@functools.cache
def certified(text):
    """The run for this text of a design file; many tests are about the same."""
    folder = scratch_folder()
    (folder / "design.toml").write_text(text)
    return Run("design.toml", folder)


@functools.cache
def certified_file(name):
    return Run(ROOT / "designs" / name, scratch_folder())


def readings(document):
    """The published theorem, as it was evaluated."""
    ids = ("theorem-2.9/printed", "theorem-2.9/errata")
    found = [derivation for derivation in document["derivations"] if derivation["id"] in ids]
    assert len(found) == 2
    return found


class Certify(CliTestCase):
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
        certificate = certified_file("la-scala-1994-figure-3.5.toml").certificate
        for derivation in readings(certificate):
            for name in QUANTITIES:
                quantity = derivation["quantities"][name]
                low, high = float.fromhex(quantity["lo"]), float.fromhex(quantity["hi"])
                self.assertLessEqual(low, high, name)
                self.assertLessEqual(high - low, 1e-12 * max(abs(low), abs(high)), name)

    def test_design_values_are_as_written_in_the_tightest_doubles(self):
        certificate = certified(DESIGN).certificate
        for name, value in certificate["design"]["design"].items():
            self.assertIn(f"\n{name} = {value['text']}\n", DESIGN)
            low, high = float.fromhex(value["lo"]), float.fromhex(value["hi"])
            exact = fractions.Fraction(value["text"])
            self.assertTrue(fractions.Fraction(low) <= exact <= fractions.Fraction(high), name)
            self.assertIn(high, (low, math.nextafter(low, math.inf)), name)
        self.assertEqual(certificate["design"]["theorem_2_9"]["sigma"]["text"], "1e-3")

    def test_same_input_same_bytes_and_no_paths_and_the_default_folder_is_named_after_the_design(self):
        first = certified(DESIGN)
        self.write(DESIGN)
        result = self.run_here("certify", "--no-verify", "design.toml")
        self.assertEqual(result.returncode, 0, result.stderr)
        names = sorted(path.relative_to(first.out) for path in first.out.rglob("*") if path.is_file())
        self.assertIn("certificate.md", map(str, names))
        for name in names:
            found = (first.out / name).read_bytes()
            self.assertEqual(found, (self.folder / "certificates-out/design" / name).read_bytes(), name)
            for forbidden in (first.out.parent, self.folder, ROOT, PROGRAM, "certificates-out"):
                self.assertNotIn(str(forbidden).encode(), found, name)

    def test_figures_are_well_formed_and_referred_to(self):
        found = certified(DESIGN)
        references = re.findall(r"\]\((figures/[^)]+)\)", found.text)
        self.assertEqual(references, [f"figures/{name}.svg" for name in ("frequency", "error", "tube")])
        for reference in references:
            root = xml.etree.ElementTree.parse(found.out / reference).getroot()
            self.assertTrue(root.tag.endswith("svg"))

    def test_the_last_line_names_the_certificate_and_its_verdict(self):
        result = certified(DESIGN).result
        last = result.stdout.splitlines()[-1]
        self.assertEqual(last, "out/certificate.md: Nothing is required of this design")
        self.assertEqual(result.stderr, "")

    def test_a_requirement_that_is_not_proved_stands_in_the_first_line(self):
        found = certified(DESIGN + "\n[require]\nfrequency_error_below = 0.0051\n"
                          "settles_within = 200\nsettled_below = 0.0011\n")
        first = found.text.splitlines()[0]
        self.assertTrue(first.startswith("# NOT PROVED."), first)
        self.assertEqual(found.result.returncode, 1)
        self.assertEqual(found.certificate["verdict"], "undecided")

    def test_a_requirement_that_is_proved_comes_with_its_evidence(self):
        found = certified(REQUIRED)
        first = found.text.splitlines()[0]
        self.assertTrue(first.startswith("# PROVED: the frequency error stays below 0.05"), first)
        self.assertEqual(found.result.returncode, 0)
        self.assertEqual(found.certificate["verdict"], "proved")
        claim = next(claim for claim in found.certificate["claims"] if claim["required"])
        self.assertLess(float.fromhex(claim["evidence"]["frequency_error_bound"]["hi"]), 0.05)
        self.assertIn("start-error", [entry["purpose"] for entry in found.certificate["certified_sets"]])

    def test_the_guarantee_is_one_sentence_on_top(self):
        claim = certified(REQUIRED).guarantee()
        self.assertEqual(claim["verdict"], "proved")
        self.assertRegex(claim["statement"], re.compile(
            r"^In double precision \(IEEE 754, .*\), for a tone of constant amplitude 1\.0 whose frequency is at most pi "
            r"rad/sample and is constant, with measurement noise of at most 0\.001 \(the length of the error in both channels; 0\.000707 in each is "
            r"enough\), started within 0\.005 rad/sample of the true frequency, 0\.005 rad of the phase and 0\.005 of the "
            r"amplitude and with P\(0\|0\) from 0\.\d+ M to 1\.\d+ M, M = \[[-0-9., ]+; [-0-9., ]+; [-0-9., ]+\] in the "
            r"frame of the estimated phase, the frequency error stays below 0\.05 rad/sample for ever: the frequency "
            r"error never exceeds "))

    def test_starts_beyond_the_certified_set_are_captured(self):
        found = certified_file("far-start.toml")
        self.assertEqual(found.result.returncode, 0, found.result.stderr)
        self.assertEqual(found.result.stderr, "")
        verdicts = {derivation["id"]: derivation["verdict"] for derivation in found.report["derivations"]}
        self.assertEqual((verdicts["contraction"], verdicts["capture"]), ("undecided", "proved"))
        claimed = {derivation["id"]: derivation.get("verdict") for derivation in found.certificate["derivations"]}
        self.assertEqual((claimed["contraction"], claimed["capture"]), (None, "proved"))
        self.assertEqual(found.guarantee()["verdict"], "proved")
        for figure in ("tube", "capture"):
            self.assertIn(f"(figures/{figure}.svg)", found.text)

    def test_what_fails_only_under_noise_is_said_to_hold_without(self):
        found = certified(DESIGN.replace("noise = 0.001", "noise = 0.01")
                          .replace("initial_phase_error = 0.005", "initial_phase_error = 0.8")
                          .replace("initial_frequency_error = 0.005", "initial_frequency_error = 0.5"))
        report = found.report
        self.assertEqual(found.result.returncode, 0, found.result.stderr)  # nothing is required
        self.assertNotIn("ekf/capture", [claim["id"] for claim in found.certificate["claims"]])
        verdicts = {claim["id"]: claim["verdict"] for claim in report["claims"]}
        self.assertEqual((verdicts["ekf/capture"], verdicts["ekf/capture-noise-free"]), ("undecided", "proved"))
        claim = found.guarantee()
        self.assertEqual(claim["verdict"], "undecided")
        self.assertRegex(claim["reason"], r"[0-9]+ of [0-9]+ cells of assumed starts could not be followed")
        self.assertRegex(claim["reason"],
                         r" Proved instead: In double precision \(.*\), for a tone of .*, with measurement noise of at most "
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
                claim = certified(DESIGN.replace(*change)).guarantee()
                self.assertNotEqual(claim["verdict"], "proved")
                for word in words:
                    self.assertIn(word, claim["reason"])

    def test_a_start_outside_the_required_bound_refutes_it(self):
        found = certified(DESIGN + "\n[require]\nfrequency_error_below = 0.005\n")
        claim = next(claim for claim in found.report["claims"] if claim["required"])
        self.assertEqual(claim["verdict"], "refuted")
        self.assertIn("Witness", claim["reason"])
        self.assertEqual(found.result.returncode, 1)

    def test_q1_zero_is_not_an_error(self):
        for derivation in readings(certified(DESIGN.replace("q1 = 0.0023", "q1 = 0")).report):
            self.assertIn("q", derivation["not_applicable"])
            self.assertIn("p", derivation["quantities"])
            verdicts = {condition["id"]: condition["verdict"] for condition in derivation["conditions"]}
            self.assertEqual(verdicts["2.24"], "refuted")  # a_2 = 0, and (2.24) requires it to be positive
            self.assertEqual(verdicts["2.43"], "undecided")

    def test_q1_above_q2_is_noted(self):
        for derivation in readings(certified(DESIGN.replace("q1 = 0.0023", "q1 = 0.1")).report):
            self.assertTrue(any("q_1" in note or "q1" in note for note in derivation["notes"]), derivation["notes"])
            self.assertEqual(derivation["verdict"], "refuted")


if __name__ == "__main__":
    unittest.main()
