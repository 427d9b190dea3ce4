"""Results of sweeps in an SQLite file: each design once, whoever is killed when."""

from __future__ import annotations

import contextlib
import dataclasses
import json
import os
import sqlite3
from typing import Any, Iterable, Iterator, Sequence

from ..errors import VeritrackError
from ..interval import Bound

_SCHEMA = """
CREATE TABLE IF NOT EXISTS sweeps (
  sweep TEXT PRIMARY KEY, name TEXT NOT NULL, spec TEXT NOT NULL, base TEXT NOT NULL, program TEXT NOT NULL
) WITHOUT ROWID;
CREATE TABLE IF NOT EXISTS results (
  key TEXT PRIMARY KEY, verdict TEXT NOT NULL, bounds TEXT NOT NULL, certificate_sha256 TEXT NOT NULL,
  error TEXT NOT NULL, may_be_tried_again INTEGER NOT NULL, seconds REAL NOT NULL
) WITHOUT ROWID;
CREATE TABLE IF NOT EXISTS points (
  sweep TEXT NOT NULL, point INTEGER NOT NULL, key TEXT NOT NULL, axis_values TEXT NOT NULL,
  PRIMARY KEY (sweep, point)
) WITHOUT ROWID;
"""


class StoreError(VeritrackError):
    """The file of results cannot be used, or cannot be written: a full disk, say. Nothing is half written."""


@dataclasses.dataclass(frozen=True)
class Result:
    """The outcome of a design.

    Attributes
    ----------
    key : str
    verdict : str
        As Certificate.verdict, or "error".
    bounds : dict
        From the name of a bound to its ends as hexadecimal floats, its sense, words, and claim.
    certificate_sha256 : str
    error : str
        Why there is no verdict.
    may_be_tried_again : bool
        The error is not the design's.
    seconds : float
        That it took.
    """

    key: str
    verdict: str
    bounds: dict[str, list[str]]
    certificate_sha256: str = ""
    error: str = ""
    may_be_tried_again: bool = False
    seconds: float = 0.0


@dataclasses.dataclass(frozen=True)
class Row:
    """A point with its result.

    Attributes
    ----------
    number : int
    values : tuple of str
        As they stand in the design.
    result : Result
    """

    number: int
    values: tuple[str, ...]
    result: Result


def bound_of(row: Row, name: str) -> Bound | None:
    """A bound of a row; none where it is not proved."""
    found = row.result.bounds.get(name)
    if found is None:
        return None
    lo, hi, sense, words, claim = found
    return Bound(float.fromhex(lo), float.fromhex(hi), name, sense, words, claim=claim)


