"""Figures of sweeps: to be read in grey, the same bytes from the same results."""

from __future__ import annotations

import dataclasses
import io
from typing import Sequence

import matplotlib
import matplotlib.figure
import matplotlib.patches
import matplotlib.ticker
import numpy as np

from .spec import Axis

_STYLE = {
    "svg.hashsalt": "veritrack", "svg.fonttype": "path", "font.size": 10, "axes.spines.top": False,
    "axes.spines.right": False, "axes.edgecolor": "0.4", "font.family": "DejaVu Sans",
}

_LEAST_COLOUR, _MOST_COLOUR, _COLOURS = 0.25, 0.95, 48
"""Fewer than 50 colours, of which Matplotlib draws the scale as lines and not as a picture, which pages drop."""


@dataclasses.dataclass(frozen=True)
class Values:
    """The data of a figure for each point: its place, a bound, NaN where none is proved, the verdict, and whether
    the bound is one at which a search stopped early, and not the best that it finds."""

    x: np.ndarray
    y: np.ndarray
    bound: np.ndarray
    verdict: np.ndarray
    words: str
    is_at_most: bool
    early: np.ndarray


def _svg(figure: matplotlib.figure.Figure) -> str:
    out = io.StringIO()
    figure.savefig(out, format="svg", metadata={"Date": None, "Creator": None})
    return "".join(line.rstrip() + "\n" for line in out.getvalue().splitlines())


def _decorate(axes, x: Axis, y: Axis) -> None:
    axes.set_xlabel(x.label)
    axes.set_ylabel(y.label)
    for axis, scale in ((x, axes.set_xscale), (y, axes.set_yscale)):
        if axis.is_logarithmic:
            scale("log")


def _edges(centres: np.ndarray, is_logarithmic: bool) -> np.ndarray:
    """The borders of the cells around the values of an axis."""
    values = np.log(centres) if is_logarithmic else centres
    middles = (values[1:] + values[:-1]) / 2
    edges = np.concatenate([[2 * values[0] - middles[0]], middles, [2 * values[-1] - middles[-1]]])
    return np.exp(edges) if is_logarithmic else edges


def is_met(values: Values, level: float | None) -> np.ndarray:
    """Inside the thick line: the bound meets the level; without a level, the design is PROVED."""
    if level is None:
        return values.verdict == "proved"
    # Where nothing is proved the bound is beyond every level.
    return values.bound <= level if values.is_at_most else values.bound >= level


_WITHOUT_BOUND = {
    "undecided": ("UNDECIDED", "////"), "refuted": ("REFUTED", "xxxx"), "error": ("no verdict", ".."),
}
"""Verdicts of cells that show no bound, in words, with their hatching. All other verdicts are left white."""

_EARLY_WORDS = "search stopped early, lighter than the scale: a full one may find better"
_EARLY_HATCH = "\\\\\\\\"


def _lighter(colours) -> matplotlib.colors.ListedColormap:
    """The same order, nowhere dark: what may not be the best bound does not look like it."""
    return matplotlib.colors.ListedColormap([str(0.5 + float(shade) / 2) for shade in colours.colors])


def region_figure(values: Values, x: Axis, y: Axis, level: float | None) -> str:
    """The bound over the plane of two axes: cells in grey, hatched by their verdict where no bound is proved; a
    thick line, drawn between the points on one and on the other side, around those that `is_met` names."""
    with matplotlib.rc_context(_STYLE):
        figure = matplotlib.figure.Figure(figsize=(7.2, 5.0), layout="constrained")
        axes = figure.add_subplot()
        proved = values.bound[np.isfinite(values.bound) & (values.bound > 0)]
        norm = (matplotlib.colors.LogNorm(proved.min(), max(proved.max(), proved.min() * 1.001))
                if proved.size else matplotlib.colors.Normalize(0, 1))
        # Dark is better, whichever side that is.
        shades = np.linspace(_LEAST_COLOUR, _MOST_COLOUR, _COLOURS)
        colours = matplotlib.colors.ListedColormap(
            [str(shade) for shade in (shades if values.is_at_most else shades[::-1])])
        xs, ys = np.unique(values.x), np.unique(values.y)
        if xs.size * ys.size == values.bound.size and xs.size > 1 and ys.size > 1:
            drawn = _draw_cells(axes, values, x, y, xs, ys, norm, colours, level)
        else:
            drawn = [axes.scatter(values.x[here], values.y[here], c=values.bound[here], norm=norm, cmap=scale, s=28,
                                  marker=marker, edgecolors="0.2", linewidths=0.5)
                     for here, marker, scale in ((~values.early, "o", colours),
                                                 (values.early, _early_marker(values), _lighter(colours)))][0]
            met = is_met(values, level)
            axes.scatter(values.x[met], values.y[met], s=80, facecolors="none", edgecolors="black", linewidths=1.4)
            _draw_markers(axes, values)
        _decorate(axes, x, y)
        if proved.size:
            bar = figure.colorbar(drawn, ax=axes)
            bar.set_label(_wrapped(values.words))
            if level is not None and proved.min() < level < proved.max():
                bar.ax.axhline(level, color="black", linewidth=1.6)
        return _svg(figure)


