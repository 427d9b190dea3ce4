"""veritrack new: a design file to begin with."""
import pathlib
import re
import shutil
import unittest

from support import ROOT, CliTestCase, takes_long

TRACKERS = re.findall(r"VERITRACK_TRACKER\((\w+)\)", (ROOT / "certificates/trackers.def").read_text())


class New(CliTestCase):
    def names(self):
        message = self.run_here("new", "no-such-tracker").stderr
        return re.search(r"\{(.*)\}", message).group(1).split(",")

    @takes_long
    def test_each_tracker_has_one_which_is_proved_as_it_is(self):
        self.assertEqual(len(self.names()), len(TRACKERS))
        for tracker in self.names():
            with self.subTest(tracker=tracker):
                result = self.run_here("new", tracker, f"{tracker}.toml")
                self.assertEqual((result.returncode, result.stderr), (0, ""))
                self.assertIn(f"veritrack check {tracker}.toml", result.stdout)
                result = self.run_here("check", "--strict", f"{tracker}.toml")
                self.assertEqual((result.returncode, result.stderr), (0, ""))
                self.assertIn("proved", result.stdout)

    def test_before_the_first_key_it_says_what_the_tracker_is_for(self):
        for tracker in self.names():
            text = self.run_here("new", tracker).stdout
            preface = text[:text.index("\nname = ")]
            for word in ("for. ", "channel", "quadrature" if tracker != "kkl-observer" else "sinusoid", "ock",
                         "Units. "):
                self.assertIn(word, preface, tracker)

    def test_every_key_of_the_tracker_itself_is_named(self):
        listed = re.findall(r"^(design|model)[.](\w+) \((.*)\)$", self.run_here("explain").stdout, re.MULTILINE)
        self.assertGreater(len(listed), 10)
        for tracker in self.names():
            text = self.run_here("new", tracker).stdout
            for _, key, trackers in listed:
                if tracker in trackers.split(", "):
                    self.assertRegex(text, rf"(?m)^(# )?{key}\b", tracker)

    def test_without_a_file_it_is_printed(self):
        result = self.run_here("new", "quadrature-ekf")
        self.assertEqual(result.stdout, (ROOT / "certificates/quadrature/new.toml").read_text())

    def test_a_file_that_exists_is_not_touched(self):
        path = self.write("mine", "mine.toml")
        result = self.run_here("new", "model", "mine.toml")
        self.assertEqual(result.returncode, 2)
        self.assertIn("exists already", result.stderr)
        self.assertEqual(path.read_text(), "mine")


