"""Certificates as written, checked by a program that shares no code with the one that wrote them."""

import json
import os
import pathlib
import subprocess
import unittest

from support import ROOT, CliTestCase

CHECKER = os.environ["VERITRACK_VERIFY"]


def verify(*arguments):
    return subprocess.run([CHECKER, *map(str, arguments)], capture_output=True, text=True, check=False)


class Verify(CliTestCase):
    def certified_and_checked(self, name):
        """The checker's last line for a shipped design, and the verified parts."""
        design = ROOT / "designs" / (name + ".toml")
        self.run_here("certify", design, "--out", name)
        result = verify(self.folder / name / "certificate.json")
        self.assertIn(result.returncode, (0, 1), result.stderr)
        self.assertNotIn("ALARM", result.stdout)
        lines = result.stdout.splitlines()
        return lines[-1], {line.split(maxsplit=1)[1] for line in lines if line.startswith("verified")}

    def test_a_whole_certificate(self):
        last, verified = self.certified_and_checked("la-scala-1994-figure-3.5-without-leak")
        self.assertTrue(last.startswith("VERIFIED"), last)
        for part in ("theorem-2.9/printed", "theorem-2.9/errata", "contraction", "claim ekf/frequency-error-bound",
                     "claim ekf/settling-time", "claim ekf/guarantee", "verdict proved"):
            self.assertIn(part, verified)

    def test_theorem_with_a_leak(self):
        _, verified = self.certified_and_checked("frequency-noise-only")
        for part in ("theorem-2.9/printed", "theorem-2.9/errata", "claim theorem-2.9/past-errors"):
            self.assertIn(part, verified)

    def test_with_a_leak_a_radius_is_measured_from_the_steady_state_and_says_so(self):
        text = (ROOT / "designs/la-scala-1994-figure-3.4.toml").read_text()
        design = self.write(text.replace("[require]", "[require]\nfrequency_error_radius_at_least = 0.05"))
        self.run_here("certify", design, "--out", "leak")
        path = self.folder / "leak/certificate.json"
        self.assertEqual(verify(path).returncode, 0)
        honest = path.read_text()
        forged = honest.replace(", measured from the steady state", "")
        self.assertNotEqual(forged, honest)
        self.assertEqual(verify(self.write(forged, "forged.json")).returncode, 1)

    def test_exit_status(self):
        certificates = ROOT / "tests" / "certificates"
        accepted = str(certificates / "accepted" / "one-set.json")
        self.assertEqual(verify(accepted).returncode, 0)
        self.assertEqual(verify("--precision", "64", accepted).returncode, 0)
        with_a_claim = json.loads(pathlib.Path(accepted).read_text())
        description = json.loads((certificates / "rejected" / "unknown-claim.json").read_text())
        with_a_claim["claims"].append(description["patch"][0]["value"])
        self.assertEqual(verify(self.write(json.dumps(with_a_claim), "claim.json")).returncode, 1)
        malformed = self.write('{"schema": 1, "schema": 1}', "doubled.json")
        for arguments in ([malformed], ["no-such-file.json"], [], ["--precision", "3", accepted], [accepted, accepted]):
            self.assertEqual(verify(*arguments).returncode, 2, arguments)


if __name__ == "__main__":
    unittest.main()
