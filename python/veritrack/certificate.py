"""Certificates."""

from __future__ import annotations

import collections
import contextlib
import csv
import dataclasses
import html
import io
import json
import os
import pathlib
import tempfile
from typing import Any, Mapping

import numpy as np

from . import _engine
from .design import Design, as_design
from .interval import Bound
from .sets import sets_of
from .verification import Verification, verify


EXTENTS = ("everything", "requirements", "verdicts", "quick")
"""How much may be looked for; see certify."""

_OF_TRACKERS = ("dft-block", "ekf", "kkl", "model", "recursion", "regulator")
"""How the ids of claims begin that are about a tracker, and not about a publication."""

_OF_THE_DESIGN = ("guarantee", "invariant-set", "limits", "losing-lock")
"""How they end when they are under the assumptions of the design and nothing asks for them."""


@dataclasses.dataclass(frozen=True)
class Claim:
    """A statement about a design, decided.

    Attributes
    ----------
    id : str
        Such as "ekf/guarantee"; `veritrack explain ID` says how it is proved.
    verdict : str
        "proved", "refuted" or "undecided".
    statement : str
        One sentence with all its hypotheses, with units.
    required : bool
        Whether [require] asks for it.
    requirement : str
        The requirement, in short.
    reason : str
        The ground for the verdict.
    position : tuple of int
        Line and column of the requirement in the design; 0 where there is none.
    quantities : mapping
        The numbers of its evidence, by name. Only those of a claim that is "proved" are bounds.
    """

    id: str
    verdict: str
    statement: str
    required: bool
    requirement: str
    reason: str
    position: tuple[int, int]
    quantities: Mapping[str, Bound]


@dataclasses.dataclass(frozen=True)
class Figure:
    """A figure of a certificate: SVG, with the numbers in it.

    Attributes
    ----------
    file : str
        Such as "tube.svg".
    title, caption : str
        A description of the figure, with units.
    svg : str
    tables : mapping
        From names to the CSV of its numbers.
    """

    file: str
    title: str
    caption: str
    svg: str
    tables: Mapping[str, str]

    def data(self, table: str | None = None) -> dict[str, np.ndarray]:
        """The columns of a table by their headings, which have the units; NaN where a value is missing.

        Parameters
        ----------
        table : str, optional
            The first one when it is left out. A column with words is an array of strings.

        Returns
        -------
        dict of str to ndarray
        """
        text = self.tables[table] if table is not None else next(iter(self.tables.values()))
        heading, *rows = csv.reader(io.StringIO(text, newline=""))
        return {name: _column([row[i] for row in rows]) for i, name in enumerate(heading)}

    def _repr_svg_(self) -> str:
        return self.svg


def _column(cells: list[str]) -> np.ndarray:
    try:
        return np.array([float(cell) if cell else np.nan for cell in cells])
    except ValueError:
        return np.array(cells)


def claims_of(answer: Mapping[str, Any]) -> tuple[Claim, ...]:
    """The claims of an engine's answer."""
    return tuple(
        Claim(each["id"], each["verdict"], each["statement"], each["required"], each["requirement"],
              each["reason"], (each["line"], each["column"]),
              {name: Bound(float.fromhex(found["lo"]), float.fromhex(found["hi"]), name, found["sense"],
                           found["words"], found["symbol"], each["id"])
               for name, found in each["quantities"].items()})
        for each in answer["claims"])


