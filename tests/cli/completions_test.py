"""Completions and the manual page, which say what the help says."""

import re
import shutil
import subprocess
import unittest

from support import ROOT, CliTestCase, run

SHELLS = ("bash", "zsh", "fish")


def options_of(*command):
    return set(re.findall(r"^\s+(?:-\w,)?--([a-z-]+)", run(*command, "--help").stdout, re.MULTILINE))


def commands():
    return re.findall(r"^  ([a-z]+) ", run("--help").stdout.split("Subcommands:")[1], re.MULTILINE)


class Completions(CliTestCase):
    def complete(self, *words):
        """What bash offers for the last word."""
        script = self.write(run("completions", "bash").stdout, "completions.bash")
        ask = (f'source {script}; COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); _veritrack; '
               'printf "%s\\n" "${COMPREPLY[@]}"')
        result = subprocess.run(["bash", "-euc", ask, "bash", "veritrack", *words], capture_output=True, text=True,
                                check=False)
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        return set(result.stdout.split())

    def test_bash_completes_commands_options_and_choices(self):
        self.assertEqual(self.complete(""), set(commands()))
        self.assertEqual(self.complete("ce"), {"certify"})
        self.assertEqual(self.complete("--quiet", "ce"), {"certify"})
        self.assertEqual(self.complete("show", "--language", "p"), {"python"})
        self.assertEqual(self.complete("new", "mo"), {"model"})
        self.assertEqual(self.complete("check", "--j"), {"--jobs", "--json", "--junit"})
        self.assertEqual(self.complete("check", "--strict", "--j"), {"--jobs", "--json", "--junit"})
        self.assertEqual(self.complete("check", "--jobs", "--j"), set())
        self.assertEqual(self.complete("certify", ""), set())  # bash then offers files
        self.assertEqual(self.complete("certify", "--out", ""), set())

    def test_bash_knows_every_option(self):
        for command in commands():
            options = {f"--{option}" for option in options_of(command)}
            self.assertLessEqual(options, self.complete(command, "--"), command)

    def test_every_shell_knows_every_option(self):
        for shell in SHELLS:
            result = run("completions", shell)
            self.assertEqual(result.returncode, 0)
            for command in commands():
                for option in options_of(command):
                    self.assertRegex(result.stdout, rf"(--|-l ){option}\b", f"{shell}: {command}")
            if shutil.which(shell):
                script = self.write(result.stdout, f"completions.{shell}")
                checked = subprocess.run([shell, "-n", script], capture_output=True, text=True, check=False)
                self.assertEqual((checked.returncode, checked.stderr), (0, ""), shell)
        self.assertEqual(run("completions", "tcsh").returncode, 2)

    def check_page(self, text, options):
        plain = text.replace("\\-", "-")
        for option in options:
            self.assertRegex(plain, rf"(?m)^\.B --{option}( |$)")
        if shutil.which("groff"):
            shown = subprocess.run(["groff", "-man", "-Tascii", "-ww", "-z"], input=text, capture_output=True,
                                   text=True, check=True)
            self.assertEqual(shown.stderr, "")

    def test_the_manual_pages_name_every_option_and_are_clean(self):
        page = run("manual").stdout
        self.check_page(page, {option for command in commands() for option in options_of(command)})
        self.assertIn(".B \\-\\-out \\fIVALUE\\fR\n", page)
        self.assertIn(".B \\-\\-coq\n", page)
        for command in commands():
            self.assertIn(f".SS {command}\n.B veritrack {command}\n", page)
        program = ROOT / "checker/main.cpp"
        usage = re.findall(r'^    "  --([a-z]+) ', program.read_text(), re.MULTILINE)
        self.assertGreaterEqual(len(usage), 8)
        self.check_page((ROOT / "checker/veritrack-verify.1").read_text(), usage)


if __name__ == "__main__":
    unittest.main()
