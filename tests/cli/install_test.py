"""What `cmake --install` installs: the programs run, and others can build on the library."""

import os
import pathlib
import subprocess
import unittest

from support import PROGRAM, ROOT, CliTestCase

BUILD = pathlib.Path(PROGRAM).parent


def quietly(*command, **options):
    result = subprocess.run([*map(str, command)], capture_output=True, text=True, check=False, **options)
    assert result.returncode == 0, result.stdout + result.stderr
    return result.stdout


class Install(CliTestCase):
    def setUp(self):
        super().setUp()
        self.prefix = self.folder / "prefix"
        quietly("cmake", "--install", BUILD, "--prefix", self.prefix)

    def consumer(self, name, *definitions):
        build = self.folder / name
        quietly("cmake", "-S", ROOT / "tests/consumer", "-B", build, f"-DCMAKE_PREFIX_PATH={self.prefix}",
                f"-DTRACK_SOURCE={ROOT / 'docs/example/track.cpp'}", *definitions)
        quietly("cmake", "--build", build)
        return build

    def test_programs_and_documents_are_there(self):
        for program in ("veritrack", "veritrack-verify"):
            self.assertIn(program, quietly(self.prefix / "bin" / program, "--version"))
        for name in ("share/man/man1/veritrack.1", "share/man/man1/veritrack-verify.1", "share/doc/veritrack/README.md",
                     "share/doc/veritrack/docs/design-file.md", "share/bash-completion/completions/veritrack",
                     "share/zsh/vendor-completions/_veritrack", "share/fish/vendor_completions.d/veritrack.fish"):
            self.assertTrue((self.prefix / name).is_file(), name)
        design = self.prefix / "share/veritrack/designs/la-scala-1994-figure-3.5-without-leak.toml"
        self.assertTrue(design.is_file())
        # Nothing installed knows where it was built.
        for path in self.prefix.rglob("*.cmake"):
            self.assertNotIn(str(ROOT), path.read_text(), path)

    def test_the_trackers_alone_need_eigen_only(self):
        build = self.consumer("trackers", "-DCONSUMER_TRACKERS_ALONE=ON", "-DCMAKE_DISABLE_FIND_PACKAGE_fmt=ON",
                              "-DCMAKE_DISABLE_FIND_PACKAGE_TBB=ON")
        self.assertEqual(quietly(build / "track"), "0.5000 rad/sample\n")

    def test_the_library_certifies(self):
        build = self.consumer("library")
        printed = quietly(build / "certify", ROOT / "certificates/kkl_observer/new.toml", cwd=self.folder,
                          env={**os.environ, "LC_ALL": "C"})
        self.assertEqual(printed, "proved kkl/frequency-error-bound\nproved kkl/settling-time\n")


if __name__ == "__main__":
    unittest.main()
