"""The report of a sweep, as Markdown, HTML and CSV."""

from __future__ import annotations

import collections
import csv
import io
import os
import pathlib
from typing import Mapping, Sequence

from .. import _engine, _toml
from ..certificate import write_file
from .shown import (EXTENTS, WORDS_OF_VERDICTS, ReportFigure, bound_names, figures_of, first_upper, level_of,
                    missing_bounds, pareto_front, report_bound, stopped_early)
from .spec import Axis, Spec
from .store import Row, Store, bound_of

_SHOWN_ERRORS = 5
_SHOWN_DESIGNS = 12


def write_report(spec: Spec, store: Store, folder: str | os.PathLike[str]) -> pathlib.Path:
    """Writes report.md, report.html, results.csv and figures/*.svg; each file appears whole.

    Same specification and results, same bytes: the time that a design took is not in them.

    Parameters
    ----------
    spec : Spec
    store : Store
    folder : path
        Is made where it is not there.

    Returns
    -------
    pathlib.Path
        report.md.
    """
    program = _engine.identity()
    rows = list(store.rows(spec.identity(program)))
    drawn = figures_of(spec, rows)
    text = _markdown(spec, rows, drawn, missing_bounds(spec, store, program))
    target = pathlib.Path(folder)
    for figure in drawn:
        write_file(target / "figures" / figure.file, figure.svg)
    write_file(target / "results.csv", _csv(spec, rows))
    page = _engine.ask({"do": "page", "markdown": text, "file": "report.md",
                        "figures": [{"path": f"figures/{figure.file}", "svg": figure.svg} for figure in drawn]})
    write_file(target / "report.html", page["html"])
    write_file(target / "report.md", text)
    return target / "report.md"


def _csv(spec: Spec, rows: Sequence[Row]) -> str:
    names = list(bound_names(rows))
    out = io.StringIO()
    writer = csv.writer(out)
    writer.writerow(["point", *(key for axis in spec.axes for key in axis.keys), "verdict", "search",
                     *(f"{name} {end}" for name in names for end in ("lo", "hi")), "certificate_sha256", "error"])
    for row in rows:
        bounds = [bound_of(row, name) for name in names]
        ends = [end for bound in bounds for end in (("", "") if bound is None
                                                    else (bound.lower(17), bound.upper(17)))]
        values = [value for axis, value in zip(spec.axes, row.values) for _ in axis.keys]
        search = ("none" if row.result.verdict == "error" else
                  "stopped early" if stopped_early(spec, row) else "complete")
        writer.writerow([row.number, *values, row.result.verdict, search, *ends, row.result.certificate_sha256,
                         row.result.error])
    return out.getvalue()


def _markdown(spec: Spec, rows: Sequence[Row], drawn: Sequence[ReportFigure],
              not_found: Sequence[str]) -> str:
    counts = collections.Counter(row.result.verdict for row in rows)
    missing = spec.size - len(rows)
    lines = [f"# {_headline(spec, rows, counts)}", ""]
    lines += [f"{_md(spec.name)}. Each design has a certificate of its own; `veritrack sweep verify "
              f"{pathlib.Path(spec.file).name}` makes certificates again and has them proved by the independent "
              "checker.", ""]
    lines += [_extent_sentence(spec, rows), ""]
    if missing:
        lines += [f"**{missing} of {spec.size} designs have no result yet.**", ""]
    lines += ["| verdict | designs |", "|---|--:|"]
    lines += [f"| {WORDS_OF_VERDICTS[verdict]} | {counts[verdict]} |" for verdict in WORDS_OF_VERDICTS
              if counts[verdict]]
    lines += [""]
    lines += _level_sentence(spec, rows)
    for sentence in not_found:
        lines += [f"**{_md(first_upper(sentence))}.**", ""]
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


def _extent_sentence(spec: Spec, rows: Sequence[Row]) -> str:
    """The extent of the search, and what that says of the bounds."""
    words = f'Extent "{spec.extent}": {EXTENTS[spec.extent]}.'
    early = sum(stopped_early(spec, row) and bool(row.result.bounds) for row in rows)
    if early:
        words += (f" The bounds of {early} design{'s' if early > 1 else ''} are those at which the search stopped, and "
                  'not the best ones; `extent = "requirements"` looks on.')
    if stopped := sum(row.result.verdict == "error" and row.result.error.startswith("stopped after ") for row in rows):
        words += f" {stopped} design{'s were' if stopped > 1 else ' was'} ended by the time limit."
    return words


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
    name, level = report_bound(spec, rows), level_of(spec)
    if name is None or level is None:
        return []
    found = [(bound, stopped_early(spec, row)) for row in rows if (bound := bound_of(row, name)) is not None]
    if not found:
        return []
    first = found[0][0]
    at_least = first.sense == "at least"
    met = [bound.value >= level if at_least else bound.value <= level for bound, _ in found]
    open_ = sum(early and not is_met for (_, early), is_met in zip(found, met))
    words = first.words or name.replace("_", " ")
    return [f"For {sum(met)} designs this is certified to be {'at least' if at_least else 'at most'} "
            f"{spec.report['level']}: {_md(words)}."
            + (f" The search stopped early for {open_} more, and a full one may find that as well." if open_ else ""),
            ""]


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
                     f"{bound_of(row, asked[1])} | {WORDS_OF_VERDICTS[row.result.verdict]} |")
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
