"""certificate.v in two parts: what is the same for all designs of a kind, compiled once, and the design."""

import hashlib
import os
import pathlib
import subprocess
import tempfile
import typing

END_OF_ALL_DESIGNS = "(* Everything above is the same for all designs of the kind. *)\n"


class Outcome(typing.NamedTuple):
    """Of a run of coqc; seconds of the processor."""
    returncode: int
    stdout: str
    stderr: str
    seconds: float
    mebibytes: int


def coqc(folder, name, parts=None):
    """Runs coqc on folder/name.v, which may require what lies in the folder `parts`."""
    command = ["coqc", "-w", "-ambiguous-paths", "-R", ".", ""]
    if parts is not None:
        command += ["-R", str(parts), ""]
    with tempfile.TemporaryFile("w+") as stdout, tempfile.TemporaryFile("w+") as stderr:
        process = subprocess.Popen([*command, f"{name}.v"], cwd=folder, stdout=stdout, stderr=stderr)
        _, status, used = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
        stdout.seek(0)
        stderr.seek(0)
        return Outcome(process.returncode, stdout.read(), stderr.read(), used.ru_utime + used.ru_stime,
                       used.ru_maxrss // 1024)


def split(text):
    """(for all designs, about the design)"""
    for_all, mark, design = text.partition(END_OF_ALL_DESIGNS)
    if not mark:
        raise ValueError("certificate.v does not say where the part for all designs ends")
    return for_all, design


def compile_part(for_all, folder):
    """Compiles the part for all designs in that folder, where it is not there yet, and returns the name with which it is
    required. Raises RuntimeError with what Coq says."""
    folder = pathlib.Path(folder)
    name = "part_" + hashlib.sha256(for_all.encode()).hexdigest()[:16]
    if not (folder / f"{name}.vo").exists():
        folder.mkdir(parents=True, exist_ok=True)
        (folder / f"{name}.v").write_text(for_all)
        outcome = coqc(folder, name)
        if outcome.returncode != 0:
            raise RuntimeError(outcome.stderr)
        print(f"{name}, for all designs of a kind: accepted, {outcome.seconds:.0f} processor seconds, "
              f"{outcome.mebibytes} MiB", flush=True)
    return name


def requiring(name, design):
    """The part about the design as a file of its own."""
    return f"Require Import {name}.\n{design}"
