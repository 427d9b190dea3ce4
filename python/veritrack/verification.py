"""The independent checker, which shares no code with what it checks."""

from __future__ import annotations

import dataclasses
import json
import os
import subprocess
from typing import Iterable

from ._engine import program
from .errors import EngineError, MalformedCertificate, TimeLimit

_MALFORMED = 2


@dataclasses.dataclass(frozen=True)
class Verification:
    """The result of the checker.

    Attributes
    ----------
    verified : bool
        VERIFIED: every claim of the certificate was proved again from its evidence.
    requirements_proved : bool
        VERIFIED, and everything required is PROVED.
    parts : tuple of (str, tuple of str)
        The parts with the objections to each.
    sentences : tuple of (str, str, str)
        Claim, verdict, and the sentence as the checker composes it.
    design_sha256 : str
        The SHA-256 of the design file that the certificate is about.
    """

    verified: bool
    requirements_proved: bool
    parts: tuple[tuple[str, tuple[str, ...]], ...]
    sentences: tuple[tuple[str, str, str], ...]
    design_sha256: str

    @property
    def objections(self) -> tuple[str, ...]:
        """All of them, each with its part."""
        return tuple(f"{part}: {objection}" for part, objections in self.parts for objection in objections)

    def __bool__(self) -> bool:
        return self.verified

    def __repr__(self) -> str:
        return "<VERIFIED>" if self.verified else f"<NOT VERIFIED: {'; '.join(self.objections)}>"


def verify(certificate: str | os.PathLike[str], *, design: str | os.PathLike[str] | None = None,
           documents: Iterable[str | os.PathLike[str]] = (), full: bool = False, budget: int | None = None,
           timeout: float | None = None) -> Verification:
    """Proves a certificate again, from the numbers in it, with another program and another arithmetic.

    Parameters
    ----------
    certificate : path
        certificate.json, or the folder with it.
    design : path, optional
        Also that it is about this design file.
    documents : iterable of path
        Also that certificate.md and published-theorems.md say what was verified.
    full : bool
        Follow all boxes of starts; with more than 200 only a sample is followed otherwise, which is not
        VERIFIED.
    budget : int, optional
        Operations before the checker gives up: NOT VERIFIED.
    timeout : float, optional
        Seconds after which it is stopped.

    Returns
    -------
    Verification

    Raises
    ------
    MalformedCertificate, TimeLimit, EngineError
    """
    path = os.fspath(certificate)
    if os.path.isdir(path):
        path = os.path.join(path, "certificate.json")
    command = [program("veritrack-verify"), "--json"]
    if design is not None:
        command += ["--design", os.fspath(design)]
    for document in documents:
        command += ["--markdown", os.fspath(document)]
    if full:
        command.append("--full")
    if budget is not None:
        command += ["--budget", str(budget)]
    try:
        # A path that begins with a dash is no option.
        done = subprocess.run([*command, os.path.join(".", path)], capture_output=True, text=True,
                              timeout=timeout, check=False)
    except subprocess.TimeoutExpired:
        raise TimeLimit(f"stopped after {timeout:g} s") from None
    if done.returncode == _MALFORMED:
        raise MalformedCertificate(done.stderr.strip())
    if done.returncode not in (0, 1, 3):
        raise EngineError(f"the checker ended with status {done.returncode}: {done.stderr.strip()}")
    found = json.loads(done.stdout)
    return Verification(
        # The exit status and the answer say the same, or nothing is verified.
        found["verified"] and done.returncode != 3,
        found["requirements_proved"] and done.returncode == 0,
        tuple((part["name"], tuple(part["objections"])) for part in found["parts"]),
        tuple((each["claim"], each["verdict"], each["sentence"]) for each in found["sentences"]),
        found["design"]["sha256"])
