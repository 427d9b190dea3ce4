"""What a sweep is over: a base design, axes, and what is recorded and reported of each design."""

from __future__ import annotations

import dataclasses
import decimal
import hashlib
import math
import os
import pathlib
import re
import tomllib
import warnings
from typing import Any, Iterator, Mapping, NoReturn, Sequence

import numpy as np

from .. import _toml
from ..design import Design, replaced_text
from ..errors import InputError

_TOP = {"name", "base", "extent", "record", "axis", "samples", "require", "report"}
_AXIS = {"keys", "label", "values", "range", "log_range", "points"}
_SAMPLES = {"count", "method", "seed"}
_REPORT = {"x", "y", "bound", "level", "pareto"}

_DIGITS = 6
"""Significant digits of what is computed for an axis: the decimals that stand in its designs."""


@dataclasses.dataclass(frozen=True)
class Axis:
    """Keys of the design that go through the same values.

    Attributes
    ----------
    keys : tuple of str
        Such as ("design.q1", "design.q2").
    label : str
        For figures.
    values : tuple
        All of them; empty for an axis that is sampled.
    ends : tuple of float
        Of a range.
    is_logarithmic : bool
    """

    keys: tuple[str, ...]
    label: str
    values: tuple[Any, ...] = ()
    ends: tuple[float, float] = (0.0, 0.0)
    is_logarithmic: bool = False

    @property
    def is_sampled(self) -> bool:
        return not self.values

    def at(self, share: float) -> decimal.Decimal:
        """The value at a share of the range, from 0 to 1, as a decimal of six digits."""
        low, high = self.ends
        if self.is_logarithmic:
            value = math.exp(math.log(low) + share * (math.log(high) - math.log(low)))
        else:
            value = low + share * (high - low)
        return decimal.Context(prec=_DIGITS).create_decimal(decimal.Decimal(value)).normalize()


@dataclasses.dataclass(frozen=True)
class Point:
    """One design of a sweep: its number, the values along the axes, and its text."""

    number: int
    values: tuple[Any, ...]
    text: str


