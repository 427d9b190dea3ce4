"""The work of a worker: a batch of designs, one after the other."""

from __future__ import annotations

import time
from typing import Any, Mapping

from .. import _engine, _toml
from ..certificate import bounds_of, claims_of
from ..errors import EngineError, InputError, TimeLimit, VeritrackError
from .store import Result


class OtherProgram(VeritrackError):
    """A worker whose program is another one than that of the client."""


def certified(items: list[tuple[str, str]], file: str, extent: str, record: tuple[str, ...], program: str,
              limit: float | None) -> list[Result]:
    """The results of designs (key, text). Needs nothing but what it is given: a task for any machine.

    Raises
    ------
    OtherProgram
        The results of this worker would not be those of `program`.
    """
    found = _engine.identity()
    if found != program:
        raise OtherProgram(f"a worker has another program than the client ({found[:12]} and {program[:12]}); "
                           "allowed: the same package everywhere")
    return [_result(key, text, file, extent, record, limit) for key, text in items]


def _result(key: str, text: str, file: str, extent: str, record: tuple[str, ...],
            limit: float | None) -> Result:
    start = time.monotonic()
    try:
        answer = _answer({"do": "check", "text": text, "file": file, "extent": extent, "threads": 1}, limit)
    except InputError as error:
        return Result(key, "error", {}, error=_placed(error, text))
    except (TimeLimit, EngineError) as error:
        return Result(key, "error", {}, error=str(error), may_be_tried_again=True,
                      seconds=time.monotonic() - start)
    return Result(key, answer["verdict"], recorded_bounds(answer, record), answer["certificate_sha256"],
                  seconds=time.monotonic() - start)


def _placed(error: InputError, text: str) -> str:
    """The message, with the key that it is about: nobody has seen the lines of a design of a sweep."""
    key = _toml.key_at(text, error.line)
    line = text.splitlines()[error.line - 1] if "." in key else ""
    return error.message + (f" (at {key}: {line})" if line else "")


def recorded_bounds(answer: Mapping[str, Any], record: tuple[str, ...]) -> dict[str, list[str]]:
    """The bounds of an engine's answer as they are stored; all of them when nothing is named."""
    return {name: [bound.lo.hex(), bound.hi.hex(), bound.sense, bound.words, bound.claim]
            for name, bound in bounds_of(claims_of(answer)).items() if not record or name in record}


def _answer(question: dict[str, Any], limit: float | None) -> dict[str, Any]:
    try:
        return _engine.ask(question, limit)
    except EngineError:
        # The process may have been killed from outside; a design that kills it does so twice.
        return _engine.ask(question, limit)
