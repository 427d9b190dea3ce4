"""The README shows what the program and the code really do."""

import pathlib
import re
import subprocess
import unittest

from support import ROOT, CliTestCase

README = (ROOT / "README.md").read_text()


def block(after, language):
    """The first fenced block of that language after a text."""
    start = README.index(after)
    return re.search(rf"```{language}\n(.*?)```", README[start:], re.DOTALL).group(1)


class Readme(CliTestCase):
    def test_the_excerpt_is_from_a_certificate(self):
        result = self.run_here("certify", "--no-verify", ROOT / "designs/la-scala-1994-figure-3.5-without-leak.toml", "--out", "out")
        self.assertEqual(result.returncode, 0, result.stderr)
        document = "".join((self.folder / "out" / name).read_text() for name in ("certificate.md", "published-theorems.md"))
        excerpt = [line[2:] for line in README.splitlines() if re.match("> (- |\\*\\*|Why)", line)]
        self.assertGreaterEqual(len(excerpt), 2)
        for line in excerpt:
            self.assertIn(line, document)

    def test_the_certificate_that_is_shown_is_that_of_make_certificate_and_the_words_stand_before_it(self):
        design = re.search(r"^DESIGN +\?= (\S+)", (ROOT / "Makefile").read_text(), re.MULTILINE).group(1)
        before = README[:README.index("> # PROVED")]
        self.assertIn(f"({design})", before)
        for word in ("*Lock*: ", "*Leak* (", "*in phase*", "*in quadrature*", "Hilbert filter"):
            self.assertIn(word, before)
        self.assertNotIn("Theorem", before)

    def test_every_command_that_is_named_exists(self):
        commands = set(re.findall(r"veritrack ([a-z]+)\b", README))
        self.assertGreaterEqual(len(commands), 7)
        for command in commands:
            self.assertEqual(self.run_here(command, "--help").returncode, 0, command)

    def test_the_embedding_example_compiles_and_tracks(self):
        source = (ROOT / "docs/example/track.cpp").read_text()
        shown = block("A tracker in your own program", "cpp")
        self.assertIn(shown.strip(), source)
        program = self.folder / "track"
        eigen = subprocess.run(["pkg-config", "--cflags", "eigen3"], capture_output=True, text=True, check=True).stdout
        subprocess.run(["g++", "-std=c++20", "-O1", "-Wall", "-Wextra", "-Werror", f"-I{ROOT}", *eigen.split(),
                        ROOT / "docs/example/track.cpp", "-o", program], check=True)
        printed = subprocess.run([program], capture_output=True, text=True, check=True).stdout
        self.assertEqual(printed, "0.5000 rad/sample\n")

    def test_every_file_and_folder_that_is_named_exists(self):
        named = re.findall(r"\]\(([^)#:]+)\)|^\| `([^`]+)`", README, re.MULTILINE)
        self.assertGreaterEqual(len(named), 10)
        for link, folder in named:
            self.assertTrue((ROOT / (link or folder)).exists(), link or folder)

    def test_every_folder_with_code_is_in_the_layout(self):
        layout = {folder.rstrip("/") for folder in re.findall(r"^\| `([^`]+)`", README, re.MULTILINE)}
        tracked = subprocess.run(["git", "ls-files", "*.cpp", "*.hpp"], cwd=ROOT, capture_output=True, text=True,
                                 check=True).stdout.split()
        for path in map(pathlib.PurePosixPath, tracked):
            self.assertTrue(any(str(parent) in layout for parent in path.parents), path)


if __name__ == "__main__":
    unittest.main()