def bounds_of(claims: tuple[Claim, ...]) -> dict[str, Bound]:
    """The proved bounds, under the hypotheses of the claim that each names.

    A name alone stands for what is required, guaranteed, or tolerated under the assumptions of the design. What
    another claim says, perhaps under other assumptions, has that claim in front: "ekf/lowest-snr/lowest_snr".
    Where several claims have one id (one for each part of a band), their numbers are in their `quantities` only,
    as are those of claims about publications.
    """
    times = collections.Counter(claim.id for claim in claims)
    bounds: dict[str, Bound] = {}
    for claim in sorted(claims, key=lambda claim: not claim.required):
        column, _, kind = claim.id.partition("/")
        if claim.verdict != "proved" or times[claim.id] > 1 or column not in _OF_TRACKERS:
            continue
        # What is proved for a part of the assumed band only has its claim in front.
        by_name = claim.required or (kind in _OF_THE_DESIGN and "from" not in claim.quantities)
        for name, bound in claim.quantities.items():
            if bound.sense != "sampled":
                bounds.setdefault(name if by_name else f"{claim.id}/{name}", bound)
    return bounds


class Certificate:
    """The proved, refuted and undecided claims about a design; `certify` makes it.

    Attributes
    ----------
    design : Design
    verdict : str
        The verdict on everything required: "proved", "refuted", "undecided", or "nothing-required".
    headline : str
        The requirements, and the verdicts on them.
    claims : tuple of Claim
    bounds : dict of str to Bound
        The proved bounds, by name.
    files : mapping
        The documents by their names: certificate.json, report.json, certificate.md, and published-theorems.md
        where there is one.
    missing_figures : str
        Why there are no figures; empty when nothing is missing.
    sha256 : str
        The SHA-256 of certificate.json, 64 hexadecimal digits.

    Parameters
    ----------
    design : Design
    answer : mapping
        The answer of the process that certifies.
    """

    def __init__(self, design: Design, answer: Mapping[str, Any]) -> None:
        self.design = design
        self.verdict: str = answer["verdict"]
        self.headline: str = answer["headline"]
        self.claims = claims_of(answer)
        self.bounds = bounds_of(self.claims)
        self.files: Mapping[str, str] = answer["files"]
        self.sha256: str = answer["certificate_sha256"]
        self.missing_figures: str = answer["missing_figures"]
        self._figures = tuple(
            Figure(each["file"], each["title"], each["caption"], each["svg"],
                   {table["name"]: table["csv"] for table in each["tables"]})
            for each in answer["figures"])

    @property
    def required(self) -> tuple[Claim, ...]:
        """The claims that [require] asks for."""
        return tuple(claim for claim in self.claims if claim.required)

    @property
    def json(self) -> dict[str, Any]:
        """certificate.json: what is proved or refuted, with the evidence. Numbers are hexadecimal floats."""
        return json.loads(self.files["certificate.json"])

    @property
    def report(self) -> dict[str, Any]:
        """report.json: everything that is reported about the design."""
        return json.loads(self.files["report.json"])

    @property
    def sets(self) -> list[dict[str, Any]]:
        """The certified sets, which errors do not leave.

        Returns
        -------
        list of dict
            Each has `kind` and `purpose`, what it is and what the search made it for, and beside them what
            certificate.json has of it (docs/certificate-format.md), as doubles and arrays of doubles, which are
            exact. `kind` is "contraction" (`metric` T and `radius`: the set is |T e| <= radius, e in units of the
            amplitude, rad and rad/sample; `rate`), "lock" (with Gaussian noise), "tubes" (of a recursion:
            `cells`), or the id of the derivation that has the set as its evidence. Sets of a certificate inside
            this one have its member in front: "frequency_tracker/contraction".
        """
        return sets_of(self.json)

    def figures(self) -> tuple[Figure, ...]:
        """The figures, as SVG with their numbers; none without gnuplot."""
        return self._figures

    def save(self, folder: str | os.PathLike[str]) -> pathlib.Path:
        """Writes the documents and the figures into a folder, which is made; each file appears whole.

        Parameters
        ----------
        folder : path

        Returns
        -------
        pathlib.Path
            certificate.md in it.
        """
        target = pathlib.Path(folder)
        for name, text in self.files.items():
            write_file(target / name, text)
        for figure in self._figures:
            write_file(target / "figures" / figure.file, figure.svg)
        return target / "certificate.md"

    def verify(self, *, full: bool = False) -> Verification:
        """Has the checker prove the certificate again, and compare it with the design and its documents.

        Parameters
        ----------
        full : bool
            Follow all boxes of starts; see veritrack.verify.

        Returns
        -------
        Verification
        """
        with tempfile.TemporaryDirectory() as folder:
            self.save(folder)
            design = pathlib.Path(folder, "design.toml")
            write_file(design, self.design.text)
            documents = [pathlib.Path(folder, name) for name in self.files if name.endswith(".md")]
            return verify(pathlib.Path(folder, "certificate.json"), design=design, documents=documents,
                          full=full)

    def __repr__(self) -> str:
        return f"<Certificate of {self.design.name!r}: {self.headline}>"

    def _repr_html_(self) -> str:
        def row(claim: Claim) -> str:
            return (f"<tr><td><b>{claim.verdict.upper()}</b></td><td style='text-align:left'>"
                    f"{html.escape(claim.requirement or claim.statement)}</td>"
                    f"<td style='text-align:left'>{html.escape(claim.reason)}</td></tr>")

        def bound_row(name: str, bound: Bound) -> str:
            return (f"<tr><td style='text-align:left'>{html.escape(bound.words or name.replace('_', ' '))}</td>"
                    f"<td style='text-align:left'>{html.escape(str(bound))}</td></tr>")

        shown = self.required or tuple(claim for claim in self.claims if claim.id.partition('/')[0] in _OF_TRACKERS)
        return (f"<p><b>{html.escape(self.headline)}</b></p><p>{html.escape(self.design.name)}</p>"
                "<table><thead><tr><th>verdict</th><th>of what</th><th>why</th></tr></thead><tbody>"
                + "".join(map(row, shown)) + "</tbody></table>"
                "<table><thead><tr><th>bound</th><th></th></tr></thead><tbody>"
                + "".join(bound_row(*each) for each in self.bounds.items()) + "</tbody></table>")


