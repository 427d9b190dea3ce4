"""A sweep in one call."""

from __future__ import annotations

import contextlib
import dataclasses
import os
import pathlib
from typing import Any, Callable, Iterator, Mapping

import numpy as np

from .. import _engine
from ..design import Design
from .reading import read_spec, spec_of
from .recheck import Recheck, recheck
from .spec import Spec
from .store import Row, Store, bound_of


@dataclasses.dataclass(frozen=True)
class Swept:
    """The results of a sweep, in their folder.

    Attributes
    ----------
    spec : Spec
    folder : pathlib.Path
        With results.sqlite and, unless it was left out, report.md, report.html, results.csv and figures/.
    counts : dict of str to int
        How many designs have which verdict; "error" for those without one.
    certified : int
        How many designs this call certified; the others were there already.
    """

    spec: Spec
    folder: pathlib.Path
    counts: dict[str, int]
    certified: int

    @property
    def is_complete(self) -> bool:
        """Whether every design has a verdict."""
        return sum(self.counts.values()) - self.counts.get("error", 0) == self.spec.size

    def rows(self) -> Iterator[Row]:
        """The rows, by the number of their point, one after the other."""
        with contextlib.closing(Store(self.folder / "results.sqlite")) as store:
            yield from store.rows(self.spec.identity(_engine.identity()))

    def columns(self) -> dict[str, np.ndarray]:
        """All rows as columns.

        Returns
        -------
        dict of str to ndarray
            "point"; a column for each key of an axis; "verdict"; and one for each bound, with the end on the safe
            side (Bound.value) as a double, NaN where nothing is proved. Values of an axis are doubles if all are
            numbers, and words as they stand in the designs otherwise.
        """
        rows = list(self.rows())
        columns: dict[str, np.ndarray] = {"point": np.array([row.number for row in rows])}
        for index, axis in enumerate(self.spec.axes):
            column = _column([row.values[index] for row in rows])
            columns.update({key: column for key in axis.keys})
        columns["verdict"] = np.array([row.result.verdict for row in rows])
        for name in dict.fromkeys(name for row in rows for name in row.result.bounds):
            bounds = [bound_of(row, name) for row in rows]
            columns[name] = np.array([np.nan if bound is None else bound.value for bound in bounds])
        return columns

    def verify(self, *, sample: int | None = None, seed: int = 1, jobs: int | None = None) -> Recheck:
        """Has the checker prove certificates of rows that are made again; see recheck.

        Parameters
        ----------
        sample : int, optional
            So many rows, drawn with `seed`; all when it is left out.
        seed : int
        jobs : int, optional
            Rows at a time; default: one for each core.

        Returns
        -------
        Recheck
        """
        with contextlib.closing(Store(self.folder / "results.sqlite")) as store:
            return recheck(self.spec, store, sample=sample, seed=seed, jobs=jobs)

    def __repr__(self) -> str:
        words = ", ".join(f"{count} {verdict}" for verdict, count in self.counts.items())
        return f"<Sweep {self.spec.name!r}: {words or 'nothing yet'}, of {self.spec.size}>"


def _column(values: list[str]) -> np.ndarray:
    try:
        return np.array([float(value) for value in values])
    except ValueError:
        return np.array(values)


def sweep(spec: Spec | Design | str | os.PathLike[str], axes: Mapping[str | tuple[str, ...], Any] | None = None, *,
          folder: str | os.PathLike[str] | None = None, jobs: int = 0, scheduler: str = "",
          timeout: float | None = None, again: bool = False, patience: float = 300.0, report: bool = True,
          progress: Callable[[int, int, float], None] | None = None, **settings: Any) -> Swept:
    """Certifies the designs of a sweep that have no result yet, and reports; `veritrack.sweep(...)` is the same.

    In a script, call it below `if __name__ == "__main__":`, as all that starts processes by spawning.

    Parameters
    ----------
    spec : path or Spec, or Design
        A specification (docs/sweeps.md); or, with `axes`, the base design.
    axes : mapping, optional
        From a key such as "design.q1", or a tuple of keys that go through the same values, to these values.
    folder : path, optional
        The folder of the results; default: sweeps-out/<name of the specification>, or sweeps-out/sweep.
    jobs : int
        Designs at a time; 0: one for each core.
    scheduler : str
        Address of a Dask scheduler instead of workers on this machine.
    timeout : float, optional
        Seconds after which a design is stopped.
    again : bool
        Try again what was stopped or failed before for reasons that are not the design's.
    patience : float
        Seconds to wait for a scheduler that has gone away.
    report : bool
        Whether the report is written.
    progress : callable, optional
        Told points with a result, all points, and points a second, now and then.
    **settings
        With `axes`: further keys of a specification, such as `extent`, `record`, `require`, `name`.

    Returns
    -------
    Swept

    Raises
    ------
    InputError, SchedulerLost, StoreError, OtherProgram
    """
    from .report import write_report
    from .run import Options, run_sweep

    if axes is not None:
        if isinstance(spec, Spec):
            raise TypeError("a specification has its axes; allowed: axes beside a base design")
        spec = spec_of(spec, axes, **settings)
    elif settings or isinstance(spec, Design):
        raise TypeError("allowed: a specification, or a base design with axes")
    if not isinstance(spec, Spec):
        spec = read_spec(spec)
    target = pathlib.Path("sweeps-out", pathlib.Path(spec.file).stem) if folder is None else pathlib.Path(folder)
    target.mkdir(parents=True, exist_ok=True)
    with contextlib.closing(Store(target / "results.sqlite")) as store:
        certified = run_sweep(spec, store, Options(jobs, scheduler, timeout, again, patience), progress)
        if report:
            write_report(spec, store, target)
        identity = spec.identity(_engine.identity())
        counts = {verdict: count for verdict in ("proved", "refuted", "undecided", "nothing-required", "error")
                  if (count := store.count(identity, verdict))}
    return Swept(spec, target, counts, certified)
