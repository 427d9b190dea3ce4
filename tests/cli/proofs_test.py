"""certificate.v as Coq sees it: accepted as written, with the axioms of the real numbers alone, and rejected with any
number changed to say more than is true. Without coqc there is nothing to test."""

import concurrent.futures
import json
import re
import shutil
import subprocess
import unittest

from support import ROOT, CliTestCase

KKL = """\
name = "an observer"
tracker = "kkl-observer"

[design]
lambda = [1, 2, 3, 4]

[assume]
frequency = [3.5, 4]
amplitude = [1, 1]
"""

REAL_NUMBERS = {
    "ClassicalDedekindReals.sig_not_dec",
    "ClassicalDedekindReals.sig_forall_dec",
    "FunctionalExtensionality.functional_extensionality_dep",
    "Classical_Prop.classic",
}

# Files that begin with certificates/coq/<name>.v share that part, which is compiled only once.
PARTS = {name: (ROOT / f"certificates/coq/{name}.v").read_text()
         for name in ("kkl_observer", "theorem_2_9", "proposition_1")}
IMPORTS = "From Coq Require Import Reals Lra Psatz.\nFrom Interval Require Import Tactic.\nRequire Import {0}.\n" \
          "Import {0}.IntegerIntervals.\nLocal Open Scope R_scope.\n"


def golden(name):
    """The part of certificate.v after the part for all designs; tests/certificates checks that it is written."""
    return (ROOT / "tests/certificates/golden" / name).read_text()


def without_last_word(text):
    return text[:text.index("(* The statements that certificate.md lists")]


def lemmas(text, *names):
    """The text without the lemmas that are not named, and without its last word."""
    head, *rest = without_last_word(text).split("\nLemma ")
    return head + "".join("\nLemma " + one for one in rest if one.split(" ", 1)[0] in names)


