"""Enclosures, and bounds as certificates have them."""

from __future__ import annotations

import dataclasses
import decimal
from fractions import Fraction


def _rounded(value: float, digits: int, rounding: str) -> str:
    exact = decimal.Decimal(value)
    if not exact.is_finite():
        return str(value)
    number = decimal.Context(prec=digits, rounding=rounding).create_decimal(exact).normalize()
    # "20", and not "2e+1".
    return f"{number:f}" if 0 <= number.adjusted() < 16 else f"{number:g}"


@dataclasses.dataclass(frozen=True)
class Interval:
    """All real numbers from `lo` to `hi`, both of which are exact doubles.

    Attributes
    ----------
    lo, hi : float
        The ends.
    """

    lo: float
    hi: float

    @property
    def fractions(self) -> tuple[Fraction, Fraction]:
        """Both ends as exact fractions."""
        return Fraction(self.lo), Fraction(self.hi)

    @property
    def width(self) -> Fraction:
        """hi - lo, exactly."""
        lo, hi = self.fractions
        return hi - lo

    def __contains__(self, number: float | int | Fraction | decimal.Decimal) -> bool:
        lo, hi = self.fractions
        return lo <= Fraction(number) <= hi

    def lower(self, digits: int = 4) -> str:
        """The lower end as a decimal, rounded down: what the number is at least.

        Parameters
        ----------
        digits : int
            That are significant.

        Returns
        -------
        str
        """
        return _rounded(self.lo, digits, decimal.ROUND_FLOOR)

    def upper(self, digits: int = 4) -> str:
        """The upper end as a decimal, rounded up: what the number is at most.

        Parameters
        ----------
        digits : int
            That are significant.

        Returns
        -------
        str
        """
        return _rounded(self.hi, digits, decimal.ROUND_CEILING)

    def __str__(self) -> str:
        return f"[{self.lower(7)}, {self.upper(7)}]"


@dataclasses.dataclass(frozen=True)
class Bound(Interval):
    """A number of a certificate, enclosed.

    Attributes
    ----------
    name : str
        As in certificate.json.
    sense : str
        "at most": it bounds something from above, and `hi` is the number to use. "at least": from below, `lo`.
        "equal" and "enclosure": the number itself lies from `lo` to `hi`. "sampled": a search or a simulation
        gave it, and nothing is proved of it.
    words : str
        Its meaning, with its unit; empty where only its symbol says it.
    symbol : str
        LaTeX.
    claim : str
        The id of the claim whose statement has the hypotheses.
    """

    name: str = ""
    sense: str = "enclosure"
    words: str = ""
    symbol: str = ""
    claim: str = ""

    @property
    def value(self) -> float:
        """The end on the safe side: `lo` for "at least", else `hi`."""
        return self.lo if self.sense == "at least" else self.hi

    def __str__(self) -> str:
        if self.sense == "at most":
            return f"at most {self.upper()}"
        if self.sense == "at least":
            return f"at least {self.lower()}"
        return super().__str__()
