"""The report of a sweep: what is certified where, as Markdown, HTML and CSV."""

from __future__ import annotations

import collections
import csv
import dataclasses
import io
import math
import os
import pathlib
from typing import Any, Mapping, Sequence

import numpy as np

from .. import _engine, _toml
from ..certificate import write_file
from ..interval import Bound
from . import figures
from .spec import Axis, Spec
from .store import Row, Store

_WORDS_OF_VERDICTS = {
    "proved": "PROVED", "refuted": "REFUTED", "undecided": "UNDECIDED", "nothing-required": "nothing required",
    "error": "no verdict",
}
_SHOWN_ERRORS = 5
_SHOWN_DESIGNS = 12


@dataclasses.dataclass(frozen=True)
class _Figure:
    file: str
    title: str
    caption: str
    svg: str


def bound_of(row: Row, name: str) -> Bound | None:
    """A bound of a row; none where it is not proved."""
    found = row.result.bounds.get(name)
    if found is None:
        return None
    lo, hi, sense, words, claim = found
    return Bound(float.fromhex(lo), float.fromhex(hi), name, sense, words, claim=claim)


def write_report(spec: Spec, store: Store, folder: str | os.PathLike[str]) -> pathlib.Path:
    """Writes report.md, report.html, results.csv and figures/*.svg; each file appears whole.

    Same specification and results, same bytes: the time that a design took is not in them.

    Returns
    -------
    pathlib.Path
        report.md.
    """
    program = _engine.identity()
    rows = list(store.rows(spec.identity(program)))
    drawn = _figures(spec, rows)
    text = _markdown(spec, rows, drawn)
    target = pathlib.Path(folder)
    for figure in drawn:
        write_file(target / "figures" / figure.file, figure.svg)
    write_file(target / "results.csv", _csv(spec, rows))
    page = _engine.ask({"do": "page", "markdown": text, "file": "report.md",
                        "figures": [{"path": f"figures/{figure.file}", "svg": figure.svg} for figure in drawn]})
    write_file(target / "report.html", page["html"])
    write_file(target / "report.md", text)
    return target / "report.md"


def _names(rows: Sequence[Row]) -> dict[str, str]:
    """The bounds that occur, with their words."""
    names: dict[str, str] = {}
    for row in rows:
        for name, found in row.result.bounds.items():
            names.setdefault(name, found[3] or name.replace("_", " "))
    return names


def _csv(spec: Spec, rows: Sequence[Row]) -> str:
    names = list(_names(rows))
    out = io.StringIO()
    writer = csv.writer(out)
    writer.writerow(["point", *(key for axis in spec.axes for key in axis.keys), "verdict",
                     *(f"{name} {end}" for name in names for end in ("lo", "hi")), "certificate_sha256", "error"])
    for row in rows:
        bounds = [bound_of(row, name) for name in names]
        ends = [end for bound in bounds for end in (("", "") if bound is None
                                                    else (bound.lower(17), bound.upper(17)))]
        values = [value for axis, value in zip(spec.axes, row.values) for _ in axis.keys]
        writer.writerow([row.number, *values, row.result.verdict, *ends, row.result.certificate_sha256,
                         row.result.error])
    return out.getvalue()


# ---- what is shown


def _report_bound(spec: Spec, rows: Sequence[Row]) -> str | None:
    """The bound of the regions: as asked for, or the first that occurs."""
    return spec.report.get("bound") or next(iter(_names(rows)), None)


def _number_axes(spec: Spec) -> list[Axis]:
    def is_number(value: Any) -> bool:
        try:
            return math.isfinite(float(value))
        except (TypeError, ValueError):
            return False

    return [axis for axis in spec.axes if axis.is_sampled or all(map(is_number, axis.values))]


def _plane(spec: Spec) -> list[Axis]:
    """One or two axes of figures: those that are asked for, or the first ones."""
    numbers = _number_axes(spec)
    asked = [axis for name in ("x", "y") for axis in numbers if spec.report.get(name) in axis.keys]
    return (asked + [axis for axis in numbers if axis not in asked])[:2]


