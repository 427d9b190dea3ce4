"""Where results go: what may be replaced, what is written as it is, and what is refused."""

import json
import os
import pathlib
import shutil
import signal
import stat
import subprocess
import threading
import time
import unittest
import xml.etree.ElementTree

from support import DESIGN, PROGRAM, CliTestCase


class Output(CliTestCase):
    def setUp(self):
        super().setUp()
        self.write(DESIGN)

    def test_a_device_stays_a_device(self):
        for device in ("/dev/full", "/dev/null"):
            for option in ("--junit", "--sarif"):
                with self.subTest(device=device, option=option):
                    result = self.run_here("check", "design.toml", option, device)
                    self.assertTrue(stat.S_ISCHR(os.stat(device).st_mode))
                    self.assertEqual(result.returncode, 2 if device == "/dev/full" else 0, result.stderr)

    def test_a_fifo_is_read_by_whoever_waits(self):
        fifo = self.folder / "fifo"
        os.mkfifo(fifo)
        read = []
        reader = threading.Thread(target=lambda: read.append(fifo.read_text()))
        reader.start()
        result = self.run_here("check", "design.toml", "--junit", "fifo")
        reader.join()
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertTrue(stat.S_ISFIFO(os.stat(fifo).st_mode))
        self.assertEqual(xml.etree.ElementTree.fromstring(read[0]).tag, "testsuites")

    def test_a_link_stays_a_link(self):
        (self.folder / "link").symlink_to("real.sarif")
        self.assertEqual(self.run_here("check", "design.toml", "--sarif", "link").returncode, 0)
        self.assertTrue((self.folder / "link").is_symlink())
        self.assertEqual(json.loads((self.folder / "real.sarif").read_text())["version"], "2.1.0")

    def test_standard_output_may_be_the_report(self):
        for redirected in (False, True):
            with self.subTest(redirected=redirected):
                with open(self.folder / "out", "w+") as file:
                    options = {"stdout": file} if redirected else {"stdout": subprocess.PIPE}
                    result = subprocess.run([PROGRAM, "check", "design.toml", "--junit", "/dev/stdout"], cwd=self.folder,
                                            stderr=subprocess.PIPE, text=True, check=False, timeout=300, **options)
                    file.seek(0)
                    text = file.read() if redirected else result.stdout
                self.assertEqual(result.returncode, 0, result.stderr)
                self.assertTrue(text.startswith("design.toml: nothing required\n<?xml"), text)
                self.assertTrue(text.endswith("</testsuites>\n"), text)

    def test_an_output_that_is_an_input_is_refused(self):
        self.write(DESIGN, "other.toml")
        (self.folder / "link").symlink_to("design.toml")
        for output in ("design.toml", "./design.toml", "link", "other.toml"):
            for option in ("--junit", "--sarif"):
                with self.subTest(output=output, option=option):
                    result = self.run_here("check", "design.toml", "other.toml", option, output)
                    self.assertEqual(result.returncode, 2)
                    self.assertIn("input", result.stderr)
                    self.assertEqual((self.folder / "design.toml").read_text(), DESIGN)
                    self.assertEqual((self.folder / "other.toml").read_text(), DESIGN)
        shutil.copy(self.folder / "design.toml", self.folder / "certificate.json")
        self.assertEqual(self.run_here("certify", "--no-verify", "certificate.json", "--out", ".").returncode, 2)
        self.assertEqual((self.folder / "certificate.json").read_text(), DESIGN)

    def test_two_reports_need_two_files(self):
        result = self.run_here("check", "design.toml", "--junit", "a", "--sarif", "./a")
        self.assertEqual(result.returncode, 2)
        self.assertTrue(result.stderr.startswith("./a: cannot be written: "), result.stderr)
        # The first one says it, and no design was checked.
        self.assertEqual(self.files(), ["a"])
        (suite,) = xml.etree.ElementTree.parse(self.folder / "a").getroot()
        self.assertEqual((suite.get("name"), suite.get("errors")), ("./a", "1"))

    def test_standard_output_that_cannot_be_written(self):
        for arguments in (("check", "design.toml"), ("certify", "--no-verify", "design.toml"), ("--help",), ("--version",)):
            with self.subTest(arguments=arguments):
                with open("/dev/full", "w") as full:
                    result = subprocess.run([PROGRAM, *arguments], cwd=self.folder, stdout=full, stderr=subprocess.PIPE,
                                            text=True, check=False, timeout=300)
                self.assertEqual(result.returncode, 2)
                self.assertEqual(result.stderr, "standard output cannot be written: No space left on device\n")

    def test_standard_output_that_is_closed(self):
        closed = subprocess.run(["sh", "-c", '"$0" check design.toml --junit report.xml >&-', PROGRAM], cwd=self.folder,
                                stderr=subprocess.PIPE, text=True, check=False, timeout=300)
        self.assertEqual(closed.returncode, 2, closed.stderr)
        self.assertEqual(xml.etree.ElementTree.parse(self.folder / "report.xml").getroot().tag, "testsuites")

    def test_a_reader_that_goes_away(self):
        pipe_reader, pipe_writer = os.pipe()
        os.close(pipe_reader)
        with os.fdopen(pipe_writer, "wb") as writer:
            result = subprocess.run([PROGRAM, "check", "design.toml"], cwd=self.folder, stdout=writer,
                                    stderr=subprocess.PIPE, text=True, check=False, timeout=300)
        self.assertEqual(result.returncode, 2)
        self.assertIn("Broken pipe", result.stderr)

    def test_a_killed_run_is_tidied_by_the_next(self):
        fifo = self.folder / "fifo"
        os.mkfifo(fifo)  # nobody reads it, so that the run stops half-way through its outputs
        with subprocess.Popen([PROGRAM, "check", "design.toml", "--junit", "report.xml", "--sarif", "fifo"],
                              cwd=self.folder) as run:
            deadline = time.monotonic() + 100
            while not (self.folder / "report.xml").exists() and time.monotonic() < deadline:
                time.sleep(0.01)
            run.send_signal(signal.SIGKILL)
        first = (self.folder / "report.xml").stat().st_ino
        with subprocess.Popen([PROGRAM, "check", "design.toml", "--junit", "report.xml", "--sarif", "fifo"],
                              cwd=self.folder) as run:
            while (self.folder / "report.xml").stat().st_ino == first and time.monotonic() < deadline:
                time.sleep(0.01)
            # The second report stands in the place of the first, which is still beside it under a name of its own.
            run.send_signal(signal.SIGKILL)
        self.assertEqual(len([name for name in self.files() if name.startswith(".report.xml.")]), 1)
        self.assertEqual(self.run_here("check", "design.toml", "--junit", "report.xml").returncode, 0)
        self.assertEqual(self.files(), ["report.xml"])

    def test_designs_of_one_name_do_not_share_a_folder(self):
        for folder in ("a", "b"):
            (self.folder / folder).mkdir()
            self.write(DESIGN, f"{folder}/x.toml")
        self.assertEqual(self.run_here("certify", "--no-verify", "a/x.toml").returncode, 0)
        document = (self.folder / "certificates-out/x/certificate.md").read_bytes()
        refused = self.run_here("certify", "--no-verify", "b/x.toml")
        self.assertEqual((refused.returncode, refused.stdout), (2, ""))
        self.assertIn("a/x.toml", refused.stderr)
        self.assertIn("--out", refused.stderr)
        self.assertEqual((self.folder / "certificates-out/x/certificate.md").read_bytes(), document)
        self.assertEqual(self.run_here("certify", "--no-verify", "b/x.toml", "--out", "elsewhere").returncode, 0)
        self.assertEqual(self.run_here("certify", "--no-verify", "./a/../a/x.toml").returncode, 0, "the same design again")
        (self.folder / "a/x.toml").unlink()
        self.assertEqual(self.run_here("certify", "--no-verify", "b/x.toml").returncode, 0, "the other one exists no more")

    def test_without_gnuplot_all_but_the_figures_is_written(self):
        self.write(DESIGN + "\n[require]\nfrequency_error_below = 0.001\n", "hard.toml")
        (self.folder / "empty").mkdir()
        for design, status in (("design.toml", 0), ("hard.toml", 1)):
            with self.subTest(design=design):
                result = self.run_here("certify", "--no-verify", design, "--out", "out", env={**os.environ, "PATH": "empty"})
                self.assertEqual(result.returncode, status, result.stderr)
                self.assertRegex(result.stderr, r"^out/certificate\.md: written without its figures; .*gnuplot.*\n(hard\.toml: veritrack tune .*\n)?$")
                written = [pathlib.Path(name).name for name in self.files() if name.startswith("out/")]
                self.assertIn("certificate.json", written)
                self.assertFalse([name for name in written if name.endswith(".svg")])
                self.assertNotIn("(figures/", (self.folder / "out/certificate.md").read_text())

    def test_the_wrong_tracker_is_bad_input(self):
        result = self.run_here("show", "design.toml")
        self.assertEqual((result.returncode, result.stdout), (2, ""))
        self.assertRegex(result.stderr, r"^design\.toml:2:\d+: .*allowed: model\n$")

    def test_a_wrong_command_names_the_nearest(self):
        for wrong, right in (("certfy", "certify"), ("chekc", "check"), ("tuen", "tune"), ("reproduction", "reproduce")):
            with self.subTest(wrong=wrong):
                result = self.run_here(wrong, "design.toml")
                self.assertEqual((result.returncode, result.stdout), (2, ""))
                self.assertIn(f"nearest command: {right};", result.stderr)


if __name__ == "__main__":
    unittest.main()