def _early_marker(values: Values) -> str:
    """A triangle to where a better bound would be."""
    return "v" if values.is_at_most else "^"


def _draw_cells(axes, values: Values, x: Axis, y: Axis, xs: np.ndarray, ys: np.ndarray, norm, colours,
                level: float | None):
    grid = np.full((ys.size, xs.size), np.nan)
    met = np.zeros(grid.shape, bool)
    place = np.searchsorted(ys, values.y), np.searchsorted(xs, values.x)
    grid[place] = values.bound
    met[place] = is_met(values, level)
    x_edges, y_edges = _edges(xs, x.is_logarithmic), _edges(ys, y.is_logarithmic)
    patches = []
    for verdict, (words, hatch) in _WITHOUT_BOUND.items():
        cells = np.isnan(values.bound) & (values.verdict == verdict)
        for row, column in zip(place[0][cells], place[1][cells]):
            axes.fill_between(x_edges[column:column + 2], y_edges[row], y_edges[row + 1], facecolor="white",
                              edgecolor="0.6", hatch=hatch, linewidth=0.0)
        if cells.any():
            patches.append(matplotlib.patches.Patch(facecolor="white", edgecolor="0.6", hatch=hatch, label=words))
    early = values.early & np.isfinite(values.bound)
    stopped = np.zeros(grid.shape, bool)
    stopped[place] = early
    scales = [(~stopped, colours)] + ([(stopped, _lighter(colours))] if early.any() else [])
    drawn = [axes.pcolormesh(x_edges, y_edges, np.ma.masked_invalid(np.where(shown, grid, np.nan)), norm=norm,
                             cmap=scale, shading="flat", edgecolors="face", linewidth=0.1)
             for shown, scale in scales][0]
    for row, column in zip(place[0][early], place[1][early]):
        axes.fill_between(x_edges[column:column + 2], y_edges[row], y_edges[row + 1], facecolor="none",
                          edgecolor="0.5", hatch=_EARLY_HATCH, linewidth=0.0)
    if early.any():
        patches.append(matplotlib.patches.Patch(facecolor="0.8", edgecolor="0.5", hatch=_EARLY_HATCH,
                                                label=_EARLY_WORDS))
    if met.any() and not met.all():
        _draw_border(axes, met, x_edges, y_edges)
    if patches:
        axes.legend(handles=patches, loc="upper center", bbox_to_anchor=(0.5, -0.14),
                    ncols=1 if early.any() else 3, frameon=False,
                    handlelength=2.4, handleheight=1.4)
    axes.set_xlim(x_edges[0], x_edges[-1])
    axes.set_ylim(y_edges[0], y_edges[-1])
    return drawn


def _draw_markers(axes, values: Values, transform=None) -> None:
    """Where no bound is proved: crosses, upright ones for what is REFUTED, points without a verdict."""
    missing = np.isnan(values.bound)
    for verdict, marker in (("undecided", "x"), ("refuted", "+"), ("error", "."), ("proved", "x"),
                            ("nothing-required", "x")):
        here = missing & (values.verdict == verdict)
        axes.plot(values.x[here], np.zeros(here.sum()) if transform else values.y[here], marker=marker,
                  linestyle="none", color="0.3", markersize=6, clip_on=False,
                  **({"transform": transform} if transform else {}))