def _values(spec: Spec, rows: Sequence[Row], name: str, plane: Sequence[Axis]) -> figures.Values:
    """The bound in the plane; where further axes leave several designs at a place, the best of them."""
    places = [spec.axes.index(axis) for axis in plane]
    sense, words = "at most", name.replace("_", " ")
    best: dict[tuple[float, ...], float] = {}
    for row in rows:
        place = tuple(float(row.values[index]) for index in places)
        best.setdefault(place, math.nan)
        bound = bound_of(row, name)
        if bound is not None:
            sense, words = bound.sense, bound.words or words
            is_better = bound.value > best[place] if sense == "at least" else bound.value < best[place]
            if math.isnan(best[place]) or is_better:
                best[place] = bound.value
    table = np.array([[*place, value] for place, value in best.items()])
    return figures.Values(table[:, 0], table[:, min(1, len(plane) - 1)], table[:, -1], words, sense != "at least")


def _level(spec: Spec) -> float | None:
    level = spec.report.get("level")
    return None if level is None else float(level)


def _figures(spec: Spec, rows: Sequence[Row]) -> list[_Figure]:
    drawn = []
    name = _report_bound(spec, rows)
    plane = _plane(spec)
    if name is not None and plane and rows:
        values = _values(spec, rows, name, plane)
        level = _level(spec)
        others = " Of designs that differ along other axes only, the best one is shown." if len(spec.axes) > len(
            plane) else ""
        if len(plane) == 2:
            best = "smallest" if values.is_at_most else "largest"
            caption = (f"{_first_upper(values.words)}, as certified for each design: dark where it is {best}, hatched or crossed where "
                       f"nothing is proved.")
            if level is not None:
                caption += (f" The thick line goes around the designs for which it is "
                            f"{'at most' if values.is_at_most else 'at least'} {spec.report['level']}.")
            svg = figures.region_figure(values, plane[0], plane[1], level)
        else:
            caption = (f"{_first_upper(values.words)}, as certified for each design; a cross where nothing is proved."
                       + (f" Dashed: {spec.report['level']}." if level is not None else ""))
            svg = figures.line_figure(values, plane[0], level)
        drawn.append(_Figure("regions.svg", "Certified bound over the designs", caption + others, svg))
    front = pareto_front(spec, rows)
    if front.rows:
        drawn.append(_Figure(
            "pareto.svg", "Designs by two bounds",
            f"Each dot is a design by two certified bounds. No design is better in both than one of the "
            f"{len(front.front)} that are joined.",
            figures.pareto_figure(front.first, front.second, [row in front.front for row in front.rows],
                                  front.words)))
    return drawn


def _first_upper(words: str) -> str:
    return words[:1].upper() + words[1:]


@dataclasses.dataclass(frozen=True)
class Front:
    """Designs with both bounds of [report] pareto, and those of them that none beats in both."""

    rows: list[Row]
    first: list[float]
    second: list[float]
    front: list[Row]
    words: tuple[str, str]


def pareto_front(spec: Spec, rows: Sequence[Row]) -> Front:
    """The designs that no other design beats in both bounds that [report] names."""
    asked = spec.report.get("pareto")
    if not asked:
        return Front([], [], [], [], ("", ""))
    found: list[tuple[Row, Bound, Bound]] = []
    for row in rows:
        first, second = bound_of(row, asked[0]), bound_of(row, asked[1])
        if first is not None and second is not None:
            found.append((row, first, second))
    words = (found[0][1].words or asked[0], found[0][2].words or asked[1]) if found else ("", "")

    def cost(bound: Bound) -> float:
        return -bound.value if bound.sense == "at least" else bound.value

    costs = sorted((cost(a), cost(b), row.number) for row, a, b in found)
    best, on_front = math.inf, set()
    for _, least, number in costs:  # by the first bound, so only a better second one counts
        if least < best:
            best = least
            on_front.add(number)
    return Front([row for row, _, _ in found], [a.value for _, a, _ in found], [b.value for _, _, b in found],
                 [row for row, _, _ in found if row.number in on_front], words)


# ---- the document


