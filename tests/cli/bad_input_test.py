"""Bad input: one helpful line, exit status 2, no partial output."""

import re
import resource
import signal
import subprocess
import unittest

from support import DESIGN, ROOT, CliTestCase

DIGITS = "1" * 400

# what is wrong -> (the design file, the line it must be reported at or None, what the message must say)
REJECTED = {
    "unknown key": (DESIGN.replace("q1 =", "q4 ="), 5, r"q4.*nearest known key: .*q[12]"),
    "unknown table": (DESIGN + "[requires]\n", 21, r"require"),
    "wrong type": (DESIGN.replace("r = 0.05", 'r = "0.05"'), 7, r"string"),
    "missing key": (DESIGN.replace("r = 0.05\n", ""), None, r"\br\b"),
    "negative q1": (DESIGN.replace("q1 = 0.0023", "q1 = -1e-9"), 5, r"q1"),
    "zero q2": (DESIGN.replace("q2 = 0.0023", "q2 = 0.0"), 6, r"q2"),
    "q2 that no double tells from zero": (DESIGN.replace("q2 = 0.0023", "q2 = 1e-400"), 6, r"q2"),
    "zero r": (DESIGN.replace("r = 0.05", "r = 0"), 7, r"\br\b"),
    "epsilon of one": (DESIGN.replace("epsilon = 0.0", "epsilon = 1.0"), 8, r"epsilon"),
    "negative epsilon": (DESIGN.replace("epsilon = 0.0", "epsilon = -0.01"), 8, r"epsilon"),
    "not a number": (DESIGN.replace("r = 0.05", "r = nan"), 7, r"nan"),
    "infinity": (DESIGN.replace("r = 0.05", "r = inf"), 7, r"inf"),
    "four hundred digits": (DESIGN.replace("r = 0.05", f"r = 0.0{DIGITS}"), 7, r"digits.*allowed"),
    "number out of range": (DESIGN.replace("r = 0.05", "r = 1e400"), 7, r"range|large"),
    "no table at all": ("name = 'x'\n", None, r"tracker"),
    "empty file": ("", None, r"empty"),
    "syntax error": (DESIGN.replace("[assume]", "[assume"), 10, r"."),
    "invalid UTF-8": (DESIGN.encode().replace(b"a design", b"a \xff design"), 1, r"UTF-8"),
    "unknown tracker": (DESIGN.replace("quadrature-ekf", "quadrature-ukf"), 2, r"quadrature-ekf"),
    "duplicate key": (DESIGN.replace("q2 =", "q1 = 1\nq2 ="), 6, r"."),
}