class Store:
    """The file. Results are appended a batch at a time; a batch is there as a whole or not at all.

    Parameters
    ----------
    path : path
    most_pages : int
        A limit on the file, in pages of 4 KiB; 0 disables it. Beyond it the file is as if the disk were full.
    """

    def __init__(self, path: str | os.PathLike[str], most_pages: int = 0) -> None:
        self._path = os.fspath(path)
        with self._errors():
            self._file = sqlite3.connect(self._path, timeout=60, isolation_level=None)
            # Every batch is on the disk before the next one is asked for: it took seconds to compute.
            self._file.execute("PRAGMA journal_mode = WAL")
            self._file.execute("PRAGMA synchronous = FULL")
            if most_pages:
                self._file.execute(f"PRAGMA max_page_count = {int(most_pages)}")
            self._file.executescript(_SCHEMA)

    def close(self) -> None:
        self._file.close()

    def begin(self, sweep: str, name: str, spec: str, base: str, program: str) -> None:
        """Notes which sweep this is; again is no harm."""
        with self._transaction():
            self._file.execute("INSERT INTO sweeps VALUES (?, ?, ?, ?, ?) ON CONFLICT (sweep) DO NOTHING",
                               (sweep, name, spec, base, program))

    def add(self, sweep: str, points: Iterable[tuple[int, str, Sequence[Any]]], results: Iterable[Result]) -> int:
        """Adds points (number, key, values) and results. Existing ones stay, unless they are to be tried again.

        Returns
        -------
        int
            How many points are new.
        """
        with self._transaction():
            self._file.executemany(
                "INSERT INTO results VALUES (?, ?, ?, ?, ?, ?, ?) ON CONFLICT (key) DO UPDATE SET "
                "verdict = excluded.verdict, bounds = excluded.bounds, error = excluded.error, "
                "certificate_sha256 = excluded.certificate_sha256, seconds = excluded.seconds, "
                "may_be_tried_again = excluded.may_be_tried_again WHERE results.may_be_tried_again",
                [(each.key, each.verdict, json.dumps(each.bounds), each.certificate_sha256, each.error,
                  each.may_be_tried_again, each.seconds) for each in results])
            added = self._file.executemany(
                "INSERT INTO points VALUES (?, ?, ?, ?) ON CONFLICT (sweep, point) DO NOTHING",
                [(sweep, number, key, json.dumps([str(value) for value in values]))
                 for number, key, values in points])
        return max(added.rowcount, 0)

    def known_points(self, sweep: str, first: int, last: int, again: bool = False) -> set[int]:
        """The numbers from `first` to before `last` that have a result; with `again` those that stand."""
        with self._errors():
            return {number for number, in self._file.execute(
                "SELECT point FROM points JOIN results USING (key) WHERE sweep = ? AND point >= ? AND point < ?"
                + (" AND NOT may_be_tried_again" if again else ""), (sweep, first, last))}

    def known_keys(self, keys: Sequence[str], again: bool = False) -> set[str]:
        """Those that have a result, from whichever sweep."""
        known: set[str] = set()
        with self._errors():
            for first in range(0, len(keys), 500):
                part = keys[first:first + 500]
                known.update(key for key, in self._file.execute(
                    f"SELECT key FROM results WHERE key IN ({','.join('?' * len(part))})"
                    + (" AND NOT may_be_tried_again" if again else ""), part))
        return known

    def count(self, sweep: str, verdict: str | None = None) -> int:
        """Points with a result, or with that verdict."""
        with self._errors():
            return self._file.execute(
                "SELECT COUNT(*) FROM points JOIN results USING (key) WHERE sweep = ?"
                + (" AND verdict = ?" if verdict is not None else ""),
                (sweep,) if verdict is None else (sweep, verdict)).fetchone()[0]

    def seconds(self, sweep: str) -> float:
        """That its results took, one after the other."""
        with self._errors():
            return self._file.execute("SELECT COALESCE(SUM(seconds), 0) FROM points JOIN results USING (key) "
                                      "WHERE sweep = ?", (sweep,)).fetchone()[0]

    def bound_names(self, sweep: str) -> list[str]:
        """The names of all bounds that its results have."""
        with self._errors():
            return [name for name, in self._file.execute(
                "SELECT DISTINCT each.key FROM points JOIN results USING (key), json_each(results.bounds) AS each "
                "WHERE sweep = ?", (sweep,))]

    def numbers_with_verdict(self, sweep: str) -> list[int]:
        """The numbers of the points that have a verdict, in their order."""
        with self._errors():
            return [number for number, in self._file.execute(
                "SELECT point FROM points JOIN results USING (key) WHERE sweep = ? AND verdict != 'error' "
                "ORDER BY point", (sweep,))]

    def rows(self, sweep: str, number: int | None = None) -> Iterator[Row]:
        """All points with their results, by number, one after the other; or the one of that number."""
        with self._errors():
            for point, values, *result in self._file.execute(
                    "SELECT point, axis_values, key, verdict, bounds, certificate_sha256, error, "
                    "may_be_tried_again, seconds FROM points JOIN results USING (key) WHERE sweep = ? "
                    + ("" if number is None else "AND point = ? ") + "ORDER BY point",
                    (sweep,) if number is None else (sweep, number)):
                key, verdict, bounds, sha256, error, again, seconds = result
                yield Row(point, tuple(json.loads(values)),
                          Result(key, verdict, json.loads(bounds), sha256, error, bool(again), seconds))

    @contextlib.contextmanager
    def _errors(self) -> Iterator[None]:
        try:
            yield
        except sqlite3.Error as error:
            raise StoreError(f"{self._path}: {error}") from error

    @contextlib.contextmanager
    def _transaction(self) -> Iterator[None]:
        with self._errors():
            self._file.execute("BEGIN IMMEDIATE")
            try:
                yield
                self._file.execute("COMMIT")
            except BaseException:
                if self._file.in_transaction:
                    self._file.execute("ROLLBACK")
                raise
