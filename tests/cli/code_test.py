"""[code]: certificates about functions in C."""
import json
import os
import pathlib
import shutil
import subprocess
import tempfile
import unittest

from support import ROOT, run, takes_long

DESIGN = ROOT / "designs" / "code" / "motor-pll.toml"
ONE_CHANNEL = "sogi-fll.toml"
VERIFY = os.environ["VERITRACK_VERIFY"]
HARNESS = "float frequency(void) { return w; }\n"


def verify(*arguments):
    return subprocess.run([VERIFY, *map(str, arguments)], capture_output=True, text=True, timeout=300, check=False)


class Code(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = pathlib.Path(scratch.name)
        for file in DESIGN.parent.iterdir():
            shutil.copy(file, self.folder)
        self.design = self.folder / DESIGN.name

    def certificate(self, design=None):
        result = run("certify", design or self.design, "--out", self.folder / "out")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("VERIFIED", result.stdout + result.stderr)
        return json.loads((self.folder / "out" / "certificate.json").read_text())

    def verdict(self, certificate):
        path = self.folder / "forged.json"
        path.write_text(json.dumps(certificate))
        return verify(path).returncode

    def test_the_sentences_are_about_the_program_and_its_arithmetic(self):
        self.certificate()
        document = (self.folder / "out" / "certificate.md").read_text()
        self.assertIn("In IEEE 754 arithmetic of the listing of `step` and `frequency` in pll.c (SHA-256 ", document)
        self.assertIn("In exact arithmetic of the listing", document)  # what is true to first order
        self.assertIn("atan2.f32", document)
        # And which line makes most of its rounding.
        self.assertIn("Most of the rounding is in line 36 of pll.c: computed in double precision, with `pll.speed` kept in "
                      "it, it would be ", document)
        self.assertIn("There `pll.speed` stands still where less than 0.00024 is added to it", document)

    def test_a_step_that_a_condition_chooses_is_certified(self):
        shutil.copy(ROOT / "tests" / "lift" / "functions" / "optional_result.cpp", self.folder)
        design = self.folder / "optional.toml"
        design.write_text("name = 'optional'\ntracker = 'model'\n[code]\nfiles = ['optional_result.cpp']\n"
                          "[assume]\namplitude = 1\nfrequency = [0.2, 0.3]\nnoise = 0.01\n")
        genuine = self.certificate(design)
        tolerated = [float(claim["noise"]) for claim in genuine["claims"] if "noise" in claim]
        self.assertGreater(max(tolerated), 0.3)
        # With more noise a sample may be below the floor, where the loop goes on without it.
        self.assertLess(max(tolerated), 0.8)
        step = genuine["design"]["model"]["step"]
        for before, after in (("if(r1 < ", "if(r1 > "), ("angle + if(", "angle - if(")):
            with self.subTest(after):
                changed = json.loads(json.dumps(genuine))
                changed["design"]["model"]["step"] = step.replace(before, after)
                self.assertNotEqual(changed, genuine)
                self.assertIn(self.verdict(changed), (2, 3))

    def test_forgeries_are_refused(self):
        genuine = self.certificate()
        self.assertEqual(self.verdict(genuine), 0)
        text = genuine["design"]["code"]["listing"]
        self.assertIn("f32:0x1.f4p+10", text)
        forged = {
            "another constant": text.replace("f32:0x1.f4p+10", "f32:0x1.f4p+9"),
            "the last bit of a constant": text.replace("f32:0x1.4f8b58p-14", "f32:0x1.4f8b5ap-14"),
            "a sum for a difference": text.replace("= fsub.f32", "= fadd.f32", 1),
            "the samples exchanged": text.replace("atan2.f32 r1 r0", "atan2.f32 r0 r1"),
            "another wrap": text.replace("0x1.921fb6p+2", "0x1.921fb6p+1"),
            "another limit of a wrap": text.replace("f32:0x1.921fb6p+1", "f32:0x1p+2"),
            "a line more": text + "must-be-zero i1:1 nothing\n",
        }
        for name, listing in forged.items():
            with self.subTest(name):
                self.assertNotEqual(listing, text)
                changed = json.loads(json.dumps(genuine))
                changed["design"]["code"]["listing"] = listing
                self.assertIn(self.verdict(changed), (2, 3))

    def test_forged_rounding_is_refused(self):
        genuine = self.certificate()
        self.assertEqual(genuine["gains"]["rounding"][0], "0x0p+0")
        for name, rooms in {"no room": ["0x0p+0", "0x0p+0"], "little room": ["0x0p+0", "0x1p-10"],
                            "less than none": ["0x0p+0", "-0x1p+13"], "a state less": ["0x0p+0"],
                            "room of an angle": ["0x1p+0", genuine["gains"]["rounding"][1]],
                            "too much": ["0x0p+0", "0x1p+40"]}.items():
            with self.subTest(name):
                changed = json.loads(json.dumps(genuine))
                changed["gains"]["rounding"] = rooms
                self.assertIn(self.verdict(changed), (2, 3))
        # The error of exact arithmetic is less than that of the program.
        changed = json.loads(json.dumps(genuine))
        bias = next(claim for claim in changed["claims"] if "bias_low" in claim)
        bias["bias_low"], bias["bias_high"] = "-0.0000001", "0.0000001"
        self.assertIn(self.verdict(changed), (2, 3))

    @takes_long
    def test_a_loop_of_one_channel_with_limits_has_its_rounding_too(self):
        genuine = self.certificate(self.folder / ONE_CHANNEL)
        document = (self.folder / "out" / "certificate.md").read_text()
        self.assertIn("In IEEE 754 arithmetic of the listing of `step` and `frequency` in sogi-fll.c", document)
        self.assertNotIn("In exact arithmetic", document)
        self.assertEqual(genuine["tubes"], [])
        self.assertNotIn("## The certified sets", document)  # which are tubes
        self.assertIn("rounding of the program", document)
        room = genuine["gains"]["rounding"]
        for name, rooms in {"little room": [room[0], room[1], "0x1p-20"], "none": [room[0], "0x0p+0", room[2]],
                            "less than none": ["-0x1p+3", room[1], room[2]], "a state less": room[:2],
                            "so much that a divisor may be 0": ["0x1p+1", "0x1p+1", room[2]]}.items():
            with self.subTest(name):
                changed = json.loads(json.dumps(genuine))
                changed["gains"]["rounding"] = rooms
                self.assertIn(self.verdict(changed), (2, 3))
        text = genuine["design"]["code"]["listing"]
        changed = json.loads(json.dumps(genuine))
        changed["design"]["code"]["listing"] = text.replace("f32:0x1.6a0902p+0", "f32:0x1.6a0904p+0")
        self.assertNotEqual(changed["design"]["code"]["listing"], text)
        self.assertIn(self.verdict(changed), (2, 3))
        # Without the rounding it is a certificate about exact arithmetic, which the document is not.
        changed = json.loads(json.dumps(genuine))
        del changed["gains"]["rounding"]
        (self.folder / "exact.json").write_text(json.dumps(changed))
        document = self.folder / "out" / "certificate.md"
        self.assertEqual(verify("--markdown", document, self.folder / "out" / "certificate.json").returncode, 0)
        self.assertNotEqual(verify("--markdown", document, self.folder / "exact.json").returncode, 0)
        changed = json.loads(json.dumps(genuine))
        bias = next(claim for claim in changed["claims"] if "bias_low" in claim)
        bias["bias_low"], bias["bias_high"] = "-0.0000014", "-0.0000012"  # of exact arithmetic
        self.assertIn(self.verdict(changed), (2, 3))

    def test_an_arc_tangent_of_its_own_counts_as_noise(self):
        genuine = self.certificate(self.folder / "fast-arc-tangent.toml")
        document = (self.folder / "out" / "certificate.md").read_text()
        self.assertIn("In exact arithmetic of the listing of `step` and `frequency` in fast-arc-tangent.c", document)
        self.assertIn("with atan2(beta, alpha) in place of r21, which is within 0.0103 rad of it, up to whole turns, where "
                      "the larger sample has a size of 2^-40 to 2^40", document)
        self.assertIn("noise of at most 0.5, and 0.0103 rad of the arc tangent", document)
        self.assertIn("r21 = select.f32", document)  # the listing is the program's
        arc = genuine["design"]["code"]["arc_tangent"]
        for name, change in {"nearer than it is": {"error": "0.0101"}, "smaller than it is": {"largest": "3.1414"},
                             "another register": {"register": "r20"}, "no register": {"register": "21"},
                             "no number": {"error": "0.0103 or so"}, "more": {"kind": "sine"}}.items():
            with self.subTest(name):
                changed = json.loads(json.dumps(genuine))
                changed["design"]["code"]["arc_tangent"] = arc | change
                self.assertIn(self.verdict(changed), (2, 3))
        changed = json.loads(json.dumps(genuine))
        del changed["design"]["code"]["arc_tangent"]
        self.assertIn(self.verdict(changed), (2, 3))
        # What it is off is in the claims.
        limits = next(claim for claim in genuine["claims"] if claim["id"] == "model/limits")
        for key, value in {"noise": "0.99", "frequency_error": "0.0021"}.items():
            with self.subTest(key):
                changed = json.loads(json.dumps(genuine))
                claim = next(claim for claim in changed["claims"] if claim["id"] == "model/limits")
                claim[key] = value
                self.assertNotEqual(limits[key], value)
                self.assertIn(self.verdict(changed), (2, 3))

    def test_another_file_is_noticed(self):
        self.certificate()
        with open(self.folder / "pll.c", "a", encoding="utf-8") as file:
            file.write("/* changed */\n")
        result = verify(self.folder / "out" / "certificate.json", "--design", self.design)
        self.assertEqual(result.returncode, 3)
        self.assertIn("pll.c", result.stdout)

    def test_included_files_are_named_and_compared(self):
        genuine = self.certificate()
        self.assertEqual([file["name"] for file in genuine["design"]["code"]["included"]], ["pll.h"])
        self.assertIn("pll.h (SHA-256 ", (self.folder / "out" / "certificate.md").read_text())
        with open(self.folder / "pll.h", "a", encoding="utf-8") as file:
            file.write("/* changed */\n")
        result = verify(self.folder / "out" / "certificate.json", "--design", self.design)
        self.assertEqual(result.returncode, 3)
        self.assertIn("pll.h", result.stdout)

    def message(self, source):
        (self.folder / "loop.c").write_text(source)
        text = self.design.read_text().replace("files = ['pll.c', 'harness.c']", "files = ['loop.c']")
        self.design.write_text(text)
        result = run("show", self.design)
        self.assertEqual(result.returncode, 2, result.stdout)
        return result.stderr

    def test_refusals_name_file_line_and_column(self):
        begin = "#include <math.h>\nstatic float th, w;\nvoid setup(void) { w = 0.3f; }\n"
        for body, said in {
            "void step(float y) { float e = y * sinf(th); th += w + 0.1f * e; w += 0.01f * e; }\n": "th grows for ever",
            "float helper(float);\nvoid step(float y) { w += helper(y); }\n": "a call of helper",
            "void step(float y) { w += y }\n": "expected ';'",
            "void step(float y) { w += (float)(int)(y * 100) * 0.01f; }\n": "no rule",
            "void step(float y) { while (y > 0.1f) { y *= 0.5f; } w += y; }\n": "a loop has ended",
        }.items():
            with self.subTest(said):
                design = self.design.read_text()
                message = self.message(begin + body + HARNESS)
                self.assertIn(said, message)
                self.assertRegex(message, r"loop\.c:\d+:\d+: ")
                self.design.write_text(design)

    def test_nothing_of_the_user_is_run(self):
        marker = self.folder / "marker"
        source = (self.folder / "harness.c").read_text()
        (self.folder / "harness.c").write_text(
            "#include <stdio.h>\n" + source +
            f'__attribute__((constructor)) static void run(void) {{ FILE* f = fopen("{marker}", "w"); '
            "if (f) { fclose(f); } }\n")
        run("show", self.design)
        self.assertFalse(marker.exists())
        self.assertTrue(shutil.which("clang-14"))


if __name__ == "__main__":
    unittest.main()