class NewOfCode(CliTestCase):
    """veritrack new model --c FILE."""

    LOOP = ("#include <math.h>\nstatic float th, w = 0.3f;\n"
            "void update(float y) {\n  const float e = -y * sinf(th);\n  w += 4e-4f * e;\n  th += w + 0.028f * e;\n"
            "  if (th > 3.14159265f) th -= 6.28318531f; else if (th < -3.14159265f) th += 6.28318531f;\n}\n")

    def test_the_loop_of_a_motor_is_proved_without_an_edit(self):
        for name in ("pll.c", "pll.h"):
            shutil.copy(ROOT / "designs" / "code" / name, self.folder)
        result = self.run_here("new", "model", "--c", "pll.c")
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        self.assertIn("put your numbers for kp, ki, dt", result.stdout)
        harness = (self.folder / "pll-harness.c").read_text()
        self.assertIn('#include "pll.h"', harness)
        self.assertIn("// Guessed: pll_run (pll.c:24) takes a sample", harness)
        self.assertIn("// Guessed: speed (pll.h:4) is the estimate, rad/s", harness)
        self.assertIn("files = ['pll.c', 'pll-harness.c']", (self.folder / "pll.toml").read_text())
        result = self.run_here("certify", "pll.toml", "--out", "out")
        self.assertEqual(result.returncode, 0, result.stderr)
        certificate = (self.folder / "out" / "certificate.md").read_text()
        self.assertIn("# PROVED: ", certificate)
        self.assertIn("kp, ki, dt: guesses of veritrack new", certificate)

    def test_the_design_may_lie_elsewhere_and_nothing_is_overwritten(self):
        (self.folder / "src").mkdir()
        self.write(self.LOOP, "src/loop.c")
        (self.folder / "designs").mkdir()
        result = self.run_here("new", "model", "--c", "src/loop.c", "designs/my.toml")
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        harness = self.folder / "designs" / "my-harness.c"
        self.assertIn('#include "../src/loop.c"', harness.read_text())
        self.assertEqual(self.run_here("show", "designs/my.toml").returncode, 0)
        design = (self.folder / "designs" / "my.toml").read_text()
        self.assertIn("frequency = [0.294, 0.306]", design)
        self.assertNotIn(str(self.folder), design + harness.read_text())
        harness.write_text("mine")
        for again in ("my.toml", "other.toml"):
            (self.folder / "designs" / "other-harness.c").write_text("mine")
            result = self.run_here("new", "model", "--c", "src/loop.c", f"designs/{again}")
            self.assertEqual(result.returncode, 2)
            self.assertIn("exists already", result.stderr)
        self.assertEqual(harness.read_text(), "mine")
        self.assertFalse((self.folder / "designs" / "other.toml").exists())

    def test_a_function_is_chosen_and_what_is_none_says_why(self):
        self.write(self.LOOP + "void other(float y) { w -= y; }\nfloat wrap(float x) { return x; }\n", "loop.c")
        result = self.run_here("new", "model", "--c", "loop.c", "--function", "wrap")
        self.assertEqual(result.returncode, 2)
        self.assertRegex(result.stderr, r"loop\.c:10:7: wrap is no step: it keeps nothing")
        result = self.run_here("new", "model", "--c", "loop.c", "--function", "walk")
        self.assertIn("allowed: update (line 3), other (line 9)", result.stderr)
        self.assertEqual([*self.folder.glob("*.toml")], [])
        result = self.run_here("new", "model", "--c", "loop.c", "--function", "other")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("others: update (loop.c:3)", (self.folder / "loop-harness.c").read_text())

    def test_what_is_not_ready_is_written_with_the_reason(self):
        self.write("static float a;\nvoid run(float y) { a += y; }\n", "loop.c")
        result = self.run_here("new", "model", "--c", "loop.c")
        self.assertEqual(result.returncode, 1)
        self.assertRegex(result.stderr, r"loop-harness\.c:\d+:\d+: .*PUT_FREQUENCY_HERE")
        self.assertTrue((self.folder / "loop.toml").exists())
        self.write("float f(float x) { return x }\n", "broken.c")
        self.assertRegex(self.run_here("new", "model", "--c", "broken.c").stderr, r"broken\.c:1:28: error: expected ';'")
        self.assertEqual(self.run_here("new", "quadrature-ekf", "--c", "loop.c", "x.toml").returncode, 2)

    def test_files_of_other_shapes_have_a_recursion(self):
        folder = ROOT / "tests" / "lift" / "functions"
        for name, options, code in (("motor_pll.c", [], 0), ("motor_pll.c", ["--function", "motor_pll_run"], 0),
                                    ("../../../designs/code/sogi-fll.c", ["--function", "step"], 0), ("lock_counter.c", [], 0),
                                    ("kalman_notch.c", [], 0), ("sine_table.c", [], 1),
                                    ("template_loop.cpp", ["--function", "feed"], 0)):
            with self.subTest(name, options=options):
                design = self.folder / f"{pathlib.Path(name).name}-{len(options)}.toml"
                result = self.run_here("new", "model", "--c", folder / name, design, *options)
                self.assertEqual(result.returncode, code, result.stderr)
                self.assertNotIn("error:", result.stderr)  # what clang says
                self.assertEqual(self.run_here("show", design).returncode, 2 * code)


if __name__ == "__main__":
    unittest.main()
