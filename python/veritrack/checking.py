"""The verdicts of many designs."""

from __future__ import annotations

import concurrent.futures
import dataclasses
import os
from typing import Iterable

from . import _engine
from .certificate import EXTENTS, Claim, bounds_of, claims_of
from .design import Design, as_design
from .errors import VeritrackError
from .interval import Bound


@dataclasses.dataclass(frozen=True)
class Checked:
    """The outcome of a design.

    Attributes
    ----------
    design : Design or path
        As it was given.
    verdict : str
        The verdict on everything required: "proved", "refuted", "undecided", or "nothing-required"; "error" where
        there is an error.
    claims : tuple of Claim
    bounds : dict of str to Bound
        The proved bounds, as far as they decide [require].
    certificate_sha256 : str
        The SHA-256 of the certificate.json that has it.
    error : Exception, optional
        Why there are no verdicts: a file that is not a valid design, a time limit, a process that failed.
    """

    design: Design | str | os.PathLike[str]
    verdict: str
    claims: tuple[Claim, ...] = ()
    bounds: dict[str, Bound] = dataclasses.field(default_factory=dict)
    certificate_sha256: str = ""
    error: Exception | None = None


def _check_one(design: Design | str | os.PathLike[str], extent: str, timeout: float | None, threads: int,
               crew: _engine.Crew) -> Checked:
    try:
        read = as_design(design)
        answer = _engine.ask({"do": "check", "text": read.text, "file": read.file, "extent": extent,
                              "threads": threads}, timeout, crew)
    except (VeritrackError, OSError) as error:
        return Checked(design, "error", error=error)
    claims = claims_of(answer)
    return Checked(design, answer["verdict"], claims, bounds_of(claims), answer["certificate_sha256"])


def check(designs: Iterable[Design | str | os.PathLike[str]], *, extent: str = "requirements",
          jobs: int | None = None, timeout: float | None = None) -> list[Checked]:
    """The verdicts of designs, in their order.

    A design that cannot be used or whose process fails does not harm the others: its result has the error.
    Ctrl-C ends all of the work at once.

    Parameters
    ----------
    designs : iterable of Design or path
    extent : {"requirements", "verdicts", "quick", "everything"}
        As for `certify`. "verdicts" is what the command `veritrack check` asks for: the same verdicts, sooner, with
        bounds no better than they need.
    jobs : int, optional
        Designs at a time, each in a process of its own; default: one for each core.
    timeout : float, optional
        Seconds after which a design is stopped.

    Returns
    -------
    list of Checked
    """
    if extent not in EXTENTS:
        raise ValueError(f"extent {extent!r}; allowed: {', '.join(map(repr, EXTENTS))}")
    cores = len(os.sched_getaffinity(0))
    at_once = cores if jobs is None else jobs
    if at_once < 1:
        raise ValueError(f"jobs {jobs}; allowed: 1 or more")
    threads = max(1, cores // at_once)
    crew = _engine.Crew()
    workers = concurrent.futures.ThreadPoolExecutor(at_once)
    try:
        return list(workers.map(lambda design: _check_one(design, extent, timeout, threads, crew), designs))
    except BaseException:
        workers.shutdown(wait=False, cancel_futures=True)
        crew.stop()
        raise
    finally:
        workers.shutdown()
