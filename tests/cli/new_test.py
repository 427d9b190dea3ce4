"""veritrack new: a design file to begin with."""
import re
import unittest

from support import ROOT, CliTestCase

TRACKERS = re.findall(r"VERITRACK_TRACKER\((\w+)\)", (ROOT / "certificates/trackers.def").read_text())


class New(CliTestCase):
    def names(self):
        message = self.run_here("new", "no-such-tracker").stderr
        return re.search(r"\{(.*)\}", message).group(1).split(",")

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


if __name__ == "__main__":
    unittest.main()
