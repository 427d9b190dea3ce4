"""The specification of a sweep: a base design, axes, and what is recorded and reported about each design."""

from __future__ import annotations

import dataclasses
import decimal
import hashlib
import math
import warnings
from typing import Any, Iterator, Mapping, Sequence

import numpy as np

from ..design import Design, replaced_text

_DIGITS = 6
"""Significant digits of the values computed for an axis, which its designs have as decimals."""


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
        The ends of a range.
    is_logarithmic : bool
        Whether figures have it on a logarithmic scale.
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
    """One design of a sweep.

    Attributes
    ----------
    number : int
        The number of the point, from 0; the last axis varies fastest.
    values : tuple
        The values along the axes.
    text : str
        The text of the design.
    """

    number: int
    values: tuple[Any, ...]
    text: str


@dataclasses.dataclass(frozen=True)
class Spec:
    """A sweep, read. Points are numbered from 0, and made when they are needed.

    Attributes
    ----------
    name, file, text : str
        One line; the name of its file in messages; the TOML text.
    base : Design
    base_values : mapping
        Its tables, with [require] of the sweep.
    axes : tuple of Axis
    count, method, seed
        How axes without points are sampled; the count is 1 where there are no such axes.
    extent : str
        As for veritrack.certify.
    record : tuple of str
        Names of bounds that are stored; all when it is empty.
    report : mapping
        The table [report].
    """

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
    def stops_early(self) -> bool:
        """Whether searches end as soon as they have what is required: bounds are then no better than that needs."""
        return self.extent in ("verdicts", "quick")

    @property
    def size(self) -> int:
        """How many points there are."""
        return math.prod(len(axis.values) for axis in self.axes if not axis.is_sampled) * self.count

    def identity(self, program: str) -> str:
        """The SHA-256 of all that decides its results."""
        parts = "\n".join([program, self.extent, self.text, self.base.text])
        return hashlib.sha256(parts.encode()).hexdigest()

    def key(self, text: str, program: str) -> str:
        """The SHA-256 by which the result of a design is known: of its text, of what is asked and recorded of it,
        and of the program."""
        return hashlib.sha256("\n".join([program, self.extent, *self.record, text]).encode()).hexdigest()

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