def _markdown(spec: Spec, rows: Sequence[Row], drawn: Sequence[_Figure]) -> str:
    counts = collections.Counter(row.result.verdict for row in rows)
    missing = spec.size - len(rows)
    lines = [f"# {_headline(spec, rows, counts)}", ""]
    lines += [f"{_md(spec.name)}. Each design has a certificate of its own; `veritrack sweep verify "
              f"{pathlib.Path(spec.file).name}` makes certificates again and has them proved by the independent "
              "checker.", ""]
    if missing:
        lines += [f"**{missing} of {spec.size} designs have no result yet.**", ""]
    lines += ["| verdict | designs |", "|---|--:|"]
    lines += [f"| {_WORDS_OF_VERDICTS[verdict]} | {counts[verdict]} |" for verdict in _WORDS_OF_VERDICTS
              if counts[verdict]]
    lines += [""]
    lines += _level_sentence(spec, rows)
    for figure in drawn:
        lines += [f"![{figure.title}](figures/{figure.file})", "", f"*{_md(figure.caption)}*", ""]
    lines += _front_table(spec, rows)
    lines += _errors(rows)
    lines += ["## What was certified", "", f"The base design is {_md(spec.base.name)}. Along the axes:", ""]
    lines += ["| keys | values |", "|---|---|"]
    lines += [f"| {', '.join(f'`{key}`' for key in axis.keys)} | {_axis_words(axis, spec)} |" for axis in spec.axes]
    lines += ["", "The design at the first point:", "", "```toml", next(spec.points(0, 1)).text.rstrip(), "```", "",
              "`results.csv` has all designs; its numbers are rounded outward. The certificate of a design names "
              "every hypothesis: the numbers here rest on the same ones.", ""]
    return "\n".join(lines)


def _headline(spec: Spec, rows: Sequence[Row], counts: Mapping[str, int]) -> str:
    if counts["nothing-required"]:
        return f"{len(rows)} designs certified; nothing is required of them"
    return f"{counts['proved']} of {spec.size} designs are PROVED to do all that is required"


def _md(text: str) -> str:
    """Text in which nothing is mark-up."""
    return "".join("\\" + c if c in "\\`*_[]<>|#$" else c for c in " ".join(text.split()))


def _axis_words(axis: Axis, spec: Spec) -> str:
    if axis.is_sampled:
        kind = "Sobol points" if spec.method == "sobol" else "random points"
        scale = ", logarithmic" if axis.is_logarithmic else ""
        return f"{spec.count} {kind} from {axis.ends[0]:g} to {axis.ends[1]:g}{scale}"
    if len(axis.values) > 8:
        scale = ", logarithmic" if axis.is_logarithmic else ""
        return f"{len(axis.values)} values from {_md(str(axis.values[0]))} to {_md(str(axis.values[-1]))}{scale}"
    return ", ".join(_md(_toml.value_text(value)) for value in axis.values)


def _level_sentence(spec: Spec, rows: Sequence[Row]) -> list[str]:
    name, level = _report_bound(spec, rows), _level(spec)
    if name is None or level is None:
        return []
    bounds = [bound for row in rows if (bound := bound_of(row, name)) is not None]
    if not bounds:
        return []
    at_least = bounds[0].sense == "at least"
    met = sum(bound.value >= level if at_least else bound.value <= level for bound in bounds)
    words = bounds[0].words or name.replace("_", " ")
    return [f"For {met} designs this is certified to be {'at least' if at_least else 'at most'} "
            f"{spec.report['level']}: {_md(words)}.", ""]


def _front_table(spec: Spec, rows: Sequence[Row]) -> list[str]:
    front = pareto_front(spec, rows)
    if not front.front:
        return []
    asked = spec.report["pareto"]
    order = sorted(front.front, key=lambda row: (bound_of(row, asked[0]).value, row.number))  # type: ignore[union-attr]
    lines = ["## Designs that none beats in both bounds", "",
             "| " + " | ".join(_md(axis.label) for axis in spec.axes) + f" | {_md(front.words[0])} | "
             f"{_md(front.words[1])} | verdict |", "|" + "---|" * (len(spec.axes) + 3)]
    shown = order if len(order) <= _SHOWN_DESIGNS else [order[round(i * (len(order) - 1) / (_SHOWN_DESIGNS - 1))]
                                                        for i in range(_SHOWN_DESIGNS)]
    for row in shown:
        lines.append("| " + " | ".join(map(_md, row.values)) + f" | {bound_of(row, asked[0])} | "
                     f"{bound_of(row, asked[1])} | {_WORDS_OF_VERDICTS[row.result.verdict]} |")
    if len(shown) < len(order):
        lines += ["", f"{len(shown)} of {len(order)} are shown."]
    return lines + [""]


def _errors(rows: Sequence[Row]) -> list[str]:
    failed = [row for row in rows if row.result.verdict == "error"]
    if not failed:
        return []
    lines = ["## Designs without a verdict", ""]
    lines += [f"- point {row.number}: {_md(row.result.error)}" for row in failed[:_SHOWN_ERRORS]]
    if len(failed) > _SHOWN_ERRORS:
        lines.append(f"- and {len(failed) - _SHOWN_ERRORS} more: `results.csv`")
    return lines + [""]
