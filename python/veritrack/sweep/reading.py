"""Specifications of sweeps, read and found to be ones."""

from __future__ import annotations

import dataclasses
import decimal
import math
import os
import pathlib
import re
import tomllib
from typing import Any, Mapping, Sequence

from .. import _toml
from ..certificate import EXTENTS
from ..design import Design, as_design, replaced_text
from ..errors import InputError
from .reader import Reader
from .spec import Axis, Spec

_TOP = {"name", "base", "extent", "record", "axis", "samples", "require", "report"}
_AXIS = {"keys", "label", "values", "range", "log_range", "points"}
_SAMPLES = {"count", "method", "seed"}
_REPORT = {"x", "y", "bound", "level", "pareto"}


def read_spec(path: str | os.PathLike[str]) -> Spec:
    """The specification of a file (docs/sweeps.md).

    Parameters
    ----------
    path : path

    Raises
    ------
    InputError
        With line and column where it has them.
    """
    file = os.fspath(path)
    try:
        text = pathlib.Path(path).read_text("utf-8")
    except (OSError, UnicodeDecodeError) as error:
        raise InputError(file, 0, 0, f"cannot be read: {getattr(error, 'strerror', error)}; allowed: a readable "
                         "specification of a sweep") from None
    return spec_from_toml(text, file)


def spec_of(base: Design | str | os.PathLike[str], axes: Mapping[str | tuple[str, ...], Any], *,
            name: str = "a sweep", **settings: Any) -> Spec:
    """A specification from values instead of a file.

    Parameters
    ----------
    base : Design or path
    axes : mapping
        From a key such as "design.q1", or a tuple of keys that go through the same values, to these values.
    name : str
        One line.
    **settings
        Further keys of a specification: `extent`, `record`, `require`, `report`.

    Raises
    ------
    InputError

    Examples
    --------
    >>> spec = spec_of("base.toml", {("design.q1", "design.q2"): numpy.geomspace(1e-4, 1e-1, 7), "design.r": [0.1, 1]})
    """
    design = as_design(base)
    tables = [{"keys": [keys] if isinstance(keys, str) else list(keys), "values": list(values)}
              for keys, values in axes.items()]
    return spec_from_toml(_toml.dump({"name": name, "base": design.file, "axis": tables, **settings}), "sweep.toml",
                          design)


def spec_from_toml(text: str, file: str = "sweep.toml", base: Design | None = None) -> Spec:
    """The specification of a TOML text.

    Parameters
    ----------
    text : str
    file : str
        Its name in messages; the base design is found from its folder.
    base : Design, optional
        In place of that of the file that `base` names.

    Raises
    ------
    InputError
    """
    try:
        document = _toml.parse(text)
    except tomllib.TOMLDecodeError as error:
        place = re.search(r"\(at line (\d+), column (\d+)\)", str(error))
        line, column = (int(place[1]), int(place[2])) if place else (0, 0)
        raise InputError(file, line, column, re.sub(r" \(at .*\)", "", str(error))) from None
    reader = Reader(text, file)
    reader.known(document, _TOP)
    for key in ("name", "base"):
        if not isinstance(document.get(key), str):
            reader.fail(f"{key} is missing or no string; allowed: a string", key)
    if base is None:
        base = Design.from_file(pathlib.Path(file).parent / document["base"])
    values = base.values
    if "require" in document:
        if not isinstance(document["require"], Mapping):
            reader.fail("require is no table; allowed: a table [require] as in a design", "require")
        values["require"] = document["require"]
    axes = _axes(reader, document)
    _require_tables(reader, axes, values)
    count, method, seed = _samples(reader, document, axes)
    extent = document.get("extent", "requirements")
    if extent not in EXTENTS:
        reader.fail(f"extent {extent!r}; allowed: " + ", ".join(f'"{each}"' for each in EXTENTS), "extent")
    record = document.get("record", [])
    if not _are_strings(record):
        reader.fail("record; allowed: a list of names of bounds", "record")
    report = _report(reader, document, axes, record)
    spec = Spec(document["name"], file, text, base, values, axes, count, method, seed, extent, tuple(record),
                report)
    if spec.size < 1:
        reader.fail("no point; allowed: axes with at least one value each", "", "axis")
    _require_design(reader, spec, document)
    return spec


def _are_strings(value: Any) -> bool:
    return isinstance(value, list) and all(isinstance(each, str) for each in value)


def _is_number(value: Any) -> bool:
    """Whether it is a number that a double has room for."""
    return (isinstance(value, (int, decimal.Decimal)) and not isinstance(value, bool)
            and decimal.Decimal(value).is_finite() and abs(decimal.Decimal(value)) < decimal.Decimal("1e300"))


def _is_whole(value: Any, least: int, most: float = math.inf) -> bool:
    return isinstance(value, int) and not isinstance(value, bool) and least <= value <= most


def _require_tables(reader: Reader, axes: Sequence[Axis], values: Mapping[str, Any]) -> None:
    """Checks that the keys of all axes can coexist in the design."""
    keys = [(key, number) for number, axis in enumerate(axes) for key in axis.keys]
    for key, number in keys:
        inside = next((other for other, _ in keys if key.startswith(f"{other}.")), None)
        if inside is not None:
            reader.fail(f"{key} is a part of {inside}, which has an axis, too; allowed: one of them", "keys", "axis",
                        number)
    for key, number in keys:
        try:
            replaced_text(values, {key: 0})
        except ValueError as error:
            reader.fail(str(error), "keys", "axis", number)


