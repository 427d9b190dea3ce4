"""certificate.v as Coq sees it: accepted as written, with the axioms of the real numbers alone, and rejected with any
number changed to say more than is true. Without coqc there is nothing to test."""

import concurrent.futures
import json
import re
import shutil
import sys
import unittest

from support import ROOT, CliTestCase

sys.path.insert(0, str(ROOT / "scripts"))
import coq_parts  # noqa: E402

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

# The parts for all designs, which scripts/proofs compiles before and leaves there.
COMPILED = ROOT / "certificates-out/coq-parts"
PARTS = {name: (ROOT / f"certificates/coq/{name}.v").read_text()
         for name in ("kkl_observer", "theorem_2_9", "proposition_1")}


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
        return coq_parts.coqc(self.folder, name, COMPILED)

    def certify(self, design, name):
        """What of certificate.v is for all designs, and what is about this one."""
        path = self.write(design, f"{name}.toml")
        self.run_here("certify", "--no-verify", path, "--coq", "--out", name)
        return coq_parts.split((self.folder / name / "certificate.v").read_text())

    def check_refused(self, part, mutations):
        """`mutations`: (name, changed text of the design), each after the part for all designs."""
        required = coq_parts.compile_part(part, COMPILED)
        with concurrent.futures.ThreadPoolExecutor(2) as pool:
            outcomes = list(pool.map(lambda one: (one[0], self.coqc(one[0], coq_parts.requiring(required, one[1]))),
                                     mutations))
        for name, outcome in outcomes:
            self.assertNotEqual(outcome.returncode, 0, f"{name} was accepted")
            self.assertIn("Error", outcome.stderr, name)

    def check_accepted(self, part, text):
        """One small design is enough here: scripts/proofs has Coq accept complete files of every kind."""
        result = self.coqc("accepted", coq_parts.requiring(coq_parts.compile_part(part, COMPILED), text))
        self.assertEqual(result.returncode, 0, result.stderr)
        return result.stdout

    def check_axioms(self, output):
        axioms = set(re.findall(r"^([^\s:]+)", output.partition("Axioms:\n")[2], re.MULTILINE))
        self.assertTrue(axioms)
        self.assertLessEqual(axioms, REAL_NUMBERS)

    def changed(self, text, old, new):
        self.assertEqual(text.count(old), 1, old)
        return text.replace(old, new)

    def test_kkl_observer(self):
        part, text = self.certify(KKL, "observer")
        self.check_axioms(self.check_accepted(part, text))
        listed = json.loads((self.folder / "observer/report.json").read_text())["formal_proofs"]["proofs"]
        self.assertIn("ell_is_at_least", [proof["lemma"] for proof in listed])
        bound = re.search(r"ell_lower : R := \((\d+) /", text).group(1)
        in_use = re.search(r"ell_in_use : R := (.*)\.\n", text).group(1)
        upper = re.search(r"ell_upper : R := \((\d+) /", text).group(1)
        # Lemmas that follow from the lower bound are rejected without waiting for its proof.
        short = without_last_word(text)
        taken = short.replace("interval with (i_bisect s, i_autodiff s, i_prec 90).\nQed.", "Admitted.")
        self.assertEqual(taken.count("Admitted"), 2)
        self.check_refused(part, [
            ("larger_bound", self.changed(short, f"({bound} /", f"({int(bound) * 1001 // 1000} /")),
            ("larger_ell", self.changed(taken, f":= {in_use}.", f":= 3 * {in_use}.")),
            ("smaller_upper_end", self.changed(taken, f"({upper} /", f"({int(upper) * 999 // 1000} /")),
        ])

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
        self.check_refused(PARTS["theorem_2_9"] + "\n", mutations)

    def test_proposition_1(self):
        text = without_last_word(golden("proposition-1.v"))
        gain = re.search(r"gain_1 : R := (.*)\.\n", text).group(1)
        self.check_refused(PARTS["proposition_1"] + "\n", [
            ("large_gain", self.changed(text, f":= {gain}.", f":= 3 * {gain}.")),
            ("circle_of_half", self.changed(text, "a ^ 2 + b ^ 2 < 1", "a ^ 2 + b ^ 2 < 1 / 10")),
        ])

    def test_guarantee(self):
        # With a slew, so that it is changed, too; scripts/proofs has Coq accept designs without one.
        design = self.changed((ROOT / "designs/la-scala-1994-figure-3.5-without-leak.toml").read_text(),
                              "slew = 0.0 ", "slew = 0.0005 ")
        part, text = self.certify(design, "guarantee")
        self.assertNotIn("Admitted", part + text)
        text = self.changed(text, "\nModule ekf.\n", "\n")  # which would have to be closed
        # The theorem for ever alone: its numbers, and then what it says.
        numbers, _, rest = text.partition("\nDefinition set_for_the_long_run")
        real_numbers = "\nLocal Open Scope R_scope.\n"
        statement = real_numbers + re.search(
            r"(\n\(\* The design, Q.*?)\nLemma frequency_error_in_the_long_run", rest, re.DOTALL).group(1)
        self.assertIn("Rabs (omega (S k) - omega k) <= 0.0005)", statement)
        steady = re.search(r"\nDefinition bounds_of_the_steady_state.*?_are_checked : .*?Qed\.\n", rest, re.DOTALL).group(0)
        axioms = "\nPrint Assumptions frequency_error_for_ever.\n"
        self.check_axioms(self.check_accepted(part, numbers + statement + steady + axioms))
        bound = int(re.search(r"error_bound := \((\d+) #", numbers).group(1))
        unchecked = self.changed(numbers, "Proof. vm_cast_no_check (eq_refl true). Qed.", "Admitted.")
        stated = re.search(r"omega k\) <= (0\.\d+)\.\nProof", statement).group(1)
        mutations = [
            ("larger_noise", self.changed(numbers, "noise_bound := (1 # 1000)", "noise_bound := (3 # 1000)")),
            ("larger_slew", self.changed(numbers, "slew_bound := (5 # 10000)", "slew_bound := (9 # 10000)")),
            ("larger_start", self.changed(numbers, "frequency_error := (5 # 1000)", "frequency_error := (9 # 1000)")),
            ("smaller_bound", self.changed(numbers, f"error_bound := ({bound} #", f"error_bound := ({bound * 99 // 100} #")),
            ("dropped_cell", re.sub(r"\(Checked \(Build_leaf .*?\)\)\n", "Outside\n", numbers, count=1)),
            ("another_design", self.changed(numbers, "design_r := (5 # 100)", "design_r := (6 # 100)")),
            # A step makes 0.995 of the steady state larger, so that it is no upper bound of it.
            ("steady_state", self.changed(unchecked, "to_multiple := (101 # 100)", "to_multiple := (995 # 1000)") +
             real_numbers + steady),
            # What is said is what was checked.
            ("another_bound", unchecked + self.changed(statement, stated, stated[:-1] + str(int(stated[-1]) - 1)
                                                       if stated[-1] != "0" else stated + "1")),
            ("another_noise", unchecked + self.changed(statement, "v2 k ^ 2 <= 0.001 ^ 2", "v2 k ^ 2 <= 0.002 ^ 2")),
            ("another_slew", unchecked + self.changed(statement, "omega k) <= 0.0005)", "omega k) <= 0.0006)")),
            ("another_filter", unchecked + self.changed(statement, "r := 0.05 |}", "r := 0.06 |}"))]
        for name, changed in mutations:
            self.assertNotIn(changed, (numbers, unchecked + statement), name)
        self.check_refused(part, mutations)

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
