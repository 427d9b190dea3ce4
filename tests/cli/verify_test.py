"""Certificates as written, checked by a program that shares no code with the one that wrote them."""

import json
import math
import os
import pathlib
import re
import subprocess
import unittest

from support import DESIGN, ROOT, CliTestCase, takes_long

CHECKER = os.environ["VERITRACK_VERIFY"]


def verify(*arguments):
    return subprocess.run([CHECKER, *map(str, arguments)], capture_output=True, text=True, check=False)


def documents(folder):
    """The options that name the documents of a certificate."""
    return [word for name in ("certificate.md", "published-theorems.md") if (folder / name).exists()
            for word in ("--markdown", folder / name)]


class Verify(CliTestCase):
    def certified_and_checked(self, name):
        """The run of the checker for a shipped design and its document, and the verified parts."""
        design = ROOT / "designs" / (name + ".toml")
        self.run_here("certify", "--no-verify", design, "--out", name)
        folder = self.folder / name
        result = verify("--design", design, *documents(folder), folder / "certificate.json")
        self.assertNotIn("ALARM", result.stdout)
        lines = result.stdout.splitlines()
        return result, {line.split(maxsplit=1)[1] for line in lines if line.startswith("verified")}

    def test_a_whole_certificate(self):
        result, verified = self.certified_and_checked("la-scala-1994-figure-3.5-without-leak")
        self.assertEqual(result.returncode, 0, result.stdout)
        self.assertIn("\n- required, PROVED: the frequency error stays below 0.05 rad/sample for ever\n", result.stdout)
        self.assertRegex(result.stdout, r"\n- PROVED: In double precision .* the frequency error never exceeds 0\.0")
        for part in ("theorem-2.9/printed", "theorem-2.9/errata", "contraction", "claim ekf/frequency-error-bound",
                     "claim ekf/settling-time", "claim ekf/guarantee", "verdict proved"):
            self.assertIn(part, verified)

    def test_theorem_with_a_leak(self):
        result, verified = self.certified_and_checked("frequency-noise-only")
        self.assertEqual(result.returncode, 1, result.stdout)  # nothing is required of it
        for part in ("theorem-2.9/printed", "theorem-2.9/errata", "claim theorem-2.9/past-errors"):
            self.assertIn(part, verified)

    def test_with_a_leak_a_radius_is_measured_from_the_steady_state_and_says_so(self):
        text = (ROOT / "tests/certificates/steady-set.toml").read_text()
        design = self.write(text.replace("[require]", "[require]\nfrequency_error_radius_at_least = 0.001"))
        self.run_here("certify", "--no-verify", design, "--out", "leak")
        result = verify("--json", self.folder / "leak/certificate.json")
        self.assertEqual(result.returncode, 0)
        sentences = {one["claim"]: one["sentence"] for one in json.loads(result.stdout)["sentences"]}
        self.assertIn(", measured from the steady state", sentences["ekf/frequency-error-radius"])

    def test_what_is_found_on_the_way_into_a_set_has_room_for_other_enclosures(self):
        text = DESIGN.replace("0.0023", "1e-4").replace("r = 0.05", "r = 0.1")
        design = self.write(text)
        self.run_here("certify", "--no-verify", design, "--out", "out")
        folder = self.folder / "out"
        result = verify("--design", design, *documents(folder), folder / "certificate.json")
        self.assertEqual(result.returncode, 1, result.stdout)  # nothing is required of it
        self.assertRegex(result.stdout, r"\nverified +claim ekf/capture\n")

    def test_another_design_and_another_document(self):
        name = "la-scala-1994-figure-3.5-without-leak"
        text = (ROOT / "designs" / (name + ".toml")).read_text()
        design = self.write(text)
        self.run_here("certify", "--no-verify", design, "--out", "out")
        certificate = self.folder / "out/certificate.json"
        self.assertEqual(verify("--design", design, certificate).returncode, 0)
        self.write(text.replace("noise = 0.001", "noise = 0.0010"), "same.toml")
        self.assertEqual(verify("--design", self.folder / "same.toml", certificate).returncode, 3)
        document = (self.folder / "out/certificate.md").read_text()
        flattering = document.replace("never exceeds 0.0", "never exceeds 0.00", 1)
        self.assertNotEqual(document, flattering)
        self.write(flattering, "flattering.md")
        self.assertEqual(verify("--markdown", self.folder / "flattering.md", certificate).returncode, 3)

    @takes_long
    def test_a_sentence_that_was_put_into_a_document(self):
        self.run_here("certify", "--no-verify", ROOT / "designs/la-scala-1994-figure-3.5-without-leak.toml", "--out", "out")
        certificate = self.folder / "out/certificate.json"
        for name in ("certificate.md", "published-theorems.md"):
            text = (self.folder / "out" / name).read_text()
            self.assertEqual(verify("--markdown", self.folder / "out" / name, certificate).returncode, 0)
            verdict = re.search(r"^- \*\*REFUTED\*\*.*$|^- \*\*PROVED\*\* \(.*$", text, re.MULTILINE).group()
            turned = verdict.replace("REFUTED", "PROVED") if "REFUTED" in verdict else verdict.replace("PROVED", "REFUTED")
            for forged in (text.replace("\n## ", "\nPROVED: the tracker tolerates any noise.\n\n## ", 1),
                           text + "\n- **PROVED** `ekf/limits`: it tolerates any noise.\n",
                           text.replace(verdict, turned), text.replace(verdict + "\n", "")):
                self.assertNotEqual(forged, text)
                self.write(forged, "forged.md")
                result = verify("--markdown", self.folder / "forged.md", certificate)
                self.assertEqual(result.returncode, 3, forged[:200])
                self.assertIn("NOT VERIFIED the document", result.stdout)

    def test_a_range_of_start_covariances(self):
        text = (ROOT / "designs/la-scala-1994-figure-3.5-without-leak.toml").read_text()
        steady = 'initial_covariance = "steady-state"'
        self.assertIn(steady, text)
        ranges = {"multiples": ("{ from = 0.6, to = 1.6 }", "every P(0|0) from 0.6 M to 1.6 M, M = ["),
                  "matrices": ("{ from = [[0.007, 0, 0], [0, 0.02, 0.006], [0, 0.006, 0.006]], "
                               "to = [[0.013, 0, 0], [0, 0.03, 0.009], [0, 0.009, 0.009]] }",
                               "every P(0|0) from [0.007, 0, 0; 0, 0.02, 0.006; 0, 0.006, 0.006] to [0.013, 0, 0; "
                               "0, 0.03, 0.009; 0, 0.009, 0.009] in the frame")}
        for name, (value, words) in ranges.items():
            design = self.write(text.replace(steady, "initial_covariance = " + value), name + ".toml")
            self.run_here("certify", "--no-verify", design, "--out", name)
            folder = self.folder / name
            result = verify("--design", design, *documents(folder), folder / "certificate.json")
            self.assertEqual(result.returncode, 0, result.stdout)
            self.assertIn(words, result.stdout)
            certificate = json.loads((folder / "certificate.json").read_text())
            asked = certificate["design"]["assume"]["initial_covariance"]
            asked["to"] = asked["from"]
            forged = verify(self.write(json.dumps(certificate), "forged.json"))
            self.assertEqual(forged.returncode, 3)
        # More than any set holds: the reason names it.
        design = self.write(text.replace(steady, "initial_covariance = { from = 0.01, to = 1 }"))
        self.run_here("certify", "--no-verify", design, "--out", "wide")
        top = (self.folder / "wide/certificate.md").read_text().split("##")[0]
        self.assertIn("**UNDECIDED**: ", top)
        self.assertRegex(top, r"Why not: .* every P\(0\|0\) from 0.01 M to 1 M, .* a narrower range may help")
        self.assertEqual(verify(self.folder / "wide/certificate.json").returncode, 1)

    @takes_long
    def test_two_channels_that_are_not_at_right_angles(self):
        # The loop of a public motor controller: its angle is that of a point on an ellipse.
        design = self.write("""\
name = "a motor's phase, its sine and cosine 0.1 rad off"
tracker = "model"
source = "ours"

[model]
samples = ['ca', 'sa']
parameters = { dt = '1/12500', kp = 2000, ki = 30000 }
states = ['phase', 'speed']
angles = ['phase']
step = '''
delta  = atan2(sa*cos(phase) - ca*sin(phase), ca*cos(phase) + sa*sin(phase))
phase' = phase + (speed + kp*delta)*dt
speed' = speed + ki*delta*dt
'''
frequency = 'speed*dt'
start = { phase = 0, speed = 'omega/dt' }

[assume]
amplitude = 1
sample_rate = 12500
frequency = { hz = [200, 200.1] }
noise = 0
signal = ['A*cos(phi + 0.1)', 'A*sin(phi)']
""")
        self.run_here("certify", design, "--out", "out")
        folder = self.folder / "out"
        result = verify("--design", design, *documents(folder), folder / "certificate.json")
        self.assertEqual(result.returncode, 1, result.stdout)  # VERIFIED, and nothing is required
        ripple = re.search(r"varies by at most (\S+) rad/sample", result.stdout)
        # Simulations have 0.1574 Hz.
        self.assertAlmostEqual(float(ripple[1]) * 12500 / (2 * math.pi), 0.1574, delta=0.0002)

    def test_exit_status(self):
        certificates = ROOT / "tests" / "certificates"
        accepted = str(certificates / "accepted" / "one-set.json")
        self.assertIn(verify(accepted).returncode, (0, 1))
        self.assertIn(verify("--precision", "64", accepted).returncode, (0, 1))
        with_more = json.loads(pathlib.Path(accepted).read_text())
        with_more["design"]["colour"] = "green"
        result = verify(self.write(json.dumps(with_more), "more.json"))
        self.assertEqual(result.returncode, 3)
        self.assertIn("design.colour is not read by any check", result.stdout)
        self.assertIn("NOT VERIFIED budget", verify("--budget", "1000", accepted).stdout)
        self.assertEqual(verify("--budget", "1000", accepted).returncode, 3)
        malformed = self.write('{"schema": 1, "schema": 1}', "doubled.json")
        for arguments in ([malformed], ["no-such-file.json"], [], ["--precision", "3", accepted], [accepted, accepted],
                          ["--budget", "0", accepted], ["--design", "no-such-file.toml", accepted]):
            self.assertEqual(verify(*arguments).returncode, 2, arguments)
        version = verify("--version")
        self.assertEqual(version.returncode, 0)
        project = re.search(r"project\(veritrack VERSION (\S+)", (ROOT / "CMakeLists.txt").read_text()).group(1)
        self.assertRegex(version.stdout, rf"^veritrack-verify {re.escape(project)}, reads veritrack/certificate/\d+\n"
                                         r"  Arb \d.*\n  FLINT \d.*\n  MPFR \d.*\n  Nettle \d.*\n$")
        with open("/dev/full", "w", encoding="utf-8") as full:
            self.assertEqual(subprocess.run([CHECKER, accepted], stdout=full, check=False).returncode, 2)


if __name__ == "__main__":
    unittest.main()
