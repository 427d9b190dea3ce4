"""docs/ci.md: the files that users copy are what they should be, and their commands run."""

import os
import re
import shlex
import subprocess
import unittest

import yaml
from support import DESIGN, PROGRAM, ROOT, CliTestCase

TEXT = (ROOT / "docs/ci.md").read_text()
FILES = {heading: yaml.safe_load(block)
         for heading, block in re.findall(r"^## (\w[\w-]*)\n```yaml\n(.*?)^```", TEXT, re.MULTILINE | re.DOTALL)}
REQUIRED = DESIGN + "\n[require]\nfrequency_error_below = 0.05\n"


class CiDocumentation(CliTestCase):
    def run_command(self, command, *more):
        (self.folder / "designs").mkdir(exist_ok=True)
        self.write(REQUIRED, "designs/fine.toml")
        words = shlex.split(command)
        self.assertEqual(words[0], "veritrack")
        return subprocess.run([PROGRAM, *words[1:], *more], cwd=self.folder, capture_output=True, text=True, check=False,
                              timeout=300)

    def test_there_are_three(self):
        self.assertEqual(sorted(FILES), ["GitHub", "GitLab", "pre-commit"])

    def test_github(self):
        steps = FILES["GitHub"]["jobs"]["check"]["steps"]
        command = next(step["run"] for step in steps if "run" in step)
        self.assertEqual(self.run_command(command).returncode, 0)
        upload = next(step for step in steps if step.get("uses", "").startswith("github/codeql-action/upload-sarif@"))
        self.assertTrue((self.folder / upload["with"]["sarif_file"]).exists())
        # Without this a failed check is not shown.
        self.assertEqual(upload["if"], "always()")

    def test_gitlab(self):
        job = FILES["GitLab"]["designs"]
        (command,) = job["script"]
        self.assertEqual(self.run_command(command).returncode, 0)
        self.assertTrue((self.folder / job["artifacts"]["reports"]["junit"]).exists())
        self.assertEqual(job["artifacts"]["when"], "always")

    def test_pre_commit(self):
        (hook,) = FILES["pre-commit"]["repos"][0]["hooks"]
        self.assertTrue(re.search(hook["files"], "designs/fine.toml"))
        self.assertFalse(re.search(hook["files"], "docs/fine.toml"))
        self.assertEqual(self.run_command(hook["entry"], "designs/fine.toml").returncode, 0)

    def test_a_requirement_that_fails_fails_each(self):
        for command in (FILES["GitHub"]["jobs"]["check"]["steps"][1]["run"], FILES["GitLab"]["designs"]["script"][0]):
            result = self.run_command(command)
            self.write(REQUIRED.replace("= 0.05\n", "= 0.001\n"), "designs/hard.toml")
            words = shlex.split(command)
            result = subprocess.run([PROGRAM, *words[1:]], cwd=self.folder, capture_output=True, text=True, check=False,
                                    timeout=300)
            self.assertEqual(result.returncode, 1, result.stderr)

    def test_the_commands_of_the_first_block(self):
        block = re.search(r"^```sh\n(.*?)^```", TEXT, re.MULTILINE | re.DOTALL).group(1)
        commands = [re.sub(r"#.*", "", line) for line in block.replace("\\\n", " ").splitlines()]
        self.assertEqual(len(commands), 2)
        for command in commands:
            self.assertEqual(self.run_command(command).returncode, 0, command)
        self.assertLessEqual({"check.json", "check.xml", "check.sarif"}, {os.path.basename(name) for name in self.files()})


if __name__ == "__main__":
    unittest.main()