@unittest.skipUnless(shutil.which("coqc"), "coqc is not installed")
class Proofs(CliTestCase):
    def coqc(self, name, text):
        (self.folder / f"{name}.v").write_text(text)
        return subprocess.run(["coqc", "-w", "-ambiguous-paths", "-R", ".", "", f"{name}.v"], cwd=self.folder,
                              capture_output=True, text=True, check=False, timeout=300)

    def certify(self, design, name):
        path = self.write(design, f"{name}.toml")
        self.run_here("certify", path, "--coq", "--out", name)
        return (self.folder / name / "certificate.v").read_text()

    def design_part(self, text, part):
        self.assertTrue(text.startswith(PARTS[part]))
        return text[len(PARTS[part]):]

    def check_mutations_refused(self, part, mutations, accepted=""):
        """`mutations`: (name, changed text); `accepted`: what of the design's part is compiled as it stands (make proofs
        has Coq accept whole files of every kind, so that one small design is enough here)."""
        compiled = self.coqc(part, PARTS[part])
        self.assertEqual(compiled.returncode, 0, compiled.stderr)
        imports = IMPORTS.format(part)
        if part == "kkl_observer":
            imports = "From Coquelicot Require Import Coquelicot.\n" + imports
        if accepted:
            result = self.coqc("accepted", imports + accepted)
            self.assertEqual(result.returncode, 0, result.stderr)
            self.check_axioms(result.stdout)
        with concurrent.futures.ThreadPoolExecutor(2) as pool:
            outcomes = list(pool.map(lambda one: (one, self.coqc(*one)),
                                     [(name, imports + text) for name, text in mutations]))
        for (name, text), outcome in outcomes:
            self.assertNotEqual(outcome.returncode, 0, f"{name} was accepted")
            self.assertIn("Error", outcome.stderr, name)

    def check_axioms(self, output):
        axioms = set(re.findall(r"^([^\s:]+)", output.partition("Axioms:\n")[2], re.MULTILINE))
        self.assertTrue(axioms)
        self.assertLessEqual(axioms, REAL_NUMBERS)

    def changed(self, text, old, new):
        self.assertEqual(text.count(old), 1, old)
        return text.replace(old, new)

    def test_kkl_observer(self):
        text = self.design_part(self.certify(KKL, "observer"), "kkl_observer")
        listed = json.loads((self.folder / "observer/report.json").read_text())["formal_proofs"]["proofs"]
        self.assertIn("ell_is_at_least", [proof["lemma"] for proof in listed])
        bound = re.search(r"ell_lower : R := \((\d+) /", text).group(1)
        in_use = re.search(r"ell_in_use : R := (.*)\.\n", text).group(1)
        upper = re.search(r"ell_upper : R := \((\d+) /", text).group(1)
        # Lemmas that follow from the lower bound are rejected without waiting for its proof.
        short = without_last_word(text)
        taken = short.replace("interval with (i_bisect s, i_autodiff s, i_prec 90).\nQed.", "Admitted.")
        self.assertEqual(taken.count("Admitted"), 2)
        self.check_mutations_refused("kkl_observer", [
            ("larger_bound", self.changed(short, f"({bound} /", f"({int(bound) * 1001 // 1000} /")),
            ("larger_ell", self.changed(taken, f":= {in_use}.", f":= 3 * {in_use}.")),
            ("smaller_upper_end", self.changed(taken, f"({upper} /", f"({int(upper) * 999 // 1000} /")),
        ], accepted=text)

    def test_theorem_2_9(self):
        text = golden("theorem-2.9.v")
        mutations = []
        for name in ("errata_b_1_enclosed", "errata_one_minus_alpha_enclosed"):
            one = lemmas(text, name)
            lower, middle, upper = re.search(r"\n  (\S.*) <= (.*) <= (.*)\.\nProof", one).groups()
            mutations.append((f"{name}_above", self.changed(one, f"  {lower} <= {middle}",
                                                            f"  {upper} * (1001 / 1000) <= {middle}")))
        one = lemmas(text, "errata_s_enclosed")
        mutations.append(("another_design", self.changed(one, "q1 := (23 / 10000)", "q1 := (24 / 10000)")))
        one = lemmas(text, "errata_lhs_2_43_enclosed", "errata_condition_2_43_fails")
        mutations.append(("condition_holds", self.changed(one, "1 <= lhs_2_43 errata here.",
                                                          "lhs_2_43 errata here <= 1.")))
        self.check_mutations_refused("theorem_2_9", mutations)

    def test_proposition_1(self):
        text = without_last_word(golden("proposition-1.v"))
        gain = re.search(r"gain_1 : R := (.*)\.\n", text).group(1)
        self.check_mutations_refused("proposition_1", [
            ("large_gain", self.changed(text, f":= {gain}.", f":= 3 * {gain}.")),
            ("circle_of_half", self.changed(text, "a ^ 2 + b ^ 2 < 1", "a ^ 2 + b ^ 2 < 1 / 10")),
        ])

    def test_guarantee(self):
        design = (ROOT / "designs/la-scala-1994-figure-3.5-without-leak.toml").read_text()
        parts, found, rest = self.certify(design, "guarantee").partition("\nModule ekf.\n")
        self.assertTrue(found)
        self.assertNotIn("Admitted", parts)
        compiled = self.coqc("parts", parts)
        self.assertEqual(compiled.returncode, 0, compiled.stderr)
        head, lemma, _ = rest.partition("\nDefinition set_for_the_long_run")
        self.assertTrue(lemma)
        head = "From Coq Require Import QArith.\nRequire Import parts.\n" + head
        theorem = re.search(r"(\n\(\* The design, and.*?)\nLemma frequency_error_in_the_long_run", rest, re.DOTALL).group(1)
        bound = re.search(r"error_bound := \((\d+) #", head).group(1)
        unchecked = self.changed(head, "Proof. vm_cast_no_check (eq_refl true). Qed.", "Admitted.") + \
            "\nLocal Open Scope R_scope.\n"
        accepted = self.coqc("statement", unchecked + theorem)
        self.assertEqual(accepted.returncode, 0, accepted.stderr)
        for name, text in [
                ("larger_noise", self.changed(head, "noise_bound := (1 # 1000)", "noise_bound := (3 # 1000)")),
                ("smaller_bound", self.changed(head, f"error_bound := ({bound} #",
                                               f"error_bound := ({int(bound) * 99 // 100} #")),
                ("dropped_cell", re.sub(r"\(Checked \(Build_leaf .*?\)\)\n", "Outside\n", head, count=1)),
                ("another_design", self.changed(head, "design_r := (5 # 100)", "design_r := (6 # 100)")),
                ("another_statement", unchecked + self.changed(theorem, f"<= ({bound} /", f"<= ({int(bound) - 1} /"))]:
            self.assertNotEqual(text, head, name)
            outcome = self.coqc(name, text)
            self.assertNotEqual(outcome.returncode, 0, f"{name} was accepted")
            self.assertIn("Error", outcome.stderr, name)

    def test_identities_are_not_slack(self):
        # A sign or a constant changed in the proofs for all designs.
        for part, old, new in [
                ("proposition_1", "z * (k2 * s + 2 * c - k1 * c) + 1 - k1.", "z * (k2 * s + 2 * c - k1 * c) + 1 + k1."),
                ("kkl_observer", "(l * x1 + x2) / (l ^ 2 + x3)", "(l * x1 - x2) / (l ^ 2 + x3)"),
                ("theorem_2_9", "4 * (8 * sqrt 8) * state_bound d <=", "5 * (8 * sqrt 8) * state_bound d <=")]:
            outcome = self.coqc("changed", self.changed(PARTS[part], old, new))
            self.assertNotEqual(outcome.returncode, 0, part)
            self.assertIn("Error", outcome.stderr, part)


if __name__ == "__main__":
    unittest.main()
