"""The front page and what it leads to show what the program and the code really do, and every link leads somewhere."""

import pathlib
import re
import subprocess
import unittest

import yaml
from support import ROOT, CliTestCase

README = (ROOT / "README.md").read_text()
CONTRIBUTING = (ROOT / "CONTRIBUTING.md").read_text()
PAPERS = (ROOT / "docs/papers.md").read_text()
COMMANDS = (ROOT / "docs/command-line.md").read_text()


def blocks(text, language=""):
    found = re.findall(r"^```(\w*)\n(.*?)^```$", text, re.MULTILINE | re.DOTALL)
    return [block for of, block in found if of == language]


def tracked(*patterns):
    listed = subprocess.run(["git", "ls-files", *patterns], cwd=ROOT, capture_output=True, text=True, check=True)
    return listed.stdout.split()


def without_code(markdown):
    return re.sub(r"^ *```.*?^ *```$|`[^`\n]*`", "", markdown, flags=re.MULTILINE | re.DOTALL)


def anchors(markdown):
    """Those that GitHub gives to headings."""
    headings = re.findall(r"^#+ (.*)$", re.sub(r"^ *```.*?^ *```$", "", markdown, flags=re.MULTILINE | re.DOTALL), re.MULTILINE)
    return {re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-") for heading in headings}


class FrontPage(CliTestCase):
    def test_it_is_short(self):
        self.assertLessEqual(len(README.split()), 900)

    def test_the_designs_have_the_verdicts_that_are_shown(self):
        tone, loop = blocks(README, "toml")
        (shown,) = blocks(README)
        self.write(tone, "motor.toml")
        self.write(loop, "loop.toml")
        self.assertEqual(self.run_here("check", "motor.toml").stdout, shown.removeprefix("$ veritrack check motor.toml\n"))
        self.assertEqual(self.run_here("check", "--strict", "loop.toml").returncode, 0)

    def test_make_certificate_certifies_the_design_that_is_named(self):
        design = re.search(r"^DESIGN +\?= (\S+)", (ROOT / "Makefile").read_text(), re.MULTILINE).group(1)
        self.assertIn(f"({design})", README)

    def test_the_citation_has_the_version_of_the_project(self):
        version = re.search(r"project\(veritrack VERSION (\S+)", (ROOT / "CMakeLists.txt").read_text()).group(1)
        citation = yaml.safe_load((ROOT / "CITATION.cff").read_text())
        self.assertEqual(citation["version"], version)
        self.assertTrue({"cff-version", "message", "title", "authors"} <= set(citation))
        self.assertIn(f"version = {{{version}}}", PAPERS)


class Documents(CliTestCase):
    def test_what_is_quoted_of_theorem_2_9_is_from_a_certificate(self):
        design = re.search(r"\(\.\./(designs/\S+\.toml)\)", PAPERS).group(1)
        result = self.run_here("certify", "--no-verify", ROOT / design, "--out", "out")
        self.assertEqual(result.returncode, 0, result.stderr)
        document = (self.folder / "out/published-theorems.md").read_text() + (self.folder / "out/certificate.md").read_text()
        quoted = re.findall(r"^> (- .*)$", PAPERS, re.MULTILINE)
        self.assertEqual(len(quoted), 2)
        for line in quoted:
            self.assertIn(line, document)

    def test_every_command_that_is_named_exists_and_every_command_is_named(self):
        named = set(re.findall(r"veritrack ([a-z]+)\b", README + COMMANDS))
        listed = self.run_here("--help").stdout.split("Subcommands:\n")[1].split("\n\n")[0]
        commands = set(re.findall(r"^  (\w+)", listed, re.MULTILINE))
        self.assertGreaterEqual(len(commands), 13)
        self.assertEqual(named - commands, set())
        self.assertEqual(commands - named, {"completions"})

    def test_the_embedding_example_compiles_and_tracks(self):
        source = (ROOT / "docs/example/track.cpp").read_text()
        (shown,) = blocks((ROOT / "docs/own-program.md").read_text(), "cpp")
        self.assertIn(shown.strip(), source)
        program = self.folder / "track"
        eigen = subprocess.run(["pkg-config", "--cflags", "eigen3"], capture_output=True, text=True, check=True).stdout
        subprocess.run(["g++", "-std=c++20", "-O1", "-Wall", "-Wextra", "-Werror", f"-I{ROOT}", *eigen.split(),
                        ROOT / "docs/example/track.cpp", "-o", program], check=True)
        printed = subprocess.run([program], capture_output=True, text=True, check=True).stdout
        self.assertEqual(printed, "0.5000 rad/sample\n")

    def test_every_link_leads_to_a_file_and_a_heading(self):
        pages = [path for path in tracked("*.md") if not path.startswith("tests/")]
        links = 0
        for page in pages:
            text = (ROOT / page).read_text()
            for file, anchor in re.findall(r"\]\(([^)#:\s]*)#?([^)\s:]*)\)", without_code(text)):
                links += 1
                target = (ROOT / page).parent / file if file else ROOT / page
                self.assertTrue(target.exists(), f"{page}: {file}")
                if anchor:
                    self.assertIn(anchor, anchors(target.read_text()), f"{page}: {file}#{anchor}")
        self.assertGreaterEqual(links, 100)

    def test_every_page_is_reached_from_the_front_page(self):
        reached, waiting = set(), [ROOT / "README.md"]
        while waiting:
            page = waiting.pop().resolve()
            if page.suffix != ".md" or page in reached or not page.exists():
                continue
            reached.add(page)
            waiting += [page.parent / file for file in re.findall(r"\]\(([^)#:\s]+)", without_code(page.read_text()))]
        self.assertEqual([path for path in tracked("docs/*.md", "*.md") if not path.startswith("tests/")
                          and (ROOT / path).resolve() not in reached], [])

    def test_every_folder_with_code_is_in_the_layout(self):
        layout = {folder.rstrip("/") for row in re.findall(r"^\| (`.*?) \|", CONTRIBUTING, re.MULTILINE)
                  for folder in re.findall(r"`([\w/]+/)`", row)}
        for folder in layout:
            self.assertTrue((ROOT / folder).is_dir(), folder)
        for path in map(pathlib.PurePosixPath, tracked("*.cpp", "*.hpp")):
            self.assertTrue(any(str(parent) in layout for parent in path.parents), path)


if __name__ == "__main__":
    unittest.main()
