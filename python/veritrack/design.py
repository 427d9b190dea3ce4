"""Designs."""

from __future__ import annotations

import copy
import hashlib
import os
import pathlib
from typing import Any, Mapping

from . import _engine, _toml


class Design:
    """A design: the text of a design file, read and found to be one.

    Parameters
    ----------
    tracker : str
        "quadrature-ekf", "single-channel-ekf", "kkl-observer", "dft-block-ekf", "vibration-regulator" or "model".
    name : str
        One line.
    source : str, optional
        The source of its numbers, one line.
    **tables : mapping
        The tables of a design file (docs/design-file.md), each a mapping from keys to values: `design`,
        `assume`, `require`, `simulate`, `model`, ... Numbers are int, float (its shortest decimal is what
        stands in the design), decimal.Decimal or NumPy's.

    Raises
    ------
    InputError
        With line and column in `text`, when it is not a valid design.

    Examples
    --------
    >>> design = Design("quadrature-ekf", "mine", design=dict(q1=0.0023, q2=0.0023, r=0.05, epsilon=0),
    ...                 assume=dict(frequency=[0.05, 3], noise=0.001, initial_frequency_error=0.005,
    ...                             initial_phase_error=0.005, initial_amplitude_error=0.005),
    ...                 require=dict(frequency_error_below=0.05))
    """

    def __init__(self, tracker: str, name: str, *, source: str | None = None,
                 **tables: Mapping[str, Any]) -> None:
        head: dict[str, Any] = {"name": name, "tracker": tracker}
        if source is not None:
            head["source"] = source
        self._read(_toml.dump({**head, **tables}), "design.toml")

    def _read(self, text: str, file: str) -> None:
        read = _engine.ask({"do": "read", "text": text, "file": file})
        self._text = text
        self._file = file
        self._name: str = read["name"]
        self._tracker: str = read["tracker"]
        self._positions = {key: (line, column) for key, (line, column) in read["positions"].items()}

    @classmethod
    def from_toml(cls, text: str, file: str = "design.toml") -> Design:
        """The design of a TOML text.

        Parameters
        ----------
        text : str
        file : str
            Its name in messages and documents.

        Returns
        -------
        Design

        Raises
        ------
        InputError
            With line and column, when it is not a valid design.
        """
        design = cls.__new__(cls)
        design._read(text, file)
        return design

    @classmethod
    def from_file(cls, path: str | os.PathLike[str]) -> Design:
        """The design of a file.

        Parameters
        ----------
        path : path

        Returns
        -------
        Design

        Raises
        ------
        OSError
            When it cannot be read.
        InputError
            With line and column, when it is not a valid design.
        """
        return cls.from_toml(pathlib.Path(path).read_bytes().decode("utf-8", "surrogateescape"), os.fspath(path))

    @property
    def text(self) -> str:
        """The TOML text, to the byte."""
        return self._text

    @property
    def file(self) -> str:
        """The name of its file, for messages and documents."""
        return self._file

    @property
    def name(self) -> str:
        """The line that names it."""
        return self._name

    @property
    def tracker(self) -> str:
        """Its kind of tracker, such as "quadrature-ekf"."""
        return self._tracker

    @property
    def positions(self) -> dict[str, tuple[int, int]]:
        """Line and column, from 1, of the value of each key, such as "design.q1"."""
        return dict(self._positions)

    @property
    def sha256(self) -> str:
        """The SHA-256 of the text, as its certificate names it: 64 hexadecimal digits."""
        return hashlib.sha256(self._text.encode("utf-8", "surrogateescape")).hexdigest()

    @property
    def values(self) -> dict[str, Any]:
        """The tables of the text; numbers are int or decimal.Decimal."""
        return _toml.parse(self._text)

    def replace(self, values: Mapping[str, Any]) -> Design:
        """The design with other values.

        Parameters
        ----------
        values : mapping
            From keys such as "design.q1" to their values; None removes a key.

        Returns
        -------
        Design

        Raises
        ------
        ValueError
            For a key in something that is not a table of the design, or a number that is not finite.
        InputError
            When the result is not a valid design.
        """
        return Design.from_toml(replaced_text(self.values, values), self._file)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Design) and other._text == self._text

    def __hash__(self) -> int:
        return hash(self._text)

    def __repr__(self) -> str:
        return f"<Design {self._name!r}, {self._tracker}>"

    def __getstate__(self) -> dict[str, str]:
        return {"text": self._text, "file": self._file}

    def __setstate__(self, state: dict[str, str]) -> None:
        self._read(state["text"], state["file"])


def replaced_text(document: Mapping[str, Any], values: Mapping[str, Any]) -> str:
    """The text of a design with other values; see Design.replace."""
    changed = copy.deepcopy(dict(document))
    for path, value in values.items():
        *tables, key = path.split(".")
        table = changed
        for name in tables:
            table = table.setdefault(name, {})
            if not isinstance(table, dict):
                raise ValueError(f"{path}: {name} is no table of the design, but {table}; allowed: keys of tables")
        if value is None:
            table.pop(key, None)
        else:
            table[key] = value
    return _toml.dump(changed)


def as_design(design: Design | str | os.PathLike[str]) -> Design:
    """A design as it is, or that of a file."""
    return design if isinstance(design, Design) else Design.from_file(design)
