"""The contents of a sweep's report: figures, the bound of the regions, the front."""

from __future__ import annotations

import dataclasses
import difflib
import math
from typing import Any, Sequence

import numpy as np

from ..interval import Bound
from . import figures
from .spec import Axis, Spec
from .store import Row, Store, bound_of

WORDS_OF_VERDICTS = {  # where several designs are at one place of a figure, the first of these is shown
    "proved": "PROVED", "undecided": "UNDECIDED", "refuted": "REFUTED", "nothing-required": "nothing required",
    "error": "no verdict",
}


EXTENTS = {
    "everything": "everything that certificates have was looked for",
    "requirements": "what is required was looked for, and not what takes long beside it",
    "verdicts": "the verdicts alone were looked for: a search stops as soon as it has what is required",
    "quick": "one set that does all that is required was looked for, and no other: what is UNDECIDED here, another "
             "extent may prove",
}
"""In words, as the report names them."""


@dataclasses.dataclass(frozen=True)
class ReportFigure:
    file: str
    title: str
    caption: str
    svg: str


def bound_names(rows: Sequence[Row]) -> dict[str, str]:
    """The bounds that occur, with their words."""
    names: dict[str, str] = {}
    for row in rows:
        for name, found in row.result.bounds.items():
            names.setdefault(name, found[3] or name.replace("_", " "))
    return names


def report_bound(spec: Spec, rows: Sequence[Row]) -> str | None:
    """The bound of the regions: as asked for, or the first that occurs."""
    return spec.report.get("bound") or next(iter(bound_names(rows)), None)


def stopped_early(spec: Spec, row: Row) -> bool:
    """Whether the bounds of a row are those at which a search stopped: a full one may find better ones. What
    `extent = "verdicts"` leaves UNDECIDED it has looked at to the end."""
    return spec.stops_early and (spec.extent == "quick" or row.result.verdict == "proved")


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
    verdicts: dict[tuple[float, ...], str] = {}
    early: dict[tuple[float, ...], bool] = {}
    for row in rows:
        place = tuple(float(row.values[index]) for index in places)
        best.setdefault(place, math.nan)
        early.setdefault(place, False)
        verdicts[place] = min(verdicts.get(place, row.result.verdict), row.result.verdict,
                              key=list(WORDS_OF_VERDICTS).index)
        bound = bound_of(row, name)
        if bound is not None:
            sense, words = bound.sense, bound.words or words
            is_better = bound.value > best[place] if sense == "at least" else bound.value < best[place]
            if math.isnan(best[place]) or is_better:
                best[place], early[place] = bound.value, stopped_early(spec, row)
    table = np.array([[*place, value] for place, value in best.items()])
    return figures.Values(table[:, 0], table[:, min(1, len(plane) - 1)], table[:, -1],
                          np.array(list(verdicts.values())), words, sense != "at least",
                          np.array(list(early.values()), bool))


def level_of(spec: Spec) -> float | None:
    level = spec.report.get("level")
    return None if level is None else float(level)


def figures_of(spec: Spec, rows: Sequence[Row]) -> list[ReportFigure]:
    drawn = []
    name = report_bound(spec, rows)
    plane = _plane(spec)
    if name is not None and plane and rows:
        values = _values(spec, rows, name, plane)
        level = level_of(spec)
        others = " The best of the designs that differ along other axes only is shown." if len(spec.axes) > len(
            plane) else ""
        if len(plane) == 2:
            best = "smallest" if values.is_at_most else "largest"
            caption = (f"{first_upper(values.words)}, as certified for each design: dark where it is {best}, hatched "
                       f"on white or crossed where none is proved.")
            around = ("for which it is "
                      f"{'at most' if values.is_at_most else 'at least'} {spec.report['level']}" if level is not None
                      else "that are PROVED to do all that is required")
            met = figures.is_met(values, level)
            if met.any() and not met.all():
                caption += f" The thick line goes around the designs {around}."
            if values.early.any():
                caption += (" Where cells are hatched and lighter than the scale, or triangles, the search stopped as "
                            "soon as it had what is required: a full one may find a "
                            f"{'smaller' if values.is_at_most else 'larger'} bound.")
            svg = figures.region_figure(values, plane[0], plane[1], level)
        else:
            caption = (f"{first_upper(values.words)}, as certified for each design, with a ring where the design is "
                       "PROVED to do all that is required; a cross where none is proved."
                       + (f" Dashed: {spec.report['level']}." if level is not None else ""))
            if values.early.any():
                caption += (" Where there is a triangle the search stopped as soon as it had what is required: a full "
                            f"one may find a {'smaller' if values.is_at_most else 'larger'} bound.")
            svg = figures.line_figure(values, plane[0], level)
        drawn.append(ReportFigure("regions.svg", "Certified bound over the designs", caption + others, svg))
    front = pareto_front(spec, rows)
    if front.rows:
        drawn.append(ReportFigure(
            "pareto.svg", "Designs by two bounds",
            f"Each dot is a design by two certified bounds. No design is better in both than one of the "
            f"{len(front.front)} that are joined."
            + (" White: the search stopped as soon as it had what is required, and a full one may find better bounds."
               if any(stopped_early(spec, row) for row in front.rows) else ""),
            figures.pareto_figure(front.first, front.second, [row in front.front for row in front.rows],
                                  [stopped_early(spec, row) for row in front.rows], front.words)))
    return drawn


def first_upper(words: str) -> str:
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


def missing_bounds(spec: Spec, store: Store, program: str) -> list[str]:
    """Sentences on the names of bounds that the specification has and no row, most often for a slip of the pen.

    Parameters
    ----------
    spec : Spec
    store : Store
    program : str
        The identity of the program that certified.

    Returns
    -------
    list of str
        None where no design has a verdict yet.
    """
    sweep = spec.identity(program)
    if store.count(sweep) == store.count(sweep, "error"):
        return []
    known = store.bound_names(sweep)
    asked = dict.fromkeys([*spec.record, *([spec.report["bound"]] if "bound" in spec.report else []),
                           *spec.report.get("pareto", [])])
    sentences = []
    for name in asked:
        if name not in known:
            near = difflib.get_close_matches(name, known, 1)
            sentences.append(f"no design has a bound called {name}"
                             + (f"; is it {near[0]}?" if near else "")
                             + ('; some bounds need extent = "everything"' if spec.extent != "everything" else ""))
    return sentences
