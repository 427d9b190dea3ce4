"""veritrack tie --emulator: a program for a Cortex-M4F, built by the compiler for it and run by QEMU."""
import shutil
import unittest

from support import ROOT, run

DESIGN = ROOT / "designs" / "code" / "motor-pll.toml"
BOARD = ROOT / "tests" / "cli" / "board"
COMPILER = "arm-none-eabi-gcc"
QEMU = "qemu-system-arm"
EMULATOR = f"{QEMU} -M mps2-an386 -nographic -semihosting-config enable=on,target=native -kernel"
FOR_BOARD = (f"{COMPILER} -mcpu=cortex-m4 -mthumb -mfpu=fpv4-sp-d16 -mfloat-abi=hard --specs=rdimon.specs -nostartfiles "
             f"-T {BOARD / 'mps2.ld'} {BOARD / 'start.c'}")


@unittest.skipUnless(shutil.which(COMPILER) and shutil.which(QEMU), f"{COMPILER} or {QEMU} is not installed")
class TieBoard(unittest.TestCase):
    def test_unfused_builds_are_equal_with_the_results_of_newlib(self):
        builds = [f"{FOR_BOARD} {flags} -ffp-contract=off" for flags in ("-O0", "-O2", "-Os")]
        result = run("tie", DESIGN, "--emulator", EMULATOR, *(word for each in builds for word in ("--build", each)))
        self.assertEqual((result.returncode, result.stderr), (0, ""), result.stdout)
        self.assertTrue(result.stdout.startswith("EQUAL: 4000 states, 3 builds: each bit of pll.phase, pll.speed and"))

    def test_a_processor_without_numbers_is_equal(self):
        build = (f"{COMPILER} -mcpu=cortex-m3 -mthumb -O2 --specs=rdimon.specs -nostartfiles -T {BOARD / 'mps2.ld'} "
                 f"{BOARD / 'start.c'}")
        result = run("tie", DESIGN, "--emulator", EMULATOR.replace("an386", "an385"), "--build", build)
        self.assertEqual((result.returncode, result.stderr), (0, ""), result.stdout)

    def test_a_fused_build_differs(self):
        result = run("tie", DESIGN, "--emulator", EMULATOR, "--build", f"{FOR_BOARD} -O2")  # gcc's default
        self.assertEqual(result.returncode, 1, result.stdout + result.stderr)
        self.assertIn("of 4000 states differ", result.stdout)

    def test_without_the_emulator_the_program_is_not_run(self):
        result = run("tie", DESIGN, "--build", f"{FOR_BOARD} -O2")
        self.assertEqual((result.returncode, result.stdout), (2, ""))
        self.assertIn("is for another processor; allowed: --emulator", result.stderr)


if __name__ == "__main__":
    unittest.main()
