"""The sets of a certificate: from hexadecimal floats to arrays."""

from __future__ import annotations

from typing import Any, Iterator, Mapping

import numpy as np

_NO_SETS = ("start-covariance", "cover", "witness")
"""Evidence that is about starts, and describes no set that errors stay in."""


def sets_of(document: Mapping[str, Any]) -> list[dict[str, Any]]:
    """The certified sets of a certificate.json; see Certificate.sets.

    Parameters
    ----------
    document : mapping
        certificate.json, read.

    Returns
    -------
    list of dict
    """
    return [*_sets(document, "")]


def _sets(document: Mapping[str, Any], of: str) -> Iterator[dict[str, Any]]:
    for each in document.get("certified_sets", []):
        yield {"kind": f"{of}contraction", **numbers_of(each)}
    for each in document.get("lock_sets", []):
        yield {"kind": f"{of}lock", "purpose": "lock", **numbers_of(each)}
    if (lowest := document.get("lowest_snr_set")) is not None:
        yield {"kind": f"{of}lock", "purpose": "lowest-snr", **numbers_of(lowest)}
    for each in document.get("tubes", []):
        yield {"kind": f"{of}tubes", "purpose": each["name"],
               **{name: numbers_of(value) for name, value in each.items() if name != "name"}}
    for derivation in document.get("derivations", []):
        for each in derivation.get("evidence", []):
            if each["name"] not in _NO_SETS:
                yield {"kind": of + derivation["id"], "purpose": each["name"],
                       **numbers_of({**each.get("numbers", {}), **each.get("matrices", {})})}
    for inner in ("recursion", "frequency_tracker"):
        if inner in document:
            yield from _sets(document[inner], f"{of}{inner}/")


def numbers_of(value: Any) -> Any:
    """Hexadecimal floats as doubles, which are exact; lists of numbers of one length as arrays.

    Parameters
    ----------
    value
        As json.loads has it.
    """
    if isinstance(value, dict):
        return {key: numbers_of(each) for key, each in value.items()}
    if isinstance(value, list):
        numbers = [numbers_of(each) for each in value]
        is_array = bool(numbers) and all(isinstance(each, (float, np.ndarray)) for each in numbers)
        return np.array(numbers) if is_array and len({np.shape(each) for each in numbers}) == 1 else numbers
    if isinstance(value, str) and value.lstrip("-").startswith("0x"):
        return float.fromhex(value)
    return value
