"""Rows of a sweep, checked again by the independent checker."""

from __future__ import annotations

import concurrent.futures
import dataclasses
import itertools
import os
import pathlib
import random
import tempfile
from typing import Callable

from .. import _engine
from ..errors import VeritrackError
from ..verification import verify
from .spec import Spec
from .store import Row, Store
from .work import recorded_bounds


@dataclasses.dataclass(frozen=True)
class Recheck:
    """The outcome of checking rows.

    Attributes
    ----------
    rows : int
        That were checked.
    objections : tuple of (int, str)
        The numbers of the points that are not as the store says, and why.
    """

    rows: int
    objections: tuple[tuple[int, str], ...]

    @property
    def verified(self) -> bool:
        """Every row that was looked at is verified, and there was one."""
        return self.rows > 0 and not self.objections


def recheck(spec: Spec, store: Store, *, sample: int | None = None, seed: int = 1, jobs: int | None = None,
            progress: Callable[[int, int], None] | None = None) -> Recheck:
    """Makes the certificates of rows again, and has the checker prove each from its evidence.

    A row is verified when its design, made again from the specification, has a certificate of the recorded
    SHA-256 that the checker verifies and that has the recorded verdict and bounds. Rows with an error say
    nothing and are left out.

    Parameters
    ----------
    spec : Spec
    store : Store
    sample : int, optional
        So many rows, drawn with `seed`; all when it is left out.
    seed : int
    jobs : int, optional
        Rows at a time; default: one for each core.
    progress : callable, optional
        Told rows that are done, and all rows.

    Returns
    -------
    Recheck
    """
    program = _engine.identity()
    sweep = spec.identity(program)
    numbers = store.numbers_with_verdict(sweep)  # and not the rows: there may be millions
    if sample is not None and sample < len(numbers):
        numbers = sorted(random.Random(seed).sample(numbers, sample))
    cores = len(os.sched_getaffinity(0))
    crew = _engine.Crew()
    workers = concurrent.futures.ThreadPoolExecutor(jobs or cores)
    objections = []
    try:
        left = iter(numbers)
        waiting: dict[concurrent.futures.Future[str], int] = {}
        done = 0
        while True:
            for number in itertools.islice(left, 2 * (jobs or cores) - len(waiting)):
                row, = store.rows(sweep, number)
                waiting[workers.submit(_objection, spec, program, row, crew)] = number
            if not waiting:
                break
            for future in concurrent.futures.wait(waiting, return_when="FIRST_COMPLETED").done:
                number = waiting.pop(future)
                if objection := future.result():
                    objections.append((number, objection))
                done += 1
                if progress is not None:
                    progress(done, len(numbers))
    except BaseException:
        workers.shutdown(wait=False, cancel_futures=True)
        crew.stop()
        raise
    finally:
        workers.shutdown()
    return Recheck(len(numbers), tuple(sorted(objections)))


def _objection(spec: Spec, program: str, row: Row, crew: _engine.Crew) -> str:
    """Why the row is not verified; empty when it is."""
    point = next(spec.points(row.number, row.number + 1))
    result = row.result
    if spec.key(point.text, program) != result.key:
        return "the row is of another design"
    if tuple(map(str, point.values)) != row.values:
        return "the row has other values along the axes than its design"
    try:
        answer = _engine.ask({"do": "certify", "text": point.text, "file": spec.base.file, "extent": spec.extent,
                              "figures": False, "threads": 1}, crew=crew)
    except VeritrackError as error:
        return f"no certificate could be made: {error}"
    if answer["certificate_sha256"] != result.certificate_sha256:
        return "the certificate is another one"
    if answer["verdict"] != result.verdict:
        return f"the verdict is {answer['verdict']}, not {result.verdict}"
    if recorded_bounds(answer, spec.record) != result.bounds:
        return "the bounds are others"
    return _checker_objection(answer, point.text, result.verdict)


def _checker_objection(answer, text: str, verdict: str) -> str:
    with tempfile.TemporaryDirectory() as folder:
        certificate = pathlib.Path(folder, "certificate.json")
        certificate.write_text(answer["files"]["certificate.json"])
        document = pathlib.Path(folder, "certificate.md")
        document.write_text(answer["files"]["certificate.md"])
        design = pathlib.Path(folder, "design.toml")
        design.write_text(text)
        try:
            found = verify(certificate, design=design, documents=[document])
        except VeritrackError as error:
            return f"the checker: {error}"
    if not found.verified:
        return "NOT VERIFIED: " + "; ".join(found.objections)
    if (verdict == "proved") != found.requirements_proved:
        return "the checker finds something else of what is required"
    return ""