def _draw_border(axes, met: np.ndarray, x_edges: np.ndarray, y_edges: np.ndarray) -> None:
    """Along the sides of the cells: between points nothing is known, and no line suggests that it is."""
    for row in range(met.shape[0]):
        for column in range(met.shape[1]):
            if column + 1 < met.shape[1] and met[row, column] != met[row, column + 1]:
                axes.plot([x_edges[column + 1]] * 2, y_edges[row:row + 2], color="black", linewidth=2.2,
                          solid_capstyle="projecting")
            if row + 1 < met.shape[0] and met[row, column] != met[row + 1, column]:
                axes.plot(x_edges[column:column + 2], [y_edges[row + 1]] * 2, color="black", linewidth=2.2,
                          solid_capstyle="projecting")


def line_figure(values: Values, x: Axis, level: float | None) -> str:
    """The bound over one axis; crosses at the bottom where none is proved, rings around those of designs that are
    PROVED."""
    with matplotlib.rc_context(_STYLE):
        figure = matplotlib.figure.Figure(figsize=(7.2, 4.0), layout="constrained")
        axes = figure.add_subplot()
        order = np.argsort(values.x)
        axes.plot(values.x[order], values.bound[order], color="black", linewidth=1.2)
        for here, marker, fill in ((~values.early, "o", "black"), (values.early, _early_marker(values), "white")):
            axes.plot(values.x[here], values.bound[here], marker=marker, linestyle="none", color="black",
                      markerfacecolor=fill, markersize=4 if fill == "black" else 6)
        proved = np.isfinite(values.bound) & (values.verdict == "proved")
        if not (values.verdict == "nothing-required").any():
            axes.plot(values.x[proved], values.bound[proved], marker="o", linestyle="none", color="black",
                      markerfacecolor="none", markersize=9)
        _draw_markers(axes, values, axes.get_xaxis_transform())
        if level is not None:
            axes.axhline(level, color="0.4", linestyle="--", linewidth=1.2)
        axes.set_xlabel(x.label)
        axes.set_ylabel(_wrapped(values.words))
        if x.is_logarithmic:
            axes.set_xscale("log")
        if np.nanmin(values.bound, initial=np.inf) > 0 and np.isfinite(values.bound).any():
            axes.set_yscale("log")
        return _svg(figure)


def pareto_figure(first: Sequence[float], second: Sequence[float], on_front: Sequence[bool],
                  early: Sequence[bool], words: tuple[str, str]) -> str:
    """Two bounds of each design; those that no other design beats in both are joined, and those of an early stop are
    white."""
    with matplotlib.rc_context(_STYLE):
        figure = matplotlib.figure.Figure(figsize=(7.2, 4.6), layout="constrained")
        axes = figure.add_subplot()
        x, y, front = np.array(first), np.array(second), np.array(on_front, bool)
        stopped = np.array(early, bool)
        for here, fill in ((~front & ~stopped, "0.7"), (~front & stopped, "white")):
            axes.scatter(x[here], y[here], s=16, c=fill, edgecolors="0.5", linewidths=0.4)
        order = np.argsort(x[front], kind="stable")
        axes.plot(x[front][order], y[front][order], color="black", linewidth=1.2)
        for here, fill in ((front & ~stopped, "black"), (front & stopped, "white")):
            axes.plot(x[here], y[here], marker="o", linestyle="none", color="black", markerfacecolor=fill, markersize=5)
        axes.set_xlabel(_wrapped(words[0], 70))
        axes.set_ylabel(_wrapped(words[1], 42))
        if (x > 0).all() and x.max() > 5 * x.min():
            axes.set_xscale("log")
        if (y > 0).all() and y.max() > 5 * y.min():
            axes.set_yscale("log")
        return _svg(figure)


def _wrapped(words: str, width: int = 46) -> str:
    lines = [""]
    for word in words.split():
        if len(lines[-1]) + len(word) > width:
            lines.append("")
        lines[-1] += (" " if lines[-1] else "") + word
    return "\n".join(lines)
