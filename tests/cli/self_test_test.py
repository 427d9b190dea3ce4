"""No certificate on a machine whose arithmetic cannot be trusted: exit status 3."""

import os
import subprocess
import unittest

from support import DESIGN, CliTestCase

# What -ffast-math on a link line does to a process: denormal numbers are flushed from the start.
SABOTAGE = """
#include <immintrin.h>
__attribute__((constructor)) static void sabotage(void) { _mm_setcsr(_mm_getcsr() | CONTROL); }
"""

CONTROLS = {"flush-to-zero": "0x8000", "denormals-are-zero": "0x0040", "rounding towards zero": "0x6000"}


# A library that changes the rounding mode of the process while the design is certified, after the self-test.
INTERFERENCE = """
#define _GNU_SOURCE
#include <dlfcn.h>
#include <immintrin.h>
#include <stdlib.h>
#include <unistd.h>
static int design_was_read;
ssize_t read(int file, void *buffer, size_t size) {
  design_was_read = 1;
  return ((ssize_t (*)(int, void *, size_t))dlsym(RTLD_NEXT, "read"))(file, buffer, size);
}
void *_Znwm(size_t size) {  // operator new
  if (design_was_read) _mm_setcsr(_mm_getcsr() & ~0x6000);
  return malloc(size);
}
"""


class SelfTest(CliTestCase):
    def setUp(self):
        super().setUp()
        self.write(DESIGN)
        self.write(SABOTAGE, "sabotage.c")

    def run_sabotaged(self, control, *arguments):
        library = self.folder / "sabotage.so"
        subprocess.run(["gcc", "-shared", "-fPIC", f"-DCONTROL={control}", "-o", library, self.folder / "sabotage.c"],
                       check=True)
        # The address sanitizer, where it is used, must be loaded first.
        environment = {**os.environ, "LD_PRELOAD": str(library), "ASAN_OPTIONS": "verify_asan_link_order=0"}
        return self.run_here(*arguments, env=environment)

    def test_a_broken_machine_is_refused(self):
        for what, control in CONTROLS.items():
            for command in ("certify", "check"):
                with self.subTest(what=what, command=command):
                    result = self.run_sabotaged(control, command, "design.toml")
                    self.assertEqual(result.returncode, 3, result.stderr)
                    self.assertEqual(result.stdout, "")
                    self.assertIn("self-test", result.stderr)
                    self.assertFalse((self.folder / "certificates-out").exists())

    def test_a_mode_that_changes_under_way_is_noticed(self):
        self.write(INTERFERENCE, "interference.c")
        library = self.folder / "interference.so"
        subprocess.run(["gcc", "-shared", "-fPIC", "-o", library, self.folder / "interference.c", "-ldl"], check=True)
        environment = {**os.environ, "LD_PRELOAD": str(library), "ASAN_OPTIONS": "verify_asan_link_order=0"}
        # Without what an undisturbed run has found.
        for command, *options in (("certify", "--no-verify"), ("check", "--no-cache")):
            with self.subTest(command=command):
                result = self.run_here(command, "design.toml", *options, env=environment)
                self.assertEqual((result.returncode, result.stdout), (3, ""), result.stderr)
                self.assertIn("can be trusted", result.stderr)
                self.assertEqual([name for name in self.files() if "certificate" in name], [])

    def test_a_harmless_library_changes_nothing(self):
        self.assertEqual(self.run_sabotaged("0", "check", "design.toml").returncode, 0)


if __name__ == "__main__":
    unittest.main()
