"""scripts/what-to-read: the list in checker/README.md is what the script computes, and the script finds what it should."""

import importlib.machinery
import importlib.util
import pathlib
import re
import sys
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[1]
sys.dont_write_bytecode = True
LOADER = importlib.machinery.SourceFileLoader("what_to_read", str(ROOT / "scripts/what-to-read"))
what_to_read = importlib.util.module_from_spec(importlib.util.spec_from_loader("what_to_read", LOADER))
LOADER.exec_module(what_to_read)


def including(*headers):
    return "".join(f'#include "checker/{header}"\n' for header in headers) + "#include <vector>\n"


TEXTS = {
    "main.cpp": "#include <arb.h>\n\n" + including("registry.hpp"),
    "registry.hpp": including(),
    "registry.cpp": including("registry.hpp", "trackers.def"),
    "trackers.def": "// Those that are known.\nCHECKER_TRACKER(a)\nCHECKER_TRACKER(b)\n",
    "a/a.hpp": including("numbers.hpp") + "Kind a_tracker();\n",
    "a/a.cpp": including("a/a.hpp", "a/more.hpp"),
    "a/more.hpp": including(),
    "a/much_more.cpp": including("a/more.hpp"),  # no header of its name
    "b/b.hpp": including("numbers.hpp") + "Kind b_tracker();\n",
    "numbers.hpp": including(),
}


def closure(chosen, **changes):
    return sorted(what_to_read.closure({**TEXTS, **changes}, ["main.cpp"], chosen))


class WhatToRead(unittest.TestCase):
    def test_the_list_of_the_readme(self):
        readme = (ROOT / "checker/README.md").read_text()
        texts = what_to_read.texts_of_checker()
        self.assertIn(what_to_read.BEGIN + "".join(what_to_read.written(texts)) + what_to_read.END, readme,
                      "run scripts/what-to-read --update")

    def test_headers_and_their_units(self):
        self.assertEqual(closure({}), sorted(TEXTS))

    def test_what_a_file_chooses(self):
        self.assertEqual(closure({"trackers.def": ["a/a.hpp"]}), sorted(TEXTS.keys() - {"b/b.hpp"}))
        self.assertEqual(closure({"trackers.def": ["b/b.hpp"]}),
                         ["b/b.hpp", "main.cpp", "numbers.hpp", "registry.cpp", "registry.hpp", "trackers.def"])
        self.assertEqual(closure({"a/a.cpp": ["a/a.hpp"]}), sorted(TEXTS.keys() - {"a/more.hpp", "a/much_more.cpp"}))

    def test_a_choice_that_is_not_there(self):
        with self.assertRaisesRegex(ValueError, "trackers.def does not need c/c.hpp"):
            closure({"trackers.def": ["c/c.hpp"]})

    def test_a_unit_of_no_header(self):
        self.assertEqual(what_to_read.unowned(TEXTS), [])
        self.assertEqual(what_to_read.unowned({**TEXTS, "a/lost.cpp": "#include <cmath>\n" + including("a/a.hpp")}),
                         ["a/lost.cpp"])

    def test_a_file_that_nothing_needs(self):
        with self.assertRaisesRegex(ValueError, "nothing that scripts/what-to-read lists needs lost.hpp"):
            list(what_to_read.written({**what_to_read.texts_of_checker(), "lost.hpp": ""}))


class ThreeCommands(unittest.TestCase):
    """Those at the top of the README."""

    commands = re.search(r"```sh\n(.*?)```", (ROOT / "checker/README.md").read_text(), re.DOTALL)[1].splitlines()

    def test_there_are_three(self):
        self.assertEqual([command.split()[0] for command in self.commands],
                         ["apt-get", "cmake", "build/checker/veritrack-verify"])

    def test_the_packages_are_those_of_the_makefile(self):
        makefile = (ROOT / "Makefile").read_text().replace("\\\n", " ")
        packages = re.search(r"^CHECKER_PACKAGES := (.*)$", makefile, re.MULTILINE)[1]
        self.assertEqual(self.commands[0].split()[2:], packages.split())

    def test_the_files_are_there(self):
        for word in self.commands[2].split()[1:]:
            self.assertTrue(word == "--design" or (ROOT / word).is_file(), word)


if __name__ == "__main__":
    unittest.main()