class BadInput(CliTestCase):
    def reject(self, *arguments, **options):
        """The one line of the message."""
        result = self.run_here(*arguments, **options)
        self.assertEqual(result.returncode, 2, result.stdout + result.stderr)
        self.assertEqual(result.stdout, "")
        lines = result.stderr.splitlines()
        self.assertEqual(len(lines), 1, result.stderr)
        self.assertLess(len(lines[0]), 1000)
        return lines[0]

    def test_designs(self):
        for what, (text, line, message) in REJECTED.items():
            for command in ("certify", "check"):
                with self.subTest(what=what, command=command):
                    self.write(text)
                    found = self.reject(command, "design.toml")
                    self.assertRegex(found, r"^design\.toml:")
                    if line is not None:
                        self.assertRegex(found, rf"^design\.toml:{line}:\d+: ")
                    self.assertRegex(found, message)
                    self.assertEqual(self.files(), [])

    def test_missing_file(self):
        self.assertRegex(self.reject("certify", "nowhere.toml"), r"nowhere\.toml")

    def test_directory(self):
        (self.folder / "folder.toml").mkdir()
        self.assertRegex(self.reject("certify", "folder.toml"), r"folder\.toml.*directory")

    def test_hundred_megabytes(self):
        with open(self.folder / "large.toml", "wb") as file:
            file.truncate(100_000_000)
        self.assertRegex(self.reject("certify", "large.toml"), r"large\.toml.*(bytes|MiB|large)")

    def test_device_that_never_ends(self):
        self.assertRegex(self.reject("certify", "/dev/zero"), r"/dev/zero")

    def test_output_folder_that_is_a_file(self):
        self.write(DESIGN)
        self.write("", "taken")
        self.assertRegex(self.reject("certify", "--no-verify", "design.toml", "--out", "taken"), r"taken")
        self.assertEqual(self.files(), ["taken"])

    def test_output_folder_that_cannot_be_made(self):
        self.write(DESIGN)
        self.assertRegex(self.reject("certify", "--no-verify", "design.toml", "--out", "/proc/veritrack"), r"/proc/veritrack")

    def test_writing_fails_half_way(self):
        self.write(DESIGN)

        def limit():
            signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
            resource.setrlimit(resource.RLIMIT_FSIZE, (20000, 20000))

        self.reject("certify", "--no-verify", "design.toml", "--out", "out", preexec_fn=limit)
        self.assertEqual(self.files(), [])

    def test_full_disk(self):
        self.write(DESIGN)
        disk = self.folder / "disk"
        disk.mkdir()
        mounted = subprocess.run(["mount", "-t", "tmpfs", "-o", "size=16k", "tmpfs", disk], capture_output=True, check=False)
        if mounted.returncode != 0:
            self.skipTest("no right to mount a small disk")
        self.addCleanup(subprocess.run, ["umount", disk], check=True)
        self.assertRegex(self.reject("certify", "--no-verify", "design.toml", "--out", "disk/out"), r"[Nn]o space")
        self.assertEqual(self.files(), [])

    def test_an_old_certificate_survives_a_failure(self):
        self.write(DESIGN)
        self.assertEqual(self.run_here("certify", "--no-verify", "design.toml", "--out", "out").returncode, 0)
        before = {name: (self.folder / name).read_bytes() for name in self.files()}
        self.write(DESIGN.replace("q1 =", "q4 ="))
        self.reject("certify", "--no-verify", "design.toml", "--out", "out")
        self.assertEqual(before, {name: (self.folder / name).read_bytes() for name in self.files()})

    def test_command_line(self):
        for arguments in ((), ("certify",), ("certify", "a", "b"), ("nonsense",), ("certify", "--nonsense")):
            with self.subTest(arguments=arguments):
                self.assertEqual(self.run_here(*arguments).returncode, 2)

    def test_help_and_version(self):
        for option in ("--help", "--version"):
            result = self.run_here(option)
            self.assertEqual(result.returncode, 0)
            self.assertIn("veritrack", result.stdout)

    def test_the_version_is_that_of_the_project_and_names_the_libraries(self):
        project = re.search(r"project\(veritrack VERSION (\S+)", (ROOT / "CMakeLists.txt").read_text()).group(1)
        lines = self.run_here("--version").stdout.splitlines()
        self.assertEqual(lines[0], f"veritrack {project}")
        for library in ("MPFR", "Eigen", "NLopt", "Ipopt", "oneTBB", "toml++", "CLI11"):
            self.assertTrue(any(re.fullmatch(rf"  {re.escape(library)} \d+\.\d+.*", line) for line in lines), library)

    def test_the_help_of_each_command_has_examples_that_begin_with_it(self):
        commands = re.findall(r"^  ([a-z]+) ", self.run_here("--help").stdout.split("Subcommands:")[1], re.MULTILINE)
        self.assertGreaterEqual(len(commands), 9)
        for command in commands:
            text = self.run_here(command, "--help").stdout
            self.assertRegex(text, rf"Examples:\n  (.* \| )?veritrack {command}\b", command)

    def test_a_mistyped_command_is_told_the_nearest(self):
        result = self.run_here("certfy", "design.toml")
        self.assertEqual(result.returncode, 2)
        self.assertIn("nearest command: certify", result.stderr)

    def test_a_mistyped_option_is_told_the_nearest(self):
        for option in ("--objectve", "--objectve=rms"):
            result = self.run_here("tune", "design.toml", option)
            self.assertEqual(result.returncode, 2)
            self.assertIn('veritrack tune: no option is called "--objectve"; nearest option: --objective', result.stderr)


if __name__ == "__main__":
    unittest.main()