@dataclasses.dataclass(frozen=True)
class Spec:
    """A sweep, read. Points are numbered from 0, and made when they are needed."""

    name: str
    file: str
    text: str
    base: Design
    base_values: Mapping[str, Any]
    axes: tuple[Axis, ...]
    count: int
    method: str
    seed: int
    extent: str
    record: tuple[str, ...]
    report: Mapping[str, Any]

    @property
    def size(self) -> int:
        """How many points there are."""
        return math.prod(len(axis.values) for axis in self.axes if not axis.is_sampled) * self.count

    def identity(self, program: str) -> str:
        """The SHA-256 of all that decides its results."""
        parts = "\n".join([program, self.extent, self.text, self.base.text])
        return hashlib.sha256(parts.encode()).hexdigest()

    def key(self, text: str, program: str) -> str:
        """The SHA-256 by which the result of a design is known: of its text, the extent, and the program."""
        return hashlib.sha256("\n".join([program, self.extent, text]).encode()).hexdigest()

    def points(self, first: int, last: int) -> Iterator[Point]:
        """The points from number `first` to before `last`."""
        grid = [axis for axis in self.axes if not axis.is_sampled]
        each_sample = self.size // self.count
        drawn: dict[int, Sequence[float]] = {}
        for number in range(first, last):
            sample, rest = divmod(number, each_sample)
            if sample not in drawn:
                drawn = self._drawn(sample, min(self.count, sample + 1 + (last - number) // each_sample))
            taken: dict[int, Any] = {}
            for axis in reversed(grid):
                rest, index = divmod(rest, len(axis.values))
                taken[id(axis)] = axis.values[index]
            shares = iter(drawn[sample])
            values = tuple(axis.at(next(shares)) if axis.is_sampled else taken[id(axis)] for axis in self.axes)
            changes = {key: value for axis, value in zip(self.axes, values) for key in axis.keys}
            yield Point(number, values, replaced_text(self.base_values, changes))

    def _drawn(self, first: int, last: int) -> dict[int, Sequence[float]]:
        """Shares from 0 to 1 of the sampled axes, for samples from `first` to before `last`."""
        dimensions = sum(axis.is_sampled for axis in self.axes)
        if dimensions == 0:
            return {sample: () for sample in range(first, last)}
        if self.method == "sobol":
            from scipy.stats import qmc

            with warnings.catch_warnings():  # any number of points is taken here, not only powers of two
                warnings.simplefilter("ignore", UserWarning)
                sequence = qmc.Sobol(dimensions, scramble=True, seed=self.seed)
                if first:
                    sequence.fast_forward(first)
                return dict(zip(range(first, last), sequence.random(last - first).tolist()))
        # A counter for each sample: any of them can be made without those before it.
        return {sample: np.random.Generator(np.random.Philox(key=self.seed, counter=sample << 64))
                .random(dimensions).tolist() for sample in range(first, last)}


class _Reader:
    """Values of a specification, and messages that name its lines."""

    def __init__(self, text: str, file: str) -> None:
        self.text = text
        self.file = file

    def fail(self, message: str, key: str = "", table: str = "", number: int = 0) -> NoReturn:
        """Throws InputError at a key of a table, the `number`-th of that name."""
        raise InputError(self.file, *self._place(key, table, number), message)

    def _place(self, key: str, table: str, number: int) -> tuple[int, int]:
        current, times, heading = "", -1, (0, 0)
        for line_number, line in enumerate(self.text.splitlines(), 1):
            header = re.match(r"\s*\[+\s*([^\]]+?)\s*\]+", line)
            if header:
                current = header[1]
                times += current == table
                if current == table and times == number:
                    heading = (line_number, line.index("[") + 1)
            elif current == table and (not table or times == number):
                found = re.match(rf"\s*\"?({re.escape(key)})\"?\s*=", line)
                if key and found:
                    return line_number, found.start(1) + 1
        return heading

    def known(self, table: Mapping[str, Any], names: set[str], where: str = "", number: int = 0) -> None:
        for key in table:
            if key not in names:
                self.fail(f"unknown key {key}; allowed: {', '.join(sorted(names))}", key, where, number)


def read_spec(path: str | os.PathLike[str]) -> Spec:
    """The specification of a file (docs/sweeps.md). Raises InputError, with the line where it has one."""
    file = os.fspath(path)
    try:
        text = pathlib.Path(path).read_text("utf-8")
    except (OSError, UnicodeDecodeError) as error:
        raise InputError(file, 0, 0, f"cannot be read: {getattr(error, 'strerror', error)}; allowed: a readable "
                         "specification of a sweep") from None
    return spec_from_toml(text, file)


def spec_from_toml(text: str, file: str = "sweep.toml") -> Spec:
    """The specification of a TOML text. The base design is found from the folder of `file`."""
    try:
        document = _toml.parse(text)
    except tomllib.TOMLDecodeError as error:
        place = re.search(r"\(at line (\d+), column (\d+)\)", str(error))
        line, column = (int(place[1]), int(place[2])) if place else (0, 0)
        raise InputError(file, line, column, re.sub(r" \(at .*\)", "", str(error))) from None
    reader = _Reader(text, file)
    reader.known(document, _TOP)
    for key in ("name", "base"):
        if not isinstance(document.get(key), str):
            reader.fail(f"{key} is missing or no string; allowed: a string", key)
    base = Design.from_file(pathlib.Path(file).parent / document["base"])
    values = base.values
    if "require" in document:
        values["require"] = document["require"]
    axes = _axes(reader, document)
    count, method, seed = _samples(reader, document, axes)
    extent = document.get("extent", "requirements")
    if extent not in ("requirements", "everything", "verdicts", "quick"):
        reader.fail(f'extent {extent!r}; allowed: "requirements", "everything", "verdicts" or "quick"', "extent")
    record = document.get("record", [])
    if not isinstance(record, list) or not all(isinstance(name, str) for name in record):
        reader.fail("record; allowed: a list of names of bounds", "record")
    report = document.get("report", {})
    reader.known(report, _REPORT, "report")
    keys = [key for axis in axes for key in axis.keys]
    for name in ("x", "y"):
        if name in report and report[name] not in keys:
            reader.fail(f"{name} = {report[name]!r}; allowed: a key of an axis: {', '.join(keys)}", name, "report")
    spec = Spec(document["name"], file, text, base, values, axes, count, method, seed, extent, tuple(record),
                report)
    if spec.size < 1:
        reader.fail("no point; allowed: axes with at least one value each", "", "axis")
    # What is wrong with all designs is better known before the first is certified.
    Design.from_toml(next(spec.points(0, 1)).text, base.file)
    return spec


def _axes(reader: _Reader, document: Mapping[str, Any]) -> tuple[Axis, ...]:
    tables = document.get("axis", [])
    if not isinstance(tables, list) or not tables:
        reader.fail("no axis; allowed: one or more tables [[axis]]")
    axes = tuple(_axis(reader, table, number) for number, table in enumerate(tables))
    seen: set[str] = set()
    for number, axis in enumerate(axes):
        for key in axis.keys:
            if key in seen:
                reader.fail(f"{key} is in two axes, or twice in one; allowed: once", "keys", "axis", number)
            seen.add(key)
    return axes


def _axis(reader: _Reader, table: Mapping[str, Any], number: int) -> Axis:
    reader.known(table, _AXIS, "axis", number)
    keys = table.get("keys")
    if not isinstance(keys, list) or not keys or not all(isinstance(key, str) and "." in key for key in keys):
        reader.fail('keys; allowed: a list of keys such as "design.q1"', "keys", "axis", number)
    label = table.get("label", " = ".join(key.split(".")[-1] for key in keys))
    ways = [way for way in ("values", "range", "log_range") if way in table]
    if len(ways) != 1:
        reader.fail("an axis needs one of: values, range, log_range", "", "axis", number)
    way = ways[0]
    given = table[way]
    if way == "values":
        if not isinstance(given, list) or not given or "points" in table:
            reader.fail("values; allowed: a list of one or more values, without points", "values", "axis", number)
        return Axis(tuple(keys), label, tuple(given))
    if (not isinstance(given, list) or len(given) != 2
            or not all(isinstance(end, (int, decimal.Decimal)) for end in given)
            or not given[0] < given[1] or (way == "log_range" and given[0] <= 0)):
        reader.fail(f"{way}; allowed: [lowest, highest], two numbers"
                    + (" above 0" if way == "log_range" else ""), way, "axis", number)
    axis = Axis(tuple(keys), label, (), (float(given[0]), float(given[1])), way == "log_range")
    points = table.get("points")
    if points is None:
        return axis
    if not isinstance(points, int) or not 2 <= points <= 10**5:
        reader.fail("points; allowed: a whole number from 2 to 100000", "points", "axis", number)
    values = tuple(axis.at(k / (points - 1)) for k in range(points))
    return dataclasses.replace(axis, values=values)


def _samples(reader: _Reader, document: Mapping[str, Any], axes: Sequence[Axis]) -> tuple[int, str, int]:
    table = document.get("samples", {})
    reader.known(table, _SAMPLES, "samples")
    is_sampled = any(axis.is_sampled for axis in axes)
    if is_sampled != ("samples" in document):
        reader.fail("an axis without points, and a table [samples] with their count, go together", "", "samples")
    count, method, seed = table.get("count", 1), table.get("method", "sobol"), table.get("seed", 1)
    if not isinstance(count, int) or count < 1:
        reader.fail("count; allowed: a whole number, 1 or more", "count", "samples")
    if method not in ("sobol", "random"):
        reader.fail(f'method {method!r}; allowed: "sobol" or "random"', "method", "samples")
    if not isinstance(seed, int) or seed < 0:
        reader.fail("seed; allowed: a whole number, 0 or more", "seed", "samples")
    return count, method, seed
