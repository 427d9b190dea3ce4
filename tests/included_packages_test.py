"""scripts/included-packages: a header that no package of its target brings is found, and a package for nothing."""

import pathlib
import subprocess
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[1]

MAKEFILE = """\
BUILD_PACKAGES := g++ libeigen3-dev \\
  libfmt-dev
TEST_PACKAGES  ?= doctest-dev python3-yaml
BENCH_PACKAGES := $(TEST_PACKAGES) libbenchmark-dev

certificate:
\t@scripts/install-packages $(BUILD_PACKAGES)
\t@cmake

test: programs
\t@scripts/install-packages $(BUILD_PACKAGES) $(TEST_PACKAGES) \\
\t  $(if $(filter nightly,$(PRESET)),mypy)
"""
SOURCES = {
    "analysis/a.hpp": "#include <Eigen/Dense>\n#include <vector>\n",
    "cli/main.cpp": "#include <fmt/format.h>\n#include <unistd.h>\n#include \"analysis/a.hpp\"\n",
    "tests/analysis/a_test.cpp": "#include <doctest/doctest.h>\n",
}


def objections(changes=(), makefile=MAKEFILE):
    with tempfile.TemporaryDirectory() as folder:
        root = pathlib.Path(folder)
        (root / "Makefile").write_text(makefile)
        for name, text in {**SOURCES, **dict(changes)}.items():
            (root / name).parent.mkdir(parents=True, exist_ok=True)
            (root / name).write_text(text)
        done = subprocess.run([ROOT / "scripts/included-packages", root], capture_output=True, text=True, check=False)
        assert done.returncode == bool(done.stderr), done
        return done.stderr.splitlines()


class IncludedPackages(unittest.TestCase):
    def test_the_sources_include_what_the_makefile_installs(self):
        done = subprocess.run([ROOT / "scripts/included-packages"], capture_output=True, text=True, check=False)
        self.assertEqual((0, "", ""), (done.returncode, done.stdout, done.stderr))

    def test_all_is_well(self):
        self.assertEqual([], objections())

    def test_a_header_that_no_package_brings(self):
        source = "#include <boost/math/distributions/binomial.hpp>\n"
        self.assertEqual([f"certificates/b.cpp: make {target} does not install libboost-dev, which brings "
                          "<boost/math/distributions/binomial.hpp>" for target in ("certificate", "test")],
                         objections({"certificates/b.cpp": source}))

    def test_a_header_of_the_tests_in_a_program(self):
        self.assertEqual(["checker/b.cpp: make certificate does not install doctest-dev, which brings <doctest/doctest.h>"],
                         objections({"checker/b.cpp": "#  include  <doctest/doctest.h>\n"}))

    def test_a_header_of_an_unknown_package(self):
        self.assertEqual(["tests/b.cpp: scripts/included-packages knows no package for <zlib.h>"],
                         objections({"tests/b.cpp": "#include <zlib.h>\n"}))

    def test_a_package_for_nothing(self):
        self.assertEqual(["Makefile: make certificate installs libfmt-dev, of which its sources include no header",
                          "Makefile: make test installs libfmt-dev, of which its sources include no header"],
                         objections({"cli/main.cpp": "#include <unistd.h>\n"}))

    def test_an_unknown_target(self):
        self.assertEqual(["Makefile: make other installs packages; scripts/included-packages does not know for which sources"],
                         objections(makefile=MAKEFILE + "\nother:\n\t@scripts/install-packages $(BENCH_PACKAGES)\n"))


if __name__ == "__main__":
    unittest.main()