def write_file(path: pathlib.Path, text: str) -> None:
    """Beside the target first, so that the file appears whole or not at all."""
    path.parent.mkdir(parents=True, exist_ok=True)
    descriptor, temporary = tempfile.mkstemp(dir=path.parent, prefix=path.name)
    try:
        with os.fdopen(descriptor, "wb") as file:
            file.write(text.encode("utf-8", "surrogateescape"))
            file.flush()
            os.fsync(file.fileno())
        os.chmod(temporary, 0o666 & ~_umask())
        os.replace(temporary, path)
    except BaseException:
        with contextlib.suppress(OSError):
            os.unlink(temporary)
        raise


def _umask() -> int:
    mask = os.umask(0)
    os.umask(mask)
    return mask


def certify(design: Design | str | os.PathLike[str], *, extent: str = "everything", figures: bool = True,
            timeout: float | None = None, threads: int = 0) -> Certificate:
    """Certifies a design.

    Ctrl-C ends the work at once.

    Parameters
    ----------
    design : Design or path
    extent : {"everything", "requirements", "verdicts", "quick"}
        "requirements": what decides [require], and not what takes long and is only reported. "verdicts": the
        same verdicts, with bounds no better than they need. "quick": one search for a set that does all that is
        required, and no other; what it leaves undecided, another extent may prove.
    figures : bool
        Whether figures are drawn (with gnuplot).
    timeout : float, optional
        Seconds after which the work is stopped.
    threads : int
        The largest number of threads for the searches; 0: the number of cores. No result depends on it.

    Returns
    -------
    Certificate

    Raises
    ------
    InputError, ArithmeticNotTrusted, TimeLimit, EngineError
    """
    if extent not in EXTENTS:
        raise ValueError(f"extent {extent!r}; allowed: {', '.join(map(repr, EXTENTS))}")
    design = as_design(design)
    answer = _engine.ask({"do": "certify", "text": design.text, "file": design.file, "extent": extent,
                          "figures": figures, "threads": threads}, timeout)
    return Certificate(design, answer)