def _report(reader: Reader, document: Mapping[str, Any], axes: Sequence[Axis],
            record: Sequence[str]) -> Mapping[str, Any]:
    report = document.get("report", {})
    reader.known(report, _REPORT, "report")
    keys = [key for axis in axes for key in axis.keys]
    for name in ("x", "y"):
        if name in report and report[name] not in keys:
            reader.fail(f"{name} = {report[name]!r}; allowed: a key of an axis: {', '.join(keys)}", name, "report")
    if "level" in report and not _is_number(report["level"]):
        reader.fail(f"level = {report['level']!r}; allowed: a number", "level", "report")
    if "bound" in report and not isinstance(report["bound"], str):
        reader.fail(f"bound = {report['bound']!r}; allowed: the name of a bound", "bound", "report")
    if "pareto" in report and not (_are_strings(report["pareto"]) and len(set(report["pareto"])) == 2
                                   and len(report["pareto"]) == 2):
        reader.fail("pareto; allowed: the names of two bounds", "pareto", "report")
    for name, asked in (("bound", [report["bound"]] if "bound" in report else []),
                        ("pareto", report.get("pareto", []))):
        for each in asked:
            if record and each not in record:
                reader.fail(f"{name} = {each!r} is not recorded; allowed: {', '.join(record)}", name, "report")
    return report


def _require_design(reader: Reader, spec: Spec, document: Mapping[str, Any]) -> None:
    """Errors that concern all designs are found before the first is certified.

    The design at the first point has lines of its own, which nobody has seen: messages name the specification
    or the file of the base design.
    """
    text = next(spec.points(0, 1)).text
    try:
        Design.from_toml(text, spec.base.file)
    except InputError as error:
        key = _toml.key_at(text, error.line)
        for number, axis in enumerate(spec.axes):
            if any(f"{key}.".startswith(f"{own}.") for own in axis.keys):
                reader.fail(f"the design at the first point: {error.message}", "keys", "axis", number)
        if "require" in document and key.startswith("require"):
            reader.fail(error.message, key.partition(".")[2], "require")
        raise InputError(spec.base.file, *spec.base.positions.get(key, (0, 0)), error.message) from None


def _axes(reader: Reader, document: Mapping[str, Any]) -> tuple[Axis, ...]:
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


def _axis(reader: Reader, table: Mapping[str, Any], number: int) -> Axis:
    reader.known(table, _AXIS, "axis", number)
    keys = table.get("keys")
    if not isinstance(keys, list) or not keys or not all(isinstance(key, str) and "." in key for key in keys):
        reader.fail('keys; allowed: a list of keys such as "design.q1"', "keys", "axis", number)
    label = table.get("label", " = ".join(key.split(".")[-1] for key in keys))
    if not isinstance(label, str):
        reader.fail("label; allowed: a string", "label", "axis", number)
    ways = [way for way in ("values", "range", "log_range") if way in table]
    if len(ways) != 1:
        reader.fail("an axis needs one of: values, range, log_range", "", "axis", number)
    way = ways[0]
    given = table[way]
    if way == "values":
        if not isinstance(given, list) or not given or "points" in table:
            reader.fail("values; allowed: a list of one or more values, without points", "values", "axis", number)
        for value in given:
            try:
                _toml.value_text(value)
            except (TypeError, ValueError) as error:
                reader.fail(f"values: {error}", "values", "axis", number)
        return Axis(tuple(keys), label, tuple(given))
    if (not isinstance(given, list) or len(given) != 2
            or not all(map(_is_number, given)) or not given[0] < given[1] or (way == "log_range" and given[0] <= 0)):
        reader.fail(f"{way}; allowed: [lowest, highest], two numbers"
                    + (" above 0" if way == "log_range" else ""), way, "axis", number)
    axis = Axis(tuple(keys), label, (), (float(given[0]), float(given[1])), way == "log_range")
    points = table.get("points")
    if points is None:
        return axis
    if not _is_whole(points, 2, 10**5):
        reader.fail("points; allowed: a whole number from 2 to 100000", "points", "axis", number)
    values = tuple(axis.at(k / (points - 1)) for k in range(points))
    return dataclasses.replace(axis, values=values)


def _samples(reader: Reader, document: Mapping[str, Any], axes: Sequence[Axis]) -> tuple[int, str, int]:
    table = document.get("samples", {})
    reader.known(table, _SAMPLES, "samples")
    is_sampled = any(axis.is_sampled for axis in axes)
    if is_sampled != ("samples" in document):
        reader.fail("an axis without points, and a table [samples] with their count, go together", "", "samples")
    count, method, seed = table.get("count", 1), table.get("method", "sobol"), table.get("seed", 1)
    if not _is_whole(count, 1):
        reader.fail("count; allowed: a whole number, 1 or more", "count", "samples")
    if method not in ("sobol", "random"):
        reader.fail(f'method {method!r}; allowed: "sobol" or "random"', "method", "samples")
    if not _is_whole(seed, 0):
        reader.fail("seed; allowed: a whole number, 0 or more", "seed", "samples")
    return count, method, seed
