"""TOML out: the text of a design from its values, every number as the decimal that it was."""

from __future__ import annotations

import decimal
import math
import numbers
import re
import tomllib
from typing import Any, Mapping

_BARE = re.compile(r"[A-Za-z0-9_-]+\Z")


def parse(text: str) -> dict[str, Any]:
    """The tables of a TOML text, with decimals instead of doubles."""
    return tomllib.loads(text, parse_float=decimal.Decimal)


def dump(document: Mapping[str, Any]) -> str:
    """The text: first the keys above the first table, then a table each, keys in their order."""
    lines = [f"{_key(key)} = {value_text(value)}" for key, value in document.items()
             if not isinstance(value, Mapping)]
    for key, table in document.items():
        if isinstance(table, Mapping):
            lines += ["", f"[{_key(key)}]"]
            lines += [f"{_key(name)} = {value_text(value)}" for name, value in table.items()]
    return "\n".join(lines) + "\n"


def key_at(text: str, line: int) -> str:
    """The key on a line of a text that `dump` has written.

    Parameters
    ----------
    text : str
    line : int
        From 1.

    Returns
    -------
    str
        Such as "design.q1", or "design" on the line of the table; empty where no key is.
    """
    table, key, is_inside = "", "", False
    for number, words in enumerate(text.splitlines(), 1):
        if is_inside:
            is_inside = not words.endswith("'''")
        elif heading := re.match(r"\[(.+)\]\Z", words):
            table = key = heading[1].strip('"')
        elif found := re.match(r'(".*?"|[A-Za-z0-9_-]+) = ', words):
            name = found[1].strip('"')
            key = f"{table}.{name}" if table else name
            is_inside = words.endswith("= '''")
        else:
            key = ""
        if number == line:
            return key
    return ""


def _key(key: str) -> str:
    return key if _BARE.match(key) else _string(key)


def _string(text: str) -> str:
    # Lines stay lines, so that messages about a recursion name the right one.
    if "\n" in text and "'''" not in text and not text.endswith("'") and not _has_controls(text):
        return f"'''\n{text}'''"
    escaped = text.replace("\\", "\\\\").replace('"', '\\"')
    return '"' + "".join(f"\\u{ord(c):04x}" if ord(c) < 0x20 or ord(c) == 0x7F else c for c in escaped) + '"'


def _has_controls(text: str) -> bool:
    return any((ord(c) < 0x20 and c not in "\n\t") or ord(c) == 0x7F for c in text)


def _number(value: Any) -> str:
    if isinstance(value, decimal.Decimal):
        if not value.is_finite():
            raise ValueError(f"{value} is no number of a design; allowed: finite numbers")
        return str(value)
    if isinstance(value, numbers.Integral):
        return str(int(value))
    if not math.isfinite(value):
        raise ValueError(f"{value} is no number of a design; allowed: finite numbers")
    return repr(float(value))


def value_text(value: Any) -> str:
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str):
        return _string(value)
    if isinstance(value, (decimal.Decimal, numbers.Real)):
        return _number(value)
    if isinstance(value, Mapping):
        return "{ " + ", ".join(f"{_key(key)} = {value_text(each)}" for key, each in value.items()) + " }"
    if hasattr(value, "tolist"):
        value = value.tolist()
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(value_text(each) for each in value) + "]"
    raise TypeError(f"{value!r} cannot stand in a design; allowed: numbers, strings, lists, and tables of them")
