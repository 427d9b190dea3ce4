"""The errors that the package raises."""

from __future__ import annotations


class VeritrackError(Exception):
    """The base of all errors of this package."""


class InputError(VeritrackError, ValueError):
    """An input that cannot be used.

    Attributes
    ----------
    file : str
        The file, as it was named.
    line, column : int
        The place in it, from 1; 0 when unknown.
    message : str
        The finding and what is allowed, on one line.
    """

    def __init__(self, file: str, line: int, column: int, message: str) -> None:
        place = f"{file}:{line}:{column}" if line else file
        super().__init__(f"{place}: {message}")
        self.file = file
        self.line = line
        self.column = column
        self.message = message

    def __reduce__(self):
        return InputError, (self.file, self.line, self.column, self.message)


class ArithmeticNotTrusted(VeritrackError, ArithmeticError):
    """This machine or this build does not round as proofs need it: nothing was certified."""


class TimeLimit(VeritrackError, TimeoutError):
    """The work was stopped by the time limit that was asked for."""


class EngineError(VeritrackError, RuntimeError):
    """The process that certifies ended, or could not continue."""


class MalformedCertificate(VeritrackError, ValueError):
    """The checker could not read a certificate."""
