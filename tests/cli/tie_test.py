"""veritrack tie: the program that the user builds beside the listing that the certificate is about."""
import os
import pathlib
import re
import unittest

from support import ROOT, CliTestCase, run

DESIGN = ROOT / "designs" / "code" / "motor-pll.toml"
FUSES = "fma" in pathlib.Path("/proc/cpuinfo").read_text().split()
LOOP = """#include <math.h>
#ifndef GAIN
#define GAIN 0.1f
#endif
#ifndef SIGN
#define SIGN +
#endif
#ifndef LIMIT
#define LIMIT w > 1.0f
#endif
#ifndef SUM
#define SUM (theta + w) + GAIN * e
#endif
static float theta, w;
void setup(void) { w = 0.3f; }
void step(float i, float q) {
  const float e = q * cosf(theta) - i * sinf(theta);
  w = w SIGN 0.01f * e;
  if (LIMIT) w = 1.0f;
  theta = SUM;
  if (theta > 3.14159265f) theta -= 6.28318531f;
  if (theta < -3.14159265f) theta += 6.28318531f;
}
float frequency(void) { return w; }
"""
LOOP_DESIGN = """name = "a loop"
tracker = "model"
[code]
files = ['loop.c']
[assume]
amplitude = 1
frequency = [0.2, 0.9]
noise = 0.1
"""


class Tie(CliTestCase):
    def setUp(self):
        super().setUp()
        self.write(LOOP, "loop.c")
        self.write(LOOP_DESIGN, "loop.toml")

    def tie(self, *builds, options=()):
        return self.run_here("tie", "loop.toml", "--states", "1000", *options,
                             *(word for build in builds for word in ("--build", build)))

    def test_equal_builds(self):
        result = run("tie", DESIGN, "--build", "gcc -O0", "--build", "gcc -O2", "--build", "clang -O2")
        self.assertEqual((result.returncode, result.stderr), (0, ""), result.stdout)
        lines = result.stdout.splitlines()
        self.assertEqual(lines[0], "EQUAL: 4000 states, 3 builds: each bit of pll.phase, pll.speed and the frequency")
        self.assertEqual(lines[1:4], [f"{build}: equal in 4000 states" for build in ("gcc -O0", "gcc -O2", "clang -O2")])
        self.assertRegex(result.stdout, r"seed 1: 4000 states and samples, 400 of them in pairs between which a comparison")
        self.assertRegex(result.stdout, r"left out, because the listing does not speak of them: \d+ where not: a loop has "
                                        r"ended \(pll\.c:\d+:\d+\)")
        self.assertIn("This is a test, no proof.", result.stdout)

    def test_builds_that_change_the_arithmetic_differ(self):
        builds = ["-Ofast"] + (["-mfma -ffp-contract=fast"] if FUSES else [])
        for flags in builds:
            with self.subTest(flags):
                result = run("tie", DESIGN, "--build", "gcc -O2", "--build", f"gcc -O2 {flags}")
                self.assertEqual(result.returncode, 1, result.stdout)
                self.assertTrue(result.stdout.startswith("DIFFERENT: 1 of 2 builds\ngcc -O2: equal in 4000 states\n"))
                values = dict(re.findall(r"^    (program|listing): (\S+)", result.stdout, re.MULTILINE))
                self.assertNotEqual(values["program"], values["listing"])
                self.assertRegex(result.stdout, r"first difference: pll\.(phase|speed) after a step, computed at pll\.c:\d+:")
                for name in ("pll.phase", "pll.speed", "sample alpha", "sample beta"):
                    self.assertRegex(result.stdout, rf"(?m)^    {name} = -?0x")

    def test_a_program_of_another_source_differs(self):
        self.assertEqual(self.tie("gcc -O2").returncode, 0)
        for name, flag in {"the last bit of a constant": "-DGAIN=0.10000001f", "a difference for a sum": "-DSIGN=-",
                           "a limit one unit lower": "-DLIMIT=w>=0.99999994f",
                           "a limit one unit higher": "-DLIMIT=w>1.0000001f",
                           "another order": "-DSUM=theta+(w+GAIN*e)"}.items():
            with self.subTest(name):
                result = self.tie("gcc -O2", f"gcc -O2 {flag}")
                self.assertEqual(result.returncode, 1, result.stdout + result.stderr)
                self.assertTrue(result.stdout.startswith("DIFFERENT: 1 of 2 builds\ngcc -O2: equal in 1000 states\n"))

    def test_the_same_words_every_time_and_others_for_another_seed(self):
        first, again = self.tie("gcc -O2"), self.tie("gcc -O2")
        self.assertEqual(first.stdout, again.stdout)
        other = self.tie("gcc -O2 -DGAIN=0.11f", options=("--seed", "7"))
        self.assertNotEqual(self.tie("gcc -O2 -DGAIN=0.11f").stdout, other.stdout)
        self.assertIn("Drawn with seed 7:", other.stdout)
        self.assertNotIn(str(self.folder), first.stdout + other.stdout)
        self.assertNotIn("/tmp", first.stdout + other.stdout)

    def test_input_that_cannot_be_used(self):
        for said, result in {
            "has none; allowed: a design with [code]": run("tie", ROOT / "designs/models/sogi-fll.toml", "--build", "gcc"),
            "--build is required": self.run_here("tie", "loop.toml"),
            "no-compiler cannot be run": self.tie("no-compiler -O2"),
            "error: ": self.tie("gcc -DSUM=nothing"),
            "allowed: NAME=EXPRESSION": self.tie("gcc", options=("--state", "theta")),
            "the state theta cannot be set": self.tie("gcc", options=("--state", "theta=angle")),
            "has answered 0 of": self.tie("gcc", options=("--emulator", "/bin/true")),
        }.items():
            with self.subTest(said):
                self.assertEqual((result.returncode, result.stdout), (2, ""))
                self.assertIn(said, result.stderr)

    def test_the_words_of_a_build_are_no_shell_s(self):
        marker = self.folder / "marker"
        result = self.tie(f"gcc -O2 ; touch {marker}")
        self.assertEqual(result.returncode, 2)
        self.assertFalse(marker.exists())

    def test_tie_runs_the_code_and_leaves_no_folder_behind(self):
        marker = self.folder / "marker"
        self.write(LOOP + "#ifdef RUN\n#include <stdio.h>\n__attribute__((constructor)) static void run(void) { FILE* f = "
                   f'fopen("{marker}", "w"); if (f) {{ fclose(f); }} }}\n#endif\n', "loop.c")
        work = self.folder / "work"
        work.mkdir()
        result = self.run_here("tie", "loop.toml", "--build", "gcc -O2 -DRUN", env=os.environ | {"TMPDIR": str(work)})
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertTrue(marker.exists())
        self.assertEqual(list(work.iterdir()), [])

    def test_help_says_that_the_code_is_run(self):
        self.assertIn("the only command that executes code of yours", run("tie", "--help").stdout)


if __name__ == "__main__":
    unittest.main()
